//! A charge of TNT in air, from the end of its detonation to the weak shock far out.
//!
//! **Start.** The detonation has just reached the surface: the products have the profile that it leaves behind
//! it ([`FollowingFlow`]), or, with [`Start::ConstantVolume`], they are at rest with all their energy, as if
//! every part had reacted at once. **Products** follow the JWL equation of state of TNT, **air** is an ideal
//! gas. **Mesh:** the bound between the two goes with the gas and the outermost face is the shock itself, so
//! that neither is smeared and every cell lies where something happens. Between them the cells keep their
//! shares as the wave grows a thousandfold.
//!
//! Left out: burning of the products in the air, which feeds the wave of a real charge of TNT later on; the
//! ruffled, mixing surface between products and air; dissociation of air behind a shock of more than some 100
//! bar; the ground.

use super::gauge::Gauge;
use super::viscosity::{Viscosity, ViscositySettings};
use super::{Boundary, Cells, Godunov, GodunovSettings, Motion, Scheme};
use crate::air::{Air, Shock};
use crate::detonation::{EquationOfState, Explosive, FollowingFlow, Symmetry};
use crate::error::{Error, Result, positive};

/// Thickness of the first layer of shocked air over the charge's radius. Its energy is a few parts in ten
/// thousand of the charge's.
const FIRST_LAYER: f64 = 2e-3;

/// How the products are when the charge's surface begins to move.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Start {
    /// As a detonation from the centre leaves them.
    #[default]
    Detonation,
    /// At rest, all at the density of the explosive, holding its energy.
    ConstantVolume,
}

/// A charge and how its blast is to be computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChargeRun {
    /// Mass of TNT: of a sphere [kg], of a rod [kg/m], of a slab to both sides [kg/m²]; above 0.
    pub mass: f64,
    /// Sphere, rod or slab.
    pub symmetry: Symmetry,
    /// The air around.
    pub air: Air,
    /// The products at the start.
    pub start: Start,
    /// Cells in the products, 10 or more. Default 200.
    pub product_cells: usize,
    /// Cells between products and front, 10 or more. Default 600; the error falls with their square.
    pub air_cells: usize,
    /// Courant number, above 0 and up to 1. Default 0.8.
    pub courant: f64,
}

impl Default for ChargeRun {
    fn default() -> Self {
        ChargeRun {
            mass: 1.0,
            symmetry: Symmetry::Spherical,
            air: Air::SEA_LEVEL,
            start: Start::Detonation,
            product_cells: 200,
            air_cells: 600,
            courant: 0.8,
        }
    }
}

impl ChargeRun {
    fn validate(&self) -> Result<()> {
        positive("charge mass [kg]", self.mass)?;
        self.air.validate()?;
        for (what, cells) in [
            ("number of cells in the products", self.product_cells),
            ("number of cells in the air", self.air_cells),
        ] {
            if cells < 10 {
                return Err(Error::OutOfRange { what, value: cells as f64, expected: "10 or more" });
            }
        }
        Ok(())
    }

    /// Radius [m] of the charge; of a slab, half its thickness.
    pub fn radius(&self) -> f64 {
        let share = self.mass / (super::whole(self.symmetry) * Explosive::TNT.density);
        match self.symmetry {
            Symmetry::Plane => 0.5 * share,
            Symmetry::Cylindrical => (2.0 * share).sqrt(),
            Symmetry::Spherical => libm::cbrt(3.0 * share),
        }
    }

    /// Time [s] that the detonation needs from the centre to the surface.
    pub fn detonation_time(&self) -> Result<f64> {
        Ok(self.radius() / Explosive::TNT.chapman_jouguet()?.front_velocity)
    }

