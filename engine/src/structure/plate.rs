//! A pane as a thin elastic plate that rests on its border: how far even pressure bends it, how strongly that strains
//! it, and how fast it swings.
//!
//! Small deflections (Kirchhoff): a bending stiffness `D = E h³ / 12 (1 − ν²)`, and edges that are held but may turn, as
//! glass in putty or a gasket may. The deflection under even pressure comes from two membranes (Marcus 1932),
//! `∇²m = −p` and `∇²w = −m/D`, both 0 on the border; for straight edges that is the exact plate equation, for curved
//! ones the limit of a polygon of many sides. The border of a hole counts as held too. Both are solved on a grid of [`CELLS`] cells along the longer side, with
//! the true distance to the border in the outermost ones (Shortley and Weller 1938).
//!
//! In time the pane is one mass on one spring: it keeps the shape that even pressure gives it. Its frequency is then
//! Rayleigh's, `ω² = ∫ w dA / ρh ∫ w² dA` for w under unit pressure: above the exact first mode by 0.1 % for
//! a square and 1 % for a rectangle of 1 : 2.5. Stress follows the deflection, so that a slow load gives the stress of plate theory.
//!
//! What it does not know: a pane that is bent by more than half its thickness also stretches, which makes it stiffer;
//! thin panes near breaking are in truth bent and strained less than here.

use glam::DVec2;

use crate::error::{Error, Result, positive};
use crate::geometry::{Polygon, bounds};
use crate::material::Material;

/// Cells of the grid along the longer side of the pane.
pub const CELLS: usize = 40;

/// Most cells along the longer side, for a narrow pane that lies aslant.
const FINEST: f64 = 400.0;

/// Poisson's ratio of a material that none is known of.
const POISSON: f64 = 0.22;

/// How a pane bends under even pressure of 1 Pa, along +z in its own frame.
#[derive(Debug, Clone)]
pub struct Plate {
    grid: Grid,
    /// Deflection at each node [m/Pa]; 0 on the border and beyond.
    deflection: Vec<f64>,
    /// Greatest stress on the face at each node [Pa/Pa].
    stress: Vec<f64>,
    strongest: f64,
    frequency: f64,
    mass_per_area: f64,
    stiffness: f64,
}

/// Nodes in rows from the lower left corner of a pane's bounding box.
#[derive(Debug, Clone)]
struct Grid {
    origin: DVec2,
    /// Distances of nodes along both axes [m].
    spacing: DVec2,
    columns: usize,
    rows: usize,
    /// Nodes inside the pane, with the distance to the next node or to the border toward −x, +x, −y, +y [m].
    inside: Vec<(usize, [f64; 4])>,
}

impl Plate {
    /// Bends a pane of this outline [m], `thickness` [m, above 0] and material.
    ///
    /// # Errors
    /// A thickness that is not above 0, or what [`Material::validate`] refuses.
    pub fn new(outline: &Polygon, thickness: f64, material: &Material) -> Result<Self> {
        positive("thickness of the pane [m]", thickness)?;
        material.validate()?;
        let poisson = material.poisson_ratio.unwrap_or(POISSON);
        let stiffness = material.young_modulus * thickness.powi(3) / (12.0 * (1.0 - poisson * poisson));
        let grid = Grid::over(outline);
        if grid.inside.is_empty() {
            return Err(Error::Malformed("the pane is too narrow for its length to be bent".into()));
        }
        let nodes = grid.columns * grid.rows;
        let moment = grid.membrane(&vec![1.0; nodes]);
        let mut deflection = grid.membrane(&moment);
        deflection.iter_mut().for_each(|w| *w /= stiffness);
        let mut stress = vec![0.0; nodes];
        for &(node, arms) in &grid.inside {
            let curvature = grid.curvature(&deflection, node, arms);
            stress[node] = stiffness * 6.0 / (thickness * thickness) * greatest_moment(curvature, poisson);
        }
        let (mut first, mut second) = (0.0, 0.0);
        for &(node, _) in &grid.inside {
            first += deflection[node];
            second += deflection[node] * deflection[node];
        }
        let mass_per_area = material.density * thickness;
        Ok(Self {
            frequency: libm::sqrt(first / (mass_per_area * second)),
            strongest: stress.iter().copied().fold(0.0, f64::max),
            grid,
            deflection,
            stress,
            mass_per_area,
            stiffness,
        })
    }

