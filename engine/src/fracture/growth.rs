//! The growth of a crack tree, event by event.
//!
//! Every tip runs at the same speed, so one number, the growth s [m], is the clock of all. A tip leaves a trace
//! and stops where it comes to a trace that is older at that place: a branching motorcycle graph (Eppstein &
//! Erickson 1999). Straight runs are laid out ahead, at most one grid cell long; when one is laid out, it is
//! checked once against all runs in its cells, and whoever would come second gets a *meeting* in the event queue.
//! A meeting counts only if both have really come that far when its time has come.
//!
//! Ties go to the tip with the lower number, and each pair is decided once, so the outcome is the same everywhere.

mod forking;
mod rings;

use core::ops::ControlFlow;
use std::collections::VecDeque;

use glam::DVec2;

use super::calendar::Calendar;
use super::grid::Grid;
use super::run::{BORDER, NONE, Run};
use super::settings::{Guide, Settings};
use crate::error::{Error, Result};
use crate::geometry::{Polygon, bounds};
use crate::random;

/// Two places nearer than this share of the pane's extent are one. Far above rounding, far below any piece.
const RESOLUTION: f64 = 1e-10;
/// Cells along the pane's longer side at most; a sketch tells places apart to a ten-thousandth of a cell then.
const MOST_CELLS: f64 = 2e3;
/// Most entries that are made room for ahead.
const MOST_RESERVED: f64 = 1e6;
/// Events after which the observer is asked whether to go on: some milliseconds.
const BETWEEN_OBSERVATIONS: u32 = 1 << 13;

/// One place of a trace: a vertex, and how far along it is.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stop {
    pub trace: u32,
    pub at: f64,
    pub vertex: u32,
}

/// All that growing leaves behind.
#[derive(Debug)]
pub(super) struct Traces {
    pub vertices: Vec<DVec2>,
    /// Vertices on each trace, in no order. Border edges are the first traces.
    pub stops: Vec<Stop>,
    pub runs: Vec<Run>,
    pub tips: Vec<Tip>,
    /// How many traces are edges of the border.
    pub borders: usize,
    /// Places nearer than this are one [m].
    pub resolution: f64,
}

/// The end of a crack, and after its time the crack itself.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tip {
    /// The run being cut, or the last one.
    run: u32,
    /// The trace that stopped it; `NONE` while it runs, where it forked, and where it just ended.
    pub stopped_by: u32,
    /// The nucleus from which it comes; `NONE` for an edge of the border.
    pub tree: u32,
    depth: u16,
    kind: Kind,
    running: bool,
    draws: u32,
    /// Growth at which it may next turn.
    next_turn: f64,
    next_ring: u32,
    /// The vertex at which another trace stopped it.
    end: u32,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Border,
    Branch,
    /// Runs across from one crack to the next; neither forks nor turns.
    Ring,
}

/// What grows from one nucleus.
struct Tree {
    origin: DVec2,
    start: f64,
    /// Tips in the order in which they fork.
    waiting: VecDeque<u32>,
    running: u32,
    most: u32,
}

#[derive(Debug, Clone, Copy)]
enum Happening {
    Start {
        nucleus: u32,
    },
    /// A run comes to its planned end.
    End {
        run: u32,
    },
    /// A run comes to another one.
    Meet {
        run: u32,
        other: u32,
    },
    Fork {
        tree: u32,
    },
    Ring {
        sprout: u32,
    },
}

/// A place on a run where a ring is to start.
#[derive(Debug, Clone, Copy)]
struct Sprout {
    run: u32,
    at: f64,
    angle: f64,
}

pub(super) struct Growth<'a> {
    settings: &'a Settings,
    done: Traces,
    trees: Vec<Tree>,
    sprouts: Vec<Sprout>,
    grid: Grid,
    queue: Calendar<Happening>,
    strongest_stress: f64,
    /// Runs that a new one may meet in a cell: kept for its memory.
    near: Vec<u32>,
}