    /// The flow when the wave leaves the charge, on the mesh that follows it.
    pub fn godunov(&self) -> Result<Godunov> {
        self.validate()?;
        let radius = self.radius();
        let layer = FIRST_LAYER * radius;
        let mut cells = self.products(radius)?;
        let shocked = self.first_air(&cells)?;
        for cell in 1..=self.air_cells {
            cells.face.push(radius + layer * cell as f64 / self.air_cells as f64);
            cells.density.push(shocked.density);
            cells.velocity.push(shocked.particle_velocity);
            cells.energy.push(self.air_energy(shocked.overpressure, shocked.density));
        }
        cells.regions.push((self.air_cells, EquationOfState::Ideal { gamma: self.air.gamma }));
        let settings = GodunovSettings {
            courant: self.courant,
            motion: Motion::Follow,
            inner: Boundary::Wall,
            outer: Boundary::Front(self.air),
        };
        Godunov::new(&cells, settings)
    }

    /// The same on a mesh that goes with the gas, out to `reach` [m], for the scheme with viscosity.
    ///
    /// The cells of the air grow outwards in equal ratio from the width of those in the charge.
    pub fn viscosity(&self, reach: f64, settings: ViscositySettings) -> Result<Viscosity> {
        self.validate()?;
        let radius = self.radius();
        if reach.is_nan() || reach <= 2.0 * radius {
            return Err(Error::OutOfRange {
                what: "reach of the mesh [m]",
                value: reach,
                expected: "more than twice the charge's radius",
            });
        }
        let mut cells = self.products(radius)?;
        let first = radius / self.product_cells as f64;
        let even = (reach - radius) / self.air_cells as f64;
        let sum = |ratio: f64| {
            if ratio == 1.0 {
                return first * self.air_cells as f64;
            }
            first * (libm::pow(ratio, self.air_cells as f64) - 1.0) / (ratio - 1.0)
        };
        let ratio = if even > first {
            crate::root::bisect(1.0, 2.0, |ratio| sum(ratio) - (reach - radius))
        } else {
            1.0
        };
        let mut width = if even > first { first } else { even };
        for _ in 0..self.air_cells {
            cells.face.push(cells.face[cells.face.len() - 1] + width);
            cells.density.push(self.air.density());
            cells.velocity.push(0.0);
            cells.energy.push(self.air_energy(0.0, self.air.density()));
            width *= ratio;
        }
        cells.regions.push((self.air_cells, EquationOfState::Ideal { gamma: self.air.gamma }));
        Viscosity::new(&cells, ViscositySettings { outer_pressure: Some(self.air.pressure), ..settings })
    }

    /// How far [m] the mesh of [`ChargeRun::viscosity`] must go, so that nothing comes back from its end while
    /// the wave passes `distances` [m], or until `end` [s].
    pub fn reach(&self, distances: &[f64], end: f64) -> f64 {
        let farthest = distances.iter().copied().fold(self.radius(), f64::max);
        (1.5 * farthest + 40.0 * self.radius()).max(2.0 * end * self.air.sound_speed())
    }

    /// The products in the charge, the means over each cell.
    fn products(&self, radius: f64) -> Result<Cells> {
        let explosive = Explosive::TNT;
        let flow = FollowingFlow::new(&explosive, self.symmetry)?;
        let count = self.product_cells;
        let mut cells = Cells {
            symmetry: self.symmetry,
            face: (0..=count).map(|face| radius * face as f64 / count as f64).collect(),
            density: vec![explosive.density; count],
            velocity: vec![0.0; count],
            energy: vec![explosive.energy; count],
            regions: vec![(count, explosive.products)],
        };
        if self.start == Start::ConstantVolume {
            return Ok(cells);
        }
        let samples = 32;
        for cell in 0..count {
            let (low, high) = (cells.face[cell] / radius, cells.face[cell + 1] / radius);
            let (mut volume, mut mass, mut momentum, mut energy) = (0.0, 0.0, 0.0, 0.0);
            for sample in 0..samples {
                let place = low + (high - low) * (f64::from(sample) + 0.5) / f64::from(samples);
                let weight = super::mesh::mean_area(self.symmetry, place, place);
                let at = flow.at(place);
                volume += weight;
                mass += weight * at.density;
                momentum += weight * at.density * at.velocity;
                energy += weight * at.density * (at.energy + 0.5 * at.velocity * at.velocity);
            }
            cells.density[cell] = mass / volume;
            cells.velocity[cell] = momentum / mass;
            cells.energy[cell] = energy / mass - 0.5 * cells.velocity[cell] * cells.velocity[cell];
        }
        Ok(cells)
    }