    /// Angular frequency ω of its free swing [rad/s].
    pub fn frequency(&self) -> f64 {
        self.frequency
    }

    /// Mass of a square metre [kg/m²].
    pub fn mass_per_area(&self) -> f64 {
        self.mass_per_area
    }

    /// Bending stiffness D [N m].
    pub fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// The greatest stress anywhere on its faces under a pressure of 1 Pa [Pa/Pa].
    pub fn strongest(&self) -> f64 {
        self.strongest
    }

    /// Deflection at a place under a pressure of 1 Pa [m/Pa]; 0 beyond the border.
    pub fn deflection(&self, place: DVec2) -> f64 {
        self.grid.between(&self.deflection, place).0
    }

    /// Slope of the deflection at a place under a pressure of 1 Pa [1/Pa].
    pub fn slope(&self, place: DVec2) -> DVec2 {
        self.grid.between(&self.deflection, place).1
    }

    /// The nodes inside the pane [m], each with the greatest stress there under a pressure of 1 Pa [Pa/Pa].
    pub fn stresses(&self) -> impl Iterator<Item = (DVec2, f64)> + '_ {
        self.grid.inside.iter().map(|&(node, _)| (self.grid.place(node), self.stress[node]))
    }

    /// Distances of those nodes along both axes [m].
    pub fn spacing(&self) -> DVec2 {
        self.grid.spacing
    }
}

/// The greater of the principal moments over the stiffness, whichever face it strains.
fn greatest_moment([xx, yy, xy]: [f64; 3], poisson: f64) -> f64 {
    let (x, y) = (xx + poisson * yy, yy + poisson * xx);
    let twist = (1.0 - poisson) * xy;
    let middle = 0.5 * (x + y);
    middle.abs() + libm::hypot(0.5 * (x - y), twist)
}

impl Grid {
    fn over(outline: &Polygon) -> Self {
        let (low, high) = bounds(outline.points().iter().copied());
        let size = high - low;
        // A pane that is narrow and lies aslant takes finer cells.
        let width = 2.0 * outline.area() / outline.sides().map(|(a, b)| a.distance(b)).sum::<f64>();
        let cell = (size.max_element() / CELLS as f64).min(width / 3.0).max(size.max_element() / FINEST);
        // Square cells, but for a rest: a rectangle's border then runs through nodes.
        let count = |length: f64| (libm::rint(length / cell) as usize).max(8);
        let (across, up) = (count(size.x), count(size.y));
        let spacing = size / DVec2::new(across as f64, up as f64);
        let mut grid = Self { origin: low, spacing, columns: across + 1, rows: up + 1, inside: Vec::new() };
        for row in 1..up {
            let y = low.y + row as f64 * spacing.y;
            let crossings = crossings(outline, y, |p| p);
            for column in 1..across {
                let x = low.x + column as f64 * spacing.x;
                let before = crossings.iter().filter(|&&c| c <= x).count();
                // A node within a hair of the border counts as the border's.
                let near = |c: &f64| (c - x).abs() < 1e-6 * spacing.x;
                if before % 2 == 0 || crossings.iter().any(near) {
                    continue;
                }
                let upright = self::crossings(outline, x, |p| DVec2::new(p.y, p.x));
                if upright.iter().any(|c| (c - y).abs() < 1e-6 * spacing.y) {
                    continue;
                }
                let [left, right] = arms(&crossings, x, spacing.x);
                let [below, above] = arms(&upright, y, spacing.y);
                grid.inside.push((row * grid.columns + column, [left, right, below, above]));
            }
        }
        grid
    }

    fn place(&self, node: usize) -> DVec2 {
        let (column, row) = (node % self.columns, node / self.columns);
        self.origin + DVec2::new(column as f64, row as f64) * self.spacing
    }

    /// The neighbours of a node toward −x, +x, −y, +y.
    fn neighbours(&self, node: usize) -> [usize; 4] {
        [node - 1, node + 1, node - self.columns, node + self.columns]
    }