impl<'a> Growth<'a> {
    /// Lays out the border and plants the nuclei. The outline is simple and the settings are valid.
    pub fn new(outline: &Polygon, settings: &'a Settings) -> Self {
        let (low, high) = bounds(outline.points().iter().copied());
        let extent = (high - low).max_element();
        let pieces = expected_pieces(outline, settings);
        let cell = cell_size(outline, settings, pieces, extent);
        // Most of what pieces leave behind; more than this is moved page by page when it grows.
        let room = |each: f64| (each * pieces).min(MOST_RESERVED) as usize;
        let strongest_stress = match &settings.guide {
            Guide::Stress { field, .. } => field.strongest(),
            _ => 0.0,
        };
        let mut growth = Self {
            settings,
            done: Traces {
                vertices: Vec::with_capacity(room(2.5)),
                stops: Vec::with_capacity(room(5.0)),
                runs: Vec::with_capacity(room(3.5)),
                tips: Vec::with_capacity(room(2.0)),
                borders: 0,
                resolution: RESOLUTION * extent,
            },
            trees: Vec::with_capacity(settings.nuclei.len()),
            sprouts: Vec::new(),
            grid: Grid::new(low, high, cell),
            queue: Calendar::new(cell),
            strongest_stress,
            near: Vec::new(),
        };
        for ring in outline.rings() {
            growth.lay_border(ring);
        }
        growth.done.borders = growth.done.tips.len();
        for (index, nucleus) in settings.nuclei.iter().enumerate() {
            growth.trees.push(Tree {
                origin: nucleus.position,
                start: nucleus.start,
                waiting: VecDeque::new(),
                running: 0,
                most: 0,
            });
            growth.queue.schedule(nucleus.start, Happening::Start { nucleus: index as u32 });
        }
        growth
    }

    /// Grows until every tip has stopped. `observer` hears now and then that work goes on, and may break it off.
    pub fn finish(mut self, observer: &mut dyn FnMut() -> ControlFlow<()>) -> Result<Traces> {
        let mut heard = 0_u32;
        while let Some(event) = self.queue.pop() {
            heard = heard.wrapping_add(1);
            if heard.is_multiple_of(BETWEEN_OBSERVATIONS) && observer().is_break() {
                return Err(Error::Cancelled);
            }
            let time = event.time;
            match event.what {
                Happening::Start { nucleus } => self.plant(nucleus, time),
                Happening::End { run } => self.end(run, time),
                Happening::Meet { run, other } => self.stop(run, other, time),
                Happening::Fork { tree } => self.fork_one(tree, time),
                Happening::Ring { sprout } => self.sprout(self.sprouts[sprout as usize], time),
            }
        }
        Ok(self.done)
    }

    fn vertex(&mut self, position: DVec2) -> u32 {
        self.done.vertices.push(position);
        (self.done.vertices.len() - 1) as u32
    }

    fn mark(&mut self, trace: u32, at: f64, vertex: u32) {
        self.done.stops.push(Stop { trace, at, vertex });
    }

    fn lay_border(&mut self, ring: &[DVec2]) {
        let first = self.done.vertices.len();
        self.done.vertices.extend_from_slice(ring);
        for (i, &a) in ring.iter().enumerate() {
            let j = (i + 1) % ring.len();
            let b = ring[j];
            let length = a.distance(b);
            let (trace, number) = (self.done.tips.len() as u32, self.done.runs.len() as u32);
            let run = Run {
                origin: a,
                direction: (b - a) / length,
                from: 0.0,
                to: length,
                trace,
                previous: NONE,
                vertex: (first + i) as u32,
                mark: BORDER,
            };
            self.push_run(run);
            self.done.tips.push(Tip {
                run: number,
                stopped_by: NONE,
                tree: NONE,
                depth: 0,
                kind: Kind::Border,
                running: false,
                draws: 0,
                next_turn: f64::INFINITY,
                next_ring: NONE,
                end: NONE,
            });
            self.mark(trace, 0.0, (first + i) as u32);
            self.mark(trace, length, (first + j) as u32);
            self.put_in_pieces(number);
        }
    }

    /// Puts a run of any length into the grid.
    fn put_in_pieces(&mut self, number: u32) {
        let run = self.done.runs[number as usize];
        let mut at = run.from;
        while at < run.to {
            let next = (at + self.grid.cell).min(run.to);
            let sketch = self.grid.sketch(run.point(at), run.point(next));
            for cell in self.grid.cells(&sketch) {
                self.grid.put(cell, &sketch, number);
            }
            at = next;
        }
    }

    fn push_run(&mut self, run: Run) -> u32 {
        self.done.runs.push(run);
        (self.done.runs.len() - 1) as u32
    }

    fn plant(&mut self, nucleus: u32, now: f64) {
        let planted = &self.settings.nuclei[nucleus as usize];
        let vertex = self.vertex(planted.position);
        for &angle in &planted.arms {
            let tip = self.new_tip(nucleus, 0, NONE, Kind::Branch, now);
            self.start(tip, planted.position, direction(angle), vertex, NONE, now);
            self.trees[nucleus as usize].waiting.push_back(tip);
        }
        self.tick(nucleus, 0, now);
    }

