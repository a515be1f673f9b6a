//! A finished crack pattern.

use core::ops::ControlFlow;

use glam::DVec2;

use super::graph::{self, Faces};
use super::growth::{Growth, Traces};
use super::outline;
use super::run::NONE;
use super::settings::Settings;
use crate::error::{Error, Result};
use crate::geometry::{Polygon, bounds};

/// A straight stretch of crack, from where a tip started or turned to where it turned, forked or stopped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crack {
    /// Its ends [m], in the order in which they were cut.
    pub ends: [DVec2; 2],
    /// Growth of the first cracks when each end was cut [m]; a [`CrackClock`](super::CrackClock) makes it a time.
    pub growth: [f64; 2],
    /// The crack it goes on or branches from; `None` at a nucleus.
    pub parent: Option<u32>,
    /// Number of the tip that cut it.
    pub tip: u32,
    /// What stopped its tip in the end, where something did.
    pub stopped_by: Option<Stopper>,
}

/// What stopped a tip.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stopper {
    /// The trace of a tip.
    Tip(u32),
    /// An edge of the outline, counted ring after ring.
    Border(u32),
}

/// Cracks and fragments of a pane.
#[derive(Debug)]
pub struct Pattern {
    /// Cracks, each after its parent.
    pub cracks: Vec<Crack>,
    faces: Faces,
}

/// Cracks that have grown, before their fragments are known: the first half of the work.
#[derive(Debug)]
pub struct Cracks<'a> {
    traces: Traces,
    settings: &'a Settings,
    area: f64,
}

impl<'a> Cracks<'a> {
    /// Grows cracks in a pane; see [`Pattern::grow_observed`].
    ///
    /// # Errors
    /// Those of [`Pattern::grow_observed`].
    pub fn grow(
        outline: &Polygon,
        settings: &'a Settings,
        observer: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Self> {
        outline::check(outline)?;
        settings.validate()?;
        fits(outline, settings)?;
        let traces = Growth::new(outline, settings).finish(observer)?;
        Ok(Self { traces, settings, area: outline.area() })
    }

    /// Finds the fragments.
    pub fn into_pattern(self) -> Pattern {
        let cracks = cracks(&self.traces, self.settings);
        let faces = graph::faces(&self.traces, self.settings);
        let pattern = Pattern { cracks, faces };
        assert!(pattern.fills(self.area), "fragments do not fill the pane");
        pattern
    }
}

/// One fragment of a pattern.
#[derive(Debug, Clone, Copy)]
pub struct Fragment<'a> {
    faces: &'a Faces,
    index: usize,
}

/// More pieces than this would not fit into 32-bit numbers.
pub(super) const MOST_PIECES: f64 = 5e7;

impl Pattern {
    /// Grows cracks in a pane and finds the fragments.
    ///
    /// `outline` bounds the pane [m]: a simple polygon, counter-clockwise, holes clockwise.
    ///
    /// # Errors
    /// What [`outline::check`] and [`Settings::validate`] refuse; a nucleus outside the pane; a critical length
    /// longer than the pane; settings that would give more than 50 million pieces.
    pub fn grow(outline: &Polygon, settings: &Settings) -> Result<Self> {
        Self::grow_observed(outline, settings, &mut || ControlFlow::Continue(()))
    }

    /// The same for work that may take long: `observer` is asked every few milliseconds, and may break it off.
    ///
    /// # Errors
    /// Those of [`grow`](Self::grow), and [`Error::Cancelled`].
    pub fn grow_observed(
        outline: &Polygon,
        settings: &Settings,
        observer: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Self> {
        Ok(Cracks::grow(outline, settings, observer)?.into_pattern())
    }

    /// How many fragments there are.
    pub fn len(&self) -> usize {
        self.faces.face_ends.len()
    }

    /// Whether there is none; a pane always has one.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Fragments in a fixed order.
    pub fn fragments(&self) -> impl ExactSizeIterator<Item = Fragment<'_>> + Clone {
        (0..self.len()).map(|index| Fragment { faces: &self.faces, index })
    }

    /// One fragment; panics beyond the last.
    pub fn fragment(&self, index: usize) -> Fragment<'_> {
        assert!(index < self.len(), "there are {} fragments", self.len());
        Fragment { faces: &self.faces, index }
    }

    /// All vertices [m]; fragments name them by number.
    pub fn vertices(&self) -> &[DVec2] {
        &self.faces.vertices
    }

    /// What the arrays hold, in bytes, without spare room.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.cracks[..]) + self.faces.bytes()
    }

    fn fills(&self, area: f64) -> bool {
        let mut polygon = Polygon::default();
        let sum: f64 = self
            .fragments()
            .map(|fragment| {
                fragment.outline(&mut polygon);
                polygon.area()
            })
            .sum();
        (sum - area).abs() <= 1e-9 * area
    }
}

