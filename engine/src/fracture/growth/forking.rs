//! Which tip of a tree forks, when, and whether it has room.

use glam::DVec2;

use super::{Growth, Happening, Kind, rotated};
use crate::fracture::run::{NONE, Run};
use crate::fracture::settings::{Forking, Order};

/// The widest angle a fork grows to with depth [rad].
const WIDEST_FORK: f64 = 0.95 * core::f64::consts::PI;
/// Tips that are asked whether they have room, at one fork.
const CANDIDATES: usize = 4;

impl Growth<'_> {
    /// Sets the time of a tree's next fork.
    pub(super) fn tick(&mut self, tree: u32, depth: u16, now: f64) {
        let state = &self.trees[tree as usize];
        if state.running == 0 {
            return;
        }
        let slower = match self.settings.forking {
            Forking::Never => return,
            Forking::Literal(_) => 1.0,
            Forking::Driven { .. } => f64::from(state.most) / f64::from(state.running),
        };
        let deeper = deep(self.settings.depth.critical_length, depth);
        let interval = self.settings.critical_length * slower * deeper;
        self.queue.schedule(now + interval, Happening::Fork { tree });
    }

    pub(super) fn fork_one(&mut self, tree: u32, now: f64) {
        let mut depth = 0;
        for _candidate in 0..CANDIDATES {
            let Some(trace) = self.next_candidate(tree) else { break };
            let Some(branches) = self.branches(trace, now) else {
                self.trees[tree as usize].waiting.push_back(trace);
                continue;
            };
            depth = self.done.tips[trace as usize].depth + 1;
            self.fork(trace, branches, now);
            break;
        }
        self.tick(tree, depth, now);
    }

    /// The tip of a tree whose turn it is to fork.
    pub(super) fn next_candidate(&mut self, tree: u32) -> Option<u32> {
        let random = matches!(self.settings.forking, Forking::Literal(Order::Random));
        let (tips, waiting) = (&self.done.tips, &mut self.trees[tree as usize].waiting);
        if random {
            waiting.retain(|&tip| tips[tip as usize].running);
            let last = *waiting.back()?;
            let pick = (self.draw(last) * self.trees[tree as usize].waiting.len() as f64) as usize;
            return self.trees[tree as usize].waiting.remove(pick);
        }
        loop {
            let trace = waiting.pop_front()?;
            if tips[trace as usize].running {
                return Some(trace);
            }
        }
    }

    /// Directions of a tip's two branches, left and right, if it may fork here.
    pub(super) fn branches(&mut self, trace: u32, now: f64) -> Option<[DVec2; 2]> {
        let settings = self.settings;
        let tip = self.done.tips[trace as usize];
        let angle = (settings.fork_angle * deep(settings.depth.fork_angle, tip.depth)).min(WIDEST_FORK);
        let heading = self.done.runs[tip.run as usize].direction;
        let branches = [0.5, -0.5].map(|side| {
            let varied = angle + settings.fork_variance * (self.draw(trace) - 0.5);
            rotated(heading, side * varied)
        });
        match settings.forking {
            Forking::Driven { room } if room > 0.0 => branches
                .iter()
                .all(|&branch| self.has_room(tip.run, now, branch, room, now))
                .then_some(branches),
            _ => Some(branches),
        }
    }

    /// Whether a branch could run for `room` [m] from where a run was at `at`, past the traces that are there now.
    pub(super) fn has_room(&self, number: u32, at: f64, heading: DVec2, room: f64, now: f64) -> bool {
        let from = self.done.runs[number as usize].point(at);
        let mut done = 0.0;
        while done < room {
            let length = self.grid.cell.min(room - done);
            let probe = Run {
                origin: from + heading * done,
                direction: heading,
                from: done,
                to: done + length,
                trace: NONE,
                previous: number,
                vertex: NONE,
                mark: 0,
            };
            let slack = self.done.resolution;
            let sketch = self.grid.sketch(probe.origin, probe.point(probe.to));
            for cell in self.grid.cells(&sketch) {
                let blocked = self.grid.near(cell, &sketch).any(|index| {
                    let other = &self.done.runs[index as usize];
                    index != number
                        && probe.meet(other, slack).is_some_and(|m| {
                            m.first > slack && other.time(m.second) <= now && m.second <= other.to + slack
                        })
                });
                if blocked {
                    return false;
                }
            }
            done += length;
        }
        true
    }

    /// Ends a tip where it is, and starts two from there.
    pub(super) fn fork(&mut self, trace: u32, branches: [DVec2; 2], now: f64) {
        let tip = self.done.tips[trace as usize];
        let run = self.done.runs[tip.run as usize];
        let origin = run.point(now);
        let vertex = self.vertex(origin);
        self.mark(trace, now, vertex);
        self.halt(trace, NONE);
        // A run that has only just begun comes to nothing: the branches go on from its predecessor.
        let just_begun = now - run.from < self.done.resolution && run.previous != NONE;
        self.done.runs[tip.run as usize].to = if just_begun { f64::NEG_INFINITY } else { now };
        let parent = if just_begun { run.previous } else { tip.run };
        let mut children = branches.map(|heading| {
            let child = self.new_tip(tip.tree, tip.depth + 1, tip.run, Kind::Branch, now);
            self.start(child, origin, heading, vertex, parent, now);
            child
        });
        if self.draw(trace) < 0.5 {
            children.reverse();
        }
        self.trees[tip.tree as usize].waiting.extend(children);
    }
}

/// A factor a fork, after `depth` forks: at most sixteen-fold either way, or a tree could fork without end.
fn deep(factor: f64, depth: u16) -> f64 {
    if factor == 1.0 {
        return 1.0;
    }
    libm::pow(factor, f64::from(depth)).clamp(1.0 / 16.0, 16.0)
}
