//! Where the load on a piece is sampled: a few panels that stand for its face (thesis 6.2, Fig. 6.2).

use glam::DVec2;

use super::{PlaneMoments, Polygon};

/// One panel of a piece's face.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Sample {
    /// Its middle [m], from the centroid of the piece.
    pub centre: DVec2,
    /// Its area [m²].
    pub area: f64,
}

/// The fewest panels of a piece: as many as the thesis asks for.
const LEAST_SAMPLES: usize = 5;

/// Cells below this share of the face are joined to another: their middle would be rounding.
const LEAST_SHARE: f64 = 1e-3;

/// Half the width of the middle column over the radius of gyration along the long axis: 1/√3 cuts a rectangle
/// in thirds.
const MIDDLE: f64 = 0.577_350_269_189_625_8;

/// Adds the panels of a piece's face to `samples`: five or six, on both sides of its long axis and along it.
///
/// The face is cut by its own principal axes: along the long one into two sides, and across into three columns.
/// Each panel is the part of the face in one of the six cells, with that part's area and centroid. A bent piece
/// may have nothing in some cell; the largest of the others is then halved until there are five.
///
/// The areas, added in order, give `moments.area` to one unit in the last place. The centres, weighted with the
/// areas, have their mean at the centroid to rounding: an even pressure does not turn the piece. A panel's centre
/// lies in the convex hull of its part, so that of a bent piece may lie beside the piece.
///
/// `moments` are those of `polygon`, with an area above 0.
pub fn sample_panels(polygon: &Polygon, moments: &PlaneMoments, samples: &mut Vec<Sample>) {
    let axis = moments.long_axis();
    let mut grid = Grid::new(MIDDLE * libm::sqrt(moments.principal()[0] / moments.area));
    for (p, q) in polygon.sides() {
        let along_axes = |r: DVec2| DVec2::new(axis.dot(r), axis.perp_dot(r));
        grid.add_side(along_axes(p - moments.centroid), along_axes(q - moments.centroid));
    }
    let (mut cells, mut count) = grid.joined(LEAST_SHARE * moments.area);
    while count < LEAST_SAMPLES {
        halve_largest(&mut cells[..=count]);
        count += 1;
    }
    balance(&mut cells[..count], moments.area);
    samples.extend(cells[..count].iter().map(|cell| {
        let centre = axis.rotate(cell.first / cell.area);
        Sample { centre, area: cell.area }
    }));
}

/// The part of the face in one cell, in coordinates along and across the long axis, from the centroid.
#[derive(Debug, Clone, Copy)]
struct Cell {
    area: f64,
    /// `∫ r dA`.
    first: DVec2,
    /// How far it reaches along the axis.
    low: f64,
    high: f64,
}

impl Cell {
    const EMPTY: Self = Self { area: 0.0, first: DVec2::ZERO, low: f64::INFINITY, high: f64::NEG_INFINITY };
}

/// The face cut into two rows by its long axis, and into three columns across it.
struct Grid {
    cells: [Cell; 6],
    /// The middle column reaches from `-middle` to `middle`.
    middle: f64,
}

impl Grid {
    fn new(middle: f64) -> Self {
        Self { cells: [Cell::EMPTY; 6], middle }
    }

    fn cell_at(&self, p: DVec2) -> usize {
        let column = usize::from(p.x > -self.middle) + usize::from(p.x > self.middle);
        column + if p.y > 0.0 { 3 } else { 0 }
    }

    /// Adds one side of the outline, cut where it passes from cell to cell.
    ///
    /// What lies between the side and the long axis is a trapezoid in the side's own cell, taken off where the
    /// outline runs to the right and added where it runs to the left. Summed around the outline, the trapezoids
    /// of a cell leave exactly the part of the face that lies in it (Green's theorem: the cell's own edges have
    /// no width along the axis, or lie on it).
    fn add_side(&mut self, p: DVec2, q: DVec2) {
        let mut stops = [q; 4];
        let mut count = 0;
        let mut stop = |crossing: DVec2| {
            stops[count] = crossing;
            count += 1;
        };
        if p.y * q.y < 0.0 {
            stop(DVec2::new(p.x + (q.x - p.x) * (p.y / (p.y - q.y)), 0.0));
        }
        for x in [-self.middle, self.middle] {
            if (p.x - x) * (q.x - x) < 0.0 {
                stop(DVec2::new(x, p.y + (q.y - p.y) * ((x - p.x) / (q.x - p.x))));
            }
        }
        let order = |r: &DVec2| (r.x - p.x).abs() + (r.y - p.y).abs();
        if count > 1 {
            stops[..count].sort_unstable_by(|a, b| order(a).total_cmp(&order(b)));
        }
        let mut from = p;
        for &to in &stops[..=count] {
            self.add_piece(from, to);
            from = to;
        }
    }

    /// Adds a part of a side that lies in one cell.
    fn add_piece(&mut self, p: DVec2, q: DVec2) {
        let index = self.cell_at(0.5 * (p + q));
        let cell = &mut self.cells[index];
        let run = p.x - q.x;
        cell.area += 0.5 * run * (p.y + q.y);
        cell.first.x += run * (2.0 * (p.x * p.y + q.x * q.y) + p.x * q.y + q.x * p.y) / 6.0;
        cell.first.y += run * (p.y * p.y + p.y * q.y + q.y * q.y) / 6.0;
        cell.low = cell.low.min(p.x).min(q.x);
        cell.high = cell.high.max(p.x).max(q.x);
    }

    /// The cells of at least the given area, with what is in the others joined to the largest, and their number.
    fn joined(self, least: f64) -> ([Cell; 6], usize) {
        let mut kept = [Cell::EMPTY; 6];
        let mut count = 0;
        let mut rest = Cell::EMPTY;
        for cell in self.cells {
            if cell.area >= least {
                kept[count] = cell;
                count += 1;
            } else {
                rest.area += cell.area;
                rest.first += cell.first;
            }
        }
        let largest = largest(&kept[..count]);
        kept[largest].area += rest.area;
        kept[largest].first += rest.first;
        (kept, count)
    }
}

fn largest(cells: &[Cell]) -> usize {
    (0..cells.len()).fold(0, |best, i| if cells[i].area > cells[best].area { i } else { best })
}

/// Replaces the largest cell by two halves side by side along the axis, one of them in the last, free place.
///
/// The halves stand a quarter of the cell's reach to either side of its middle, where those of a rectangle do.
fn halve_largest(cells: &mut [Cell]) {
    let (free, taken) = cells.split_last_mut().expect("a place for the second half");
    let whole = &mut taken[largest(taken)];
    let half = Cell { area: 0.5 * whole.area, first: 0.5 * whole.first, ..*whole };
    let middle = half.first.x / half.area;
    let shift = DVec2::X * (0.25 * (whole.high - whole.low) * half.area);
    *whole = Cell { first: half.first - shift, high: middle, ..half };
    *free = Cell { first: half.first + shift, low: middle, ..half };
}

/// Gives the last cell what rounding has left, so that the areas add up and the moments cancel.
fn balance(cells: &mut [Cell], area: f64) {
    if let Some((last, others)) = cells.split_last_mut() {
        last.area = area - others.iter().map(|cell| cell.area).sum::<f64>();
        last.first = -others.iter().map(|cell| cell.first).sum::<DVec2>();
    }
}
