//! A uniform grid of lists of runs, to find who may meet whom.
//!
//! In a pane of a million pieces whatever is looked at is far away in memory, so a cell's list is short and tells
//! without its runs which of them are worth fetching.

use glam::{DVec2, Vec2};

use super::run::NONE;

/// Where a run lies, roughly: its ends in cells of the grid from its corner.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sketch {
    ends: [Vec2; 2],
}

/// What rounding costs at most, and more [cells]: a sketch is good to a six-thousandth of a cell along each axis, a
/// block to a sixteen-thousandth.
const BLUR: f32 = 2e-3;

/// A cell of the grid.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell {
    index: usize,
    /// Its corner [cells].
    corner: Vec2,
}

/// Lists of runs, cell by cell.
#[derive(Debug)]
pub(super) struct Grid {
    low: DVec2,
    inverse: f64,
    /// Edge of a cell [m]: no run of a crack is longer.
    pub cell: f64,
    columns: usize,
    rows: usize,
    /// The newest block of each cell's list.
    heads: Vec<u32>,
    blocks: Vec<Block>,
}

/// Runs in one block: most cells need no second one.
const BLOCK: usize = 10;
/// Most blocks that are made room for ahead.
const MOST_RESERVED: usize = 1_000_000;
/// Steps of a block's coordinates in a cell. They reach four cells either way, farther than any run that touches it.
const STEPS: f32 = 8192.0;

/// Some runs of a cell, in a pair of cache lines: their ends in steps from the cell's corner.
#[derive(Debug, Clone, Copy)]
#[repr(align(128))]
struct Block {
    from_x: [i16; BLOCK],
    from_y: [i16; BLOCK],
    to_x: [i16; BLOCK],
    to_y: [i16; BLOCK],
    runs: [u32; BLOCK],
    count: u32,
    next: u32,
}

impl Block {
    fn new(next: u32) -> Self {
        let [from_x, from_y, to_x, to_y] = [[0; BLOCK]; 4];
        Self { from_x, from_y, to_x, to_y, runs: [NONE; BLOCK], count: 0, next }
    }

    fn push(&mut self, [from, to]: [Vec2; 2], run: u32) {
        let at = self.count as usize;
        let rounded = |x: f32| ((x + 32_768.5) as i32 - 32_768) as i16;
        (self.from_x[at], self.from_y[at]) = (rounded(from.x), rounded(from.y));
        (self.to_x[at], self.to_y[at]) = (rounded(to.x), rounded(to.y));
        self.runs[at] = run;
        self.count += 1;
    }

    /// Whether a run may meet one between two places [steps]: neither lies wholly on one side of the other.
    #[inline]
    fn may_meet(&self, i: usize, ends: [Vec2; 2]) -> bool {
        let own = [
            Vec2::new(f32::from(self.from_x[i]), f32::from(self.from_y[i])),
            Vec2::new(f32::from(self.to_x[i]), f32::from(self.to_y[i])),
        ];
        !to_one_side(ends, own) && !to_one_side(own, ends)
    }
}

/// Whether the second of two runs lies wholly on one side of the first [steps].
#[inline]
fn to_one_side([from, to]: [Vec2; 2], other: [Vec2; 2]) -> bool {
    let along = to - from;
    // What rounding does to `along` counts over the whole distance to the other run, however short this one is.
    let blur = BLUR * STEPS * (STEPS + along.x.abs() + along.y.abs());
    let sides = other.map(|end| along.perp_dot(end - from));
    (sides[0] > blur && sides[1] > blur) || (sides[0] < -blur && sides[1] < -blur)
}

impl Grid {
    /// A grid over the rectangle from `low` to `high` with cells of `cell` [m].
    pub fn new(low: DVec2, high: DVec2, cell: f64) -> Self {
        let size = high - low;
        let count = |length: f64| (length / cell) as usize + 1;
        let (columns, rows) = (count(size.x), count(size.y));
        let heads = vec![NONE; columns * rows];
        let blocks = Vec::with_capacity(heads.len().min(MOST_RESERVED));
        Self { low, inverse: 1.0 / cell, cell, columns, rows, heads, blocks }
    }

    /// Where a run from `a` to `b` lies [m].
    #[inline]
    pub fn sketch(&self, a: DVec2, b: DVec2) -> Sketch {
        Sketch { ends: [a, b].map(|end| ((end - self.low) * self.inverse).as_vec2()) }
    }

    /// Cells that a run touches.
    #[inline]
    pub fn cells(&self, sketch: &Sketch) -> impl Iterator<Item = Cell> + use<> {
        let [a, b] = sketch.ends;
        let (low, high) = (a.min(b) - BLUR, a.max(b) + BLUR);
        let clamp = |x: f32, count: usize| (x.max(0.0) as usize).min(count - 1);
        let columns = clamp(low.x, self.columns)..=clamp(high.x, self.columns);
        let width = self.columns;
        let cells = (clamp(low.y, self.rows)..=clamp(high.y, self.rows)).flat_map(move |row| {
            columns.clone().map(move |column| Cell {
                index: row * width + column,
                corner: Vec2::new(column as f32, row as f32),
            })
        });
        // Of the cells in its box a slanting run passes by some.
        let along = b - a;
        let reach = 0.5 * (along.x.abs() + along.y.abs()) + BLUR;
        cells.filter(move |cell| along.perp_dot(cell.corner + 0.5 - a).abs() <= reach)
    }

    /// Runs in a cell that one may meet, the newest block first.
    #[inline]
    pub fn near(&self, cell: Cell, sketch: &Sketch) -> impl Iterator<Item = u32> + use<'_> {
        let ends = cell.steps(sketch);
        let first = self.blocks.get(self.heads[cell.index] as usize);
        core::iter::successors(first, |block| self.blocks.get(block.next as usize)).flat_map(move |block| {
            (0..block.count as usize).filter(move |&i| block.may_meet(i, ends)).map(|i| block.runs[i])
        })
    }

    /// Puts a run into a cell.
    pub fn put(&mut self, cell: Cell, sketch: &Sketch, run: u32) {
        let head = &mut self.heads[cell.index];
        if self.blocks.get(*head as usize).is_none_or(|block| block.count as usize == BLOCK) {
            let next = core::mem::replace(head, self.blocks.len() as u32);
            self.blocks.push(Block::new(next));
        }
        self.blocks[*head as usize].push(cell.steps(sketch), run);
    }
}

impl Cell {
    /// The ends of a run in steps from the cell's corner.
    #[inline]
    fn steps(self, sketch: &Sketch) -> [Vec2; 2] {
        sketch.ends.map(|end| (end - self.corner) * STEPS)
    }
}