    /// The shock that the products drive into the air at first: their surface expands, at constant entropy,
    /// until its pressure is that of the shock which its velocity causes.
    fn first_air(&self, products: &Cells) -> Result<Shock> {
        let state = Explosive::TNT.products;
        let last = self.product_cells - 1;
        let (mut density, mut velocity) = match self.start {
            Start::ConstantVolume => (products.density[last], products.velocity[last]),
            Start::Detonation => {
                let front = Explosive::TNT.chapman_jouguet()?;
                (front.density, front.velocity)
            }
        };
        let energy = match self.start {
            Start::ConstantVolume => products.energy[last],
            Start::Detonation => Explosive::TNT.chapman_jouguet()?.energy,
        };
        let isentrope = state.isentrope(density, state.pressure(density, energy));
        let fall = 1e-3;
        // Each step takes a thousandth of the density; the last pressure is met within as much.
        while isentrope.pressure(density) > self.air.pressure + self.shock_pressure(velocity) {
            let middle = density * (1.0 - 0.5 * fall);
            velocity += isentrope.sound_speed(middle) * fall / (1.0 - 0.5 * fall);
            density *= 1.0 - fall;
        }
        Ok(Shock::behind(&self.air, self.shock_pressure(velocity)))
    }

    /// Overpressure [Pa] of the shock that brings still air to `velocity` [m/s].
    fn shock_pressure(&self, velocity: f64) -> f64 {
        let half = 0.25 * (self.air.gamma + 1.0) * velocity;
        let front = half + (half * half + self.air.sound_speed() * self.air.sound_speed()).sqrt();
        self.air.density() * front * velocity
    }

    fn air_energy(&self, overpressure: f64, density: f64) -> f64 {
        (self.air.pressure + overpressure) / ((self.air.gamma - 1.0) * density)
    }

    /// Runs the flow until the positive phase is over at each of the `distances` [m, outside the charge], and
    /// at least to `end` [s] after detonation. Times in the gauges count from detonation at the centre.
    ///
    /// `watch` sees the flow's time after every step and ends the run early with an error.
    pub fn record<S: Scheme>(
        &self,
        flow: &mut S,
        distances: &[f64],
        end: f64,
        mut watch: impl FnMut(f64) -> Result<()>,
    ) -> Result<Vec<Gauge>> {
        let delay = self.detonation_time()?;
        for distance in distances {
            if !(distance.is_finite() && *distance > (1.0 + FIRST_LAYER) * self.radius()) {
                return Err(Error::OutOfRange {
                    what: "distance of a gauge [m]",
                    value: *distance,
                    expected: "outside the charge",
                });
            }
        }
        let mut gauges: Vec<Gauge> =
            distances.iter().map(|distance| Gauge::new(*distance, self.air.pressure)).collect();
        // Sound needs this long; a wave that has not ended by three times as much never does.
        let farthest = distances.iter().copied().fold(self.radius(), f64::max);
        let latest = 3.0 * (farthest + 10.0 * self.radius()) / self.air.sound_speed() + end;
        while flow.time() < end - delay
            || (flow.time() < latest && gauges.iter().any(|gauge| !gauge.is_done()))
        {
            let due = if flow.time() < end - delay { end - delay } else { latest };
            flow.step(due)?;
            for gauge in gauges.iter_mut() {
                gauge.record(flow);
            }
            watch(flow.time())?;
        }
        for gauge in &mut gauges {
            gauge.arrival = gauge.arrival.map(|time| time + delay);
            gauge.history.iter_mut().for_each(|sample| sample.0 += delay);
        }
        Ok(gauges)
    }
}
