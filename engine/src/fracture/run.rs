//! A straight stretch of a crack or of the pane's border, and where two of them meet.

use glam::DVec2;

/// No run, vertex or tip.
pub(super) const NONE: u32 = u32::MAX;

/// Two directions whose sine is below this are parallel.
const PARALLEL: f64 = 1e-11;

/// A straight stretch of a trace.
///
/// A trace is all that one tip cuts, or one edge of the border. A place on it is given by `at`: for a crack the
/// growth at which the tip came by [m], for the border the distance along its edge [m].
///
/// It fills one cache line: looking for meetings is a walk from run to run.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(super) struct Run {
    pub origin: DVec2,
    pub direction: DVec2,
    /// `at` of the origin.
    pub from: f64,
    /// `at` of the end: planned while the tip runs, then where it ended. Before `from` for a run that came to
    /// nothing, which nobody meets.
    pub to: f64,
    /// The tip that cuts it; the border's edges come first.
    pub trace: u32,
    /// The run it goes on from, or on which it starts: the two touch without meeting.
    pub previous: u32,
    /// The vertex at its origin; `NONE` where it goes straight on.
    pub vertex: u32,
    /// The last run that was checked against it; [`BORDER`] in the top bit for what was there before any crack.
    pub mark: u32,
}

/// The flag of the border's runs in their mark.
pub(super) const BORDER: u32 = 1 << 31;

/// Where two runs meet.
#[derive(Debug, Clone, Copy)]
pub(super) struct Meeting {
    /// `at` of the place on the first run.
    pub first: f64,
    /// `at` of the place on the second run.
    pub second: f64,
    /// Whether both come there on one line from opposite sides, so that neither passes.
    pub head_on: bool,
}

impl Run {
    /// The point at `at` [m].
    #[inline]
    pub fn point(&self, at: f64) -> DVec2 {
        self.origin + self.direction * (at - self.from)
    }

    /// When the tip comes by a place, as growth [m]: the border was always there.
    #[inline]
    pub fn time(&self, at: f64) -> f64 {
        if self.is_border() { f64::NEG_INFINITY } else { at }
    }

    /// Whether it was there before any crack.
    #[inline]
    pub fn is_border(&self) -> bool {
        self.mark & BORDER != 0
    }

    /// Notes that the run number `by` is being checked against this one; says whether that is new.
    #[inline]
    pub fn note(&mut self, by: u32) -> bool {
        let mark = by | (self.mark & BORDER);
        let new = self.mark != mark;
        self.mark = mark;
        new
    }

    /// Whether this run, number `own`, and another one touch by construction.
    #[inline]
    pub fn adjoins(&self, own: u32, other: &Run, number: u32) -> bool {
        self.previous == number
            || other.previous == own
            || (self.vertex != NONE && self.vertex == other.vertex)
    }

    /// Where this run crosses another one, both taken longer by `slack` [m] at either end so that no crossing is
    /// lost to rounding.
    #[inline]
    pub fn meet(&self, other: &Run, slack: f64) -> Option<Meeting> {
        if other.to < other.from {
            return None;
        }
        let gap = other.origin - self.origin;
        let sine = self.direction.perp_dot(other.direction);
        if sine.abs() < PARALLEL {
            return self.meet_in_line(other, gap, slack);
        }
        let along = gap.perp_dot(other.direction) / sine;
        let across = gap.perp_dot(self.direction) / sine;
        let inside = along >= -slack
            && along <= self.to - self.from + slack
            && across >= -slack
            && across <= other.to - other.from + slack;
        inside.then_some(Meeting { first: self.from + along, second: other.from + across, head_on: false })
    }

    /// The same for two runs on one line: a tip that comes to where the other one started, or both head-on.
    fn meet_in_line(&self, other: &Run, gap: DVec2, slack: f64) -> Option<Meeting> {
        if gap.perp_dot(self.direction).abs() > slack {
            return None;
        }
        let start = gap.dot(self.direction);
        let sense = self.direction.dot(other.direction);
        let end = start + sense * (other.to - other.from);
        // Half of the way between two that are under way towards each other; a tip that starts on the other's trace
        // meets it there. What lies before a run that only goes on was settled when its predecessor was laid out.
        let half = 0.5 * (start + other.from - self.from);
        let towards = sense < 0.0 && !other.is_border();
        let (place, head_on) = if !towards {
            // One that starts on the trace of another, along it, meets it at once.
            let first = start.min(end);
            (if first < 0.0 && self.vertex != NONE { 0.0 } else { first }, false)
        } else if half < 0.0 && self.vertex != NONE {
            (0.0, false)
        } else if half > start && other.vertex != NONE {
            (start, false)
        } else {
            (half, true)
        };
        let (low, high) = (start.min(end), start.max(end));
        let inside = |x: f64, from: f64, to: f64| x >= from - slack && x <= to + slack;
        if !inside(place, 0.0, self.to - self.from) || !inside(place, low, high) {
            return None;
        }
        Some(Meeting { first: self.from + place, second: other.from + (place - start) * sense, head_on })
    }
}
