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
#[derive(Debug, Clone, Copy)]
pub(super) struct Run {
    pub origin: DVec2,
    pub direction: DVec2,
    /// `at` of the origin.
    pub from: f64,
    /// `at` of the end: planned while the tip runs, then where it ended.
    pub to: f64,
    /// The tip that cuts it; the border's edges come first.
    pub trace: u32,
    /// The run it goes on from, or on which it starts: the two touch without meeting.
    pub previous: u32,
    /// The vertex at its origin; `NONE` where it goes straight on.
    pub vertex: u32,
    /// Whether it was there before any crack.
    pub border: bool,
}

/// Where two runs meet.
#[derive(Debug, Clone, Copy)]
pub(super) struct Meeting {
    /// `at` of the place on the first run.
    pub first: f64,
    /// `at` of the place on the second run.
    pub second: f64,
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
        if self.border { f64::NEG_INFINITY } else { at }
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
        inside.then(|| Meeting { first: self.from + along, second: other.from + across })
    }

    /// The same for two runs on one line: a tip that comes to where the other one started, or both head-on.
    fn meet_in_line(&self, other: &Run, gap: DVec2, slack: f64) -> Option<Meeting> {
        if gap.perp_dot(self.direction).abs() > slack {
            return None;
        }
        let start = gap.dot(self.direction);
        let sense = self.direction.dot(other.direction);
        let end = start + sense * (other.to - other.from);
        if start.max(end) < -slack || start.min(end) > self.to - self.from + slack {
            return None;
        }
        let place = if sense > 0.0 {
            start
        } else if other.border {
            end
        } else {
            // Both at the same place at the same time, or where the later one starts.
            (0.5 * (start + other.from - self.from)).clamp(0.0, start.max(0.0))
        };
        let place = place.clamp(-slack, self.to - self.from + slack);
        Some(Meeting { first: self.from + place, second: other.from + (place - start) * sense })
    }
}

/// A uniform grid of lists of runs, to find who may meet whom.
#[derive(Debug)]
pub(super) struct Grid {
    low: DVec2,
    inverse: f64,
    /// Edge of a cell [m]: no run is longer.
    pub cell: f64,
    columns: usize,
    rows: usize,
    /// Head of each cell's list.
    heads: Vec<u32>,
    /// Runs with the next entry of the same list.
    entries: Vec<(u32, u32)>,
}

impl Grid {
    /// A grid over the rectangle from `low` to `high` with cells of about `cell` [m].
    pub fn new(low: DVec2, high: DVec2, cell: f64) -> Self {
        let size = high - low;
        let count = |length: f64| (length / cell) as usize + 1;
        let (columns, rows) = (count(size.x), count(size.y));
        Self {
            low,
            inverse: 1.0 / cell,
            cell,
            columns,
            rows,
            heads: vec![NONE; columns * rows],
            entries: Vec::new(),
        }
    }

    /// Cells that the box round a segment touches, `slack` [m] wider than it.
    pub fn cells(&self, a: DVec2, b: DVec2, slack: f64) -> impl Iterator<Item = usize> + use<> {
        let low = (a.min(b) - self.low - slack) * self.inverse;
        let high = (a.max(b) - self.low + slack) * self.inverse;
        let clamp = |x: f64, count: usize| (x.max(0.0) as usize).min(count - 1);
        let columns = clamp(low.x, self.columns)..=clamp(high.x, self.columns);
        let width = self.columns;
        (clamp(low.y, self.rows)..=clamp(high.y, self.rows))
            .flat_map(move |row| columns.clone().map(move |column| row * width + column))
    }

    /// Runs that have been put into a cell.
    pub fn list(&self, cell: usize) -> impl Iterator<Item = u32> + '_ {
        let mut next = self.first(cell);
        core::iter::from_fn(move || {
            let (run, after) = self.entry(next)?;
            next = after;
            Some(run)
        })
    }

    /// The first entry of a cell's list.
    #[inline]
    pub fn first(&self, cell: usize) -> u32 {
        self.heads[cell]
    }

    /// The run at an entry and the entry after it; `None` at the end of a list.
    #[inline]
    pub fn entry(&self, entry: u32) -> Option<(u32, u32)> {
        self.entries.get(entry as usize).copied()
    }

    /// Puts a run into a cell.
    pub fn put(&mut self, cell: usize, run: u32) {
        self.entries.push((run, self.heads[cell]));
        self.heads[cell] = (self.entries.len() - 1) as u32;
    }
}
