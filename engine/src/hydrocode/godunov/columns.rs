//! The gas in every cell, one column a quantity, with one ghost cell at either end.

/// Rows that a kernel treats at once; its results live in registers and in the nearest cache meanwhile.
pub(super) const BLOCK: usize = 64;

/// Density, velocity, pressure and internal energy per volume of every cell, ghosts first and last.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Columns {
    pub density: Vec<f64>,
    pub velocity: Vec<f64>,
    pub pressure: Vec<f64>,
    /// Internal energy per volume [J/m³].
    pub energy: Vec<f64>,
}

/// One row of [`Columns`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Row {
    pub density: f64,
    pub velocity: f64,
    pub pressure: f64,
    pub energy: f64,
}

impl Columns {
    pub fn zeros(rows: usize) -> Columns {
        let column = || vec![0.0; rows];
        Columns { density: column(), velocity: column(), pressure: column(), energy: column() }
    }

    #[inline(always)]
    pub fn row(&self, index: usize) -> Row {
        Row {
            density: self.density[index],
            velocity: self.velocity[index],
            pressure: self.pressure[index],
            energy: self.energy[index],
        }
    }

    pub fn set(&mut self, index: usize, row: Row) {
        self.density[index] = row.density;
        self.velocity[index] = row.velocity;
        self.pressure[index] = row.pressure;
        self.energy[index] = row.energy;
    }

    /// A stretch of all four columns.
    #[inline(always)]
    pub fn stretch(&self, from: usize, to: usize) -> Stretch<'_> {
        Stretch {
            density: &self.density[from..to],
            velocity: &self.velocity[from..to],
            pressure: &self.pressure[from..to],
            energy: &self.energy[from..to],
        }
    }
}

/// Part of [`Columns`], all of equal length.
#[derive(Clone, Copy)]
pub(super) struct Stretch<'a> {
    density: &'a [f64],
    velocity: &'a [f64],
    pressure: &'a [f64],
    energy: &'a [f64],
}

impl Stretch<'_> {
    #[inline(always)]
    pub fn row(&self, index: usize) -> Row {
        Row {
            density: self.density[index],
            velocity: self.velocity[index],
            pressure: self.pressure[index],
            energy: self.energy[index],
        }
    }
}

/// The results of a kernel for one block of rows.
pub(super) struct RowBlock {
    density: [f64; BLOCK],
    velocity: [f64; BLOCK],
    pressure: [f64; BLOCK],
    energy: [f64; BLOCK],
}

impl RowBlock {
    #[inline(always)]
    pub fn new() -> RowBlock {
        let column = [0.0; BLOCK];
        RowBlock { density: column, velocity: column, pressure: column, energy: column }
    }

    #[inline(always)]
    pub fn set(&mut self, index: usize, row: Row) {
        self.density[index] = row.density;
        self.velocity[index] = row.velocity;
        self.pressure[index] = row.pressure;
        self.energy[index] = row.energy;
    }

    #[inline(always)]
    pub fn store(&self, into: &mut Columns, from: usize, rows: usize) {
        into.density[from..from + rows].copy_from_slice(&self.density[..rows]);
        into.velocity[from..from + rows].copy_from_slice(&self.velocity[..rows]);
        into.pressure[from..from + rows].copy_from_slice(&self.pressure[..rows]);
        into.energy[from..from + rows].copy_from_slice(&self.energy[..rows]);
    }
}