    /// Values of a membrane under a load, `∇²m = −load`, 0 on the border: by over-relaxation.
    fn membrane(&self, load: &[f64]) -> Vec<f64> {
        let mut value = vec![0.0; load.len()];
        let longer = self.columns.max(self.rows) as f64;
        let relaxation = 2.0 / (1.0 + core::f64::consts::PI / longer);
        let mut stencils = Vec::with_capacity(self.inside.len());
        for &(node, arms) in &self.inside {
            let [left, right, below, above] = arms;
            let weights = [
                2.0 / (left * (left + right)),
                2.0 / (right * (left + right)),
                2.0 / (below * (below + above)),
                2.0 / (above * (below + above)),
            ];
            let centre: f64 = weights.iter().sum();
            let full = self.full(arms);
            let weights = core::array::from_fn(|i| if full[i] { weights[i] / centre } else { 0.0 });
            stencils.push((node, weights, load[node] / centre));
        }
        for _sweep in 0..MOST_SWEEPS {
            let (mut change, mut size) = (0.0_f64, 0.0_f64);
            for &(node, [left, right, below, above], source) in &stencils {
                let [a, b, c, d] = self.neighbours(node);
                let around = left * value[a] + right * value[b] + below * value[c] + above * value[d];
                let step = relaxation * (around + source - value[node]);
                value[node] += step;
                change = change.max(step.abs());
                size = size.max(value[node].abs());
            }
            if change <= CLOSE_ENOUGH * size {
                break;
            }
        }
        value
    }

    /// Which of a node's arms reach the next node, not only the border.
    fn full(&self, arms: [f64; 4]) -> [bool; 4] {
        let step = [self.spacing.x, self.spacing.x, self.spacing.y, self.spacing.y];
        core::array::from_fn(|i| arms[i] == step[i])
    }

    /// Second derivatives xx, yy, xy of a field that is 0 on the border.
    fn curvature(&self, field: &[f64], node: usize, arms: [f64; 4]) -> [f64; 3] {
        let full = self.full(arms);
        let around = self.neighbours(node);
        let at = |i: usize| if full[i] { field[around[i]] } else { 0.0 };
        let second = |i: usize| {
            let (to, from) = (arms[i + 1], arms[i]);
            2.0 * ((at(i + 1) - field[node]) / to - (field[node] - at(i)) / from) / (to + from)
        };
        let (up, down) = (node + self.columns, node - self.columns);
        let corners = field[up + 1] - field[up - 1] - field[down + 1] + field[down - 1];
        [second(0), second(2), corners / (4.0 * self.spacing.x * self.spacing.y)]
    }

    /// A field at a place, linear between nodes, and its slope.
    fn between(&self, field: &[f64], place: DVec2) -> (f64, DVec2) {
        let most = DVec2::new((self.columns - 1) as f64, (self.rows - 1) as f64);
        let at = ((place - self.origin) / self.spacing).clamp(DVec2::ZERO, most);
        let cell = at.floor().min(most - 1.0);
        let part = at - cell;
        let node = cell.y as usize * self.columns + cell.x as usize;
        let [a, b] = [field[node], field[node + 1]];
        let [c, d] = [field[node + self.columns], field[node + self.columns + 1]];
        let (low, high) = (a + (b - a) * part.x, c + (d - c) * part.x);
        let slope = DVec2::new((b - a) + ((d - c) - (b - a)) * part.y, high - low) / self.spacing;
        (low + (high - low) * part.y, slope)
    }
}

/// Sweeps of over-relaxation at most; some hundred are needed.
const MOST_SWEEPS: usize = 2000;
/// The last sweep changes the field by less than this part of it.
const CLOSE_ENOUGH: f64 = 1e-9;

/// Where the sides of an outline cross the level line at `height`, once `turn` has turned them, in order.
fn crossings(outline: &Polygon, height: f64, turn: impl Fn(DVec2) -> DVec2) -> Vec<f64> {
    let mut found: Vec<f64> = outline
        .sides()
        .map(|(a, b)| (turn(a), turn(b)))
        .filter(|(a, b)| (a.y > height) != (b.y > height))
        .map(|(a, b)| a.x + (b.x - a.x) * (height - a.y) / (b.y - a.y))
        .collect();
    found.sort_by(f64::total_cmp);
    found
}

/// Distances from `at` down and up to the next crossing, at most `step`.
fn arms(crossings: &[f64], at: f64, step: f64) -> [f64; 2] {
    // A border within rounding of the next node runs through it.
    let clip = |distance: f64| if distance > step * (1.0 - 1e-6) { step } else { distance };
    let above = crossings.partition_point(|&c| c <= at);
    let up = crossings.get(above).map_or(step, |c| c - at);
    let down = above.checked_sub(1).map_or(step, |i| at - crossings[i]);
    [clip(down), clip(up)]
}