impl<'a> Fragment<'a> {
    /// Its rings as numbers of vertices: the outline counter-clockwise, then holes clockwise.
    pub fn rings(self) -> impl ExactSizeIterator<Item = &'a [u32]> {
        let faces = self.faces;
        self.ring_numbers().map(move |ring| &faces.rings[faces.ring_range(ring)])
    }

    /// For each ring, whether the side from each vertex to the next is a piece of the pane's border.
    pub fn on_border(self) -> impl ExactSizeIterator<Item = &'a [bool]> {
        let faces = self.faces;
        self.ring_numbers().map(move |ring| &faces.on_border[faces.ring_range(ring)])
    }

    /// Writes its polygon into a buffer.
    pub fn outline(self, polygon: &mut Polygon) {
        polygon.clear();
        for ring in self.rings() {
            polygon.push_ring(ring.iter().map(|&v| self.faces.vertices[v as usize]));
        }
    }

    /// Growth of the first cracks when its outline closed [m]; 0 where the border alone bounds it.
    pub fn closed_at(self) -> f64 {
        self.faces.closed_at[self.index]
    }

    fn ring_numbers(self) -> core::ops::Range<usize> {
        let start = if self.index == 0 { 0 } else { self.faces.face_ends[self.index - 1] as usize };
        start..self.faces.face_ends[self.index] as usize
    }
}

impl Faces {
    fn bytes(&self) -> usize {
        size_of_val(&self.vertices[..])
            + size_of_val(&self.rings[..])
            + size_of_val(&self.on_border[..])
            + size_of_val(&self.ring_ends[..])
            + size_of_val(&self.face_ends[..])
            + size_of_val(&self.closed_at[..])
    }

    fn ring_range(&self, ring: usize) -> core::ops::Range<usize> {
        let start = if ring == 0 { 0 } else { self.ring_ends[ring - 1] as usize };
        start..self.ring_ends[ring] as usize
    }
}

/// Cracks turn at most ten thousand times along the pane's longer side.
const SHORTEST_STEP: f64 = 0.999e-4;

fn fits(outline: &Polygon, settings: &Settings) -> Result<()> {
    let (low, high) = bounds(outline.points().iter().copied());
    let size = (high - low).max_element();
    if settings.critical_length > size {
        return Err(Error::OutOfRange {
            what: "critical length [m]",
            value: settings.critical_length,
            expected: "at most the longer side of the pane",
        });
    }
    if let Some(outside) = settings.nuclei.iter().find(|n| !outline::contains(outline, n.position)) {
        let at = outside.position;
        return Err(Error::Malformed(format!(
            "a crack starts at ({}, {}), which is outside the pane; give a point inside it",
            at.x, at.y
        )));
    }
    let shortest = SHORTEST_STEP * size;
    let steps = [
        ("wiggle spacing [m]", settings.turns().then_some(settings.wiggle.spacing)),
        ("spacing of rings [m]", settings.rings.map(|rings| rings.spacing)),
    ];
    for (what, step) in steps {
        if let Some(value) = step.filter(|&step| step < shortest) {
            let expected = "at least a ten-thousandth of the pane's longer side";
            return Err(Error::OutOfRange { what, value, expected });
        }
    }
    let share = libm::sqrt(outline.area() / settings.nuclei.len() as f64);
    let pieces = settings.nuclei.len() as f64 * share / settings.critical_length;
    if pieces > MOST_PIECES {
        return Err(Error::Malformed(format!(
            "a critical length of {} m would give some {pieces:.0} pieces; at most {MOST_PIECES:.0} are possible",
            settings.critical_length
        )));
    }
    Ok(())
}

/// Runs joined into straight stretches.
fn cracks(traces: &Traces, settings: &Settings) -> Vec<Crack> {
    let mut cracks: Vec<Crack> = Vec::new();
    let mut crack_of: Vec<u32> = vec![NONE; traces.runs.len()];
    let borders = traces.borders as u32;
    for (index, run) in traces.runs.iter().enumerate().filter(|(_, run)| !run.is_border()) {
        let parent = if run.previous == NONE { NONE } else { crack_of[run.previous as usize] };
        let to = run.to.max(run.from);
        if run.vertex == NONE || (to == run.from && parent != NONE) {
            crack_of[index] = parent;
            let crack = &mut cracks[parent as usize];
            if to > run.from {
                crack.ends[1] = run.point(to);
                crack.growth[1] = to;
            }
            continue;
        }
        crack_of[index] = cracks.len() as u32;
        let by = traces.tips[run.trace as usize].stopped_by;
        cracks.push(Crack {
            ends: [run.origin, run.point(to)],
            growth: [run.from, to],
            parent: (parent != NONE).then_some(parent),
            tip: run.trace - borders,
            stopped_by: (by != NONE)
                .then(|| if by < borders { Stopper::Border(by) } else { Stopper::Tip(by - borders) }),
        });
    }
    if !settings.fronts.is_empty() {
        for crack in &mut cracks {
            let delays = crack.ends.map(|end| settings.delay(end));
            crack.growth = [crack.growth[0] + delays[0], crack.growth[1] + delays[1]];
        }
    }
    cracks
}