    fn new_tip(&mut self, tree: u32, depth: u16, parent: u32, kind: Kind, now: f64) -> u32 {
        let next_turn = if kind == Kind::Branch && self.settings.turns() {
            now + self.settings.wiggle.spacing
        } else {
            f64::INFINITY
        };
        let number = self.done.tips.len() as u32;
        let next_ring = if parent == NONE { 0 } else { self.done.tips[self.trace(parent)].next_ring };
        self.done.tips.push(Tip {
            run: NONE,
            stopped_by: NONE,
            tree,
            depth,
            kind,
            running: true,
            draws: 0,
            next_turn,
            next_ring,
            end: NONE,
        });
        if kind == Kind::Branch {
            let tree = &mut self.trees[tree as usize];
            tree.running += 1;
            tree.most = tree.most.max(tree.running);
        }
        number
    }

    fn trace(&self, run: u32) -> usize {
        self.done.runs[run as usize].trace as usize
    }

    /// A tip starts, turns or goes on: marks where it comes from, and lays out its next run.
    fn start(&mut self, tip: u32, origin: DVec2, direction: DVec2, vertex: u32, previous: u32, now: f64) {
        if vertex != NONE {
            self.mark(tip, now, vertex);
        }
        let last = self.last_growth(tip);
        let state = &mut self.done.tips[tip as usize];
        let planned = state.next_turn.min(last);
        // No run is so short that its ends are one place.
        let whole = planned - (now + self.grid.cell) < self.done.resolution;
        let to = if whole { planned } else { now + self.grid.cell };
        let number = self.done.runs.len() as u32;
        state.run = number;
        self.push_run(Run { origin, direction, from: now, to, trace: tip, previous, vertex, mark: 0 });
        self.lay_out(number);
        self.queue.schedule(to, Happening::End { run: number });
        if self.settings.rings.is_some() {
            self.seed_rings(number);
        }
    }

    /// Puts a new run into the grid and finds whom it may meet.
    fn lay_out(&mut self, number: u32) {
        let run = self.done.runs[number as usize];
        let sketch = self.grid.sketch(run.origin, run.point(run.to));
        self.near.clear();
        for cell in self.grid.cells(&sketch) {
            self.near.extend(self.grid.near(cell, &sketch));
            self.grid.put(cell, &sketch, number);
        }
        for near in 0..self.near.len() {
            let index = self.near[near];
            if self.done.runs[index as usize].note(number) {
                self.compare(number, &run, index);
            }
        }
    }

    /// Whoever of two runs comes second to where they cross is told so.
    #[inline]
    fn compare(&mut self, number: u32, run: &Run, index: u32) {
        let other = &self.done.runs[index as usize];
        if run.adjoins(number, other, index) {
            return;
        }
        let Some(meeting) = run.meet(other, self.done.resolution) else { return };
        let (own, theirs) = (meeting.first, other.time(meeting.second));
        let second = (theirs, other.trace) <= (own, run.trace);
        if second || meeting.head_on {
            self.queue.schedule(own, Happening::Meet { run: number, other: index });
        }
        if !second || meeting.head_on {
            self.queue.schedule(theirs, Happening::Meet { run: index, other: number });
        }
    }

    /// A run comes to its planned end: the tip goes on, turns, or has reached as far as it may.
    fn end(&mut self, number: u32, now: f64) {
        let run = self.done.runs[number as usize];
        if run.to < now {
            return;
        }
        let tip = self.done.tips[run.trace as usize];
        if !tip.running || tip.run != number {
            return;
        }
        let origin = run.point(now);
        let slack = self.done.resolution;
        if now >= self.last_growth(run.trace) - slack {
            let vertex = self.vertex(origin);
            self.mark(run.trace, now, vertex);
            self.halt(run.trace, NONE);
            return;
        }
        let turn = if now >= tip.next_turn - slack { self.turn(run.trace, &run, origin) } else { 0.0 };
        if turn == 0.0 {
            self.start(run.trace, origin, run.direction, NONE, number, now);
        } else {
            let vertex = self.vertex(origin);
            let turned = rotated(run.direction, turn);
            self.start(run.trace, origin, turned, vertex, number, now);
        }
    }

    /// Growth at which a tip has reached as far as it may.
    fn last_growth(&self, tip: u32) -> f64 {
        let tree = self.done.tips[tip as usize].tree as usize;
        self.settings.reach.map_or(f64::INFINITY, |reach| self.trees[tree].start + reach)
    }

    /// How far a tip turns where it may [rad]: at random, and as it is drawn.
    fn turn(&mut self, trace: u32, run: &Run, origin: DVec2) -> f64 {
        let wiggle = self.settings.wiggle;
        self.done.tips[trace as usize].next_turn += wiggle.spacing;
        let mut turn = 0.0;
        if wiggle.probability > 0.0 && self.draw(trace) < wiggle.probability {
            turn += wiggle.variance * (self.draw(trace) - 0.5);
        }
        let tree = self.done.tips[trace as usize].tree;
        if let Some((target, length)) = self.target(tree, run.direction, origin) {
            let off = libm::atan2(run.direction.perp_dot(target), run.direction.dot(target));
            turn += off * (1.0 - libm::exp(-wiggle.spacing / length));
        }
        turn
    }

    /// Where the guide draws a tip: a unit vector, and over which length.
    fn target(&self, tree: u32, heading: DVec2, at: DVec2) -> Option<(DVec2, f64)> {
        let nearer = |angle: f64| {
            let along = direction(angle);
            if along.dot(heading) < 0.0 { -along } else { along }
        };
        match &self.settings.guide {
            Guide::None => None,
            Guide::Outward { length } => {
                let outward = (at - self.trees[tree as usize].origin).try_normalize()?;
                Some((outward, *length))
            }
            Guide::Direction { angle, length } => Some((nearer(*angle), *length)),
            Guide::Stress { field, length } => {
                let (angle, strength) = field.crack_direction(at);
                (strength > 0.0).then(|| (nearer(angle), length * self.strongest_stress / strength))
            }
        }
    }

    fn draw(&mut self, trace: u32) -> f64 {
        let tip = &mut self.done.tips[trace as usize];
        tip.draws += 1;
        let stream = u64::from(trace) - self.done.borders as u64;
        random::unit(self.settings.seed, stream, u64::from(tip.draws))
    }

    /// A tip has come to another trace: it stops there, if both have come that far.
    fn stop(&mut self, number: u32, other: u32, now: f64) {
        let run = self.done.runs[number as usize];
        let slack = self.done.resolution;
        if run.to + 2.0 * slack < now {
            return;
        }
        let tip = self.done.tips[run.trace as usize];
        let just_stopped = !tip.running && tip.end != NONE && now < run.to + slack;
        if tip.run != number || !(tip.running || just_stopped) {
            return;
        }
        let hit = self.done.runs[other as usize];
        let Some(meeting) = run.meet(&hit, slack) else { return };
        let place = meeting.second.min(hit.to);
        if meeting.second > hit.to + slack {
            return;
        }
        if just_stopped {
            // More than two come together in one point: all their traces share its vertex.
            self.mark(hit.trace, place, tip.end);
            return;
        }
        let vertex = if run.vertex != NONE && now - run.from < slack {
            run.vertex
        } else {
            let vertex = self.vertex(hit.point(meeting.second));
            self.mark(run.trace, now, vertex);
            vertex
        };
        self.mark(hit.trace, place, vertex);
        self.done.runs[number as usize].to = now.max(run.from);
        self.done.tips[run.trace as usize].end = vertex;
        self.halt(run.trace, hit.trace);
    }

    fn halt(&mut self, trace: u32, stopped_by: u32) {
        let tip = &mut self.done.tips[trace as usize];
        tip.running = false;
        tip.stopped_by = stopped_by;
        if tip.kind == Kind::Branch {
            self.trees[tip.tree as usize].running -= 1;
        }
    }
}

fn direction(angle: f64) -> DVec2 {
    let (sin, cos) = libm::sincos(angle);
    DVec2::new(cos, sin)
}

fn rotated(heading: DVec2, angle: f64) -> DVec2 {
    heading.rotate(direction(angle)).normalize()
}

/// About how many pieces there will be.
fn expected_pieces(outline: &Polygon, settings: &Settings) -> f64 {
    let count = settings.nuclei.len() as f64;
    let share = libm::sqrt(outline.area() / count);
    let arms: usize = settings.nuclei.iter().map(|n| n.arms.len()).sum();
    arms as f64 + count * share / settings.critical_length
}

/// Edge of the grid's cells [m]: about the distance between neighbouring cracks.
fn cell_size(outline: &Polygon, settings: &Settings, pieces: f64, extent: f64) -> f64 {
    let spacing = libm::sqrt(outline.area() / pieces);
    // Where cracks turn often their runs are short, and smaller cells hold fewer of them.
    let spacing = if settings.turns() { spacing.min(8.0 * settings.wiggle.spacing) } else { spacing };
    spacing.clamp(extent / MOST_CELLS, extent / 8.0)
}
