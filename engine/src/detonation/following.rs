//! The following flow: the gas that a detonation leaves behind it.
//!
//! From a plane, a line or a point of initiation the flow looks the same at all times but for its size: it
//! depends on `ξ = r/t` alone, from the Chapman–Jouguet state at `ξ = D` down to a core at rest. All of it lies
//! on the isentrope of the Chapman–Jouguet point. Source: G. I. Taylor, "The dynamics of the combustion
//! products behind plane and spherical detonation fronts in explosives", Proc. Roy. Soc. A 200 (1950).

use super::equation_of_state::Isentrope;
use super::explosive::{Behind, Explosive};
use crate::error::Result;

/// Symmetry of a one-dimensional flow.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Symmetry {
    /// Layers: one coordinate across.
    Plane,
    /// About an axis: distance from it.
    Cylindrical,
    /// About a point: distance from it.
    #[default]
    Spherical,
}

impl Symmetry {
    /// Power of the distance with which the area of a front grows: 0, 1, 2.
    pub fn exponent(self) -> i32 {
        match self {
            Symmetry::Plane => 0,
            Symmetry::Cylindrical => 1,
            Symmetry::Spherical => 2,
        }
    }
}

/// Steps of the integration inwards; the error falls with their fourth power.
const STEPS: usize = 4000;

/// Velocity at which the core begins, as a part of that behind the front.
const AT_REST: f64 = 1e-7;

/// The flow behind a detonation, by rising `ξ`.
#[derive(Debug, Clone, PartialEq)]
pub struct FollowingFlow {
    front: Behind,
    /// `ξ = r/t` [m/s], rising, from the rim of the core to the front.
    speed: Vec<f64>,
    velocity: Vec<f64>,
    density: Vec<f64>,
    isentrope: Isentrope,
}

/// The gas at a place in the flow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlowPoint {
    /// Velocity [m/s], outward.
    pub velocity: f64,
    /// Density [kg/m³].
    pub density: f64,
    /// Pressure [Pa].
    pub pressure: f64,
    /// Specific internal energy [J/kg].
    pub energy: f64,
}

impl FollowingFlow {
    /// The flow behind a Chapman–Jouguet detonation of `explosive`.
    ///
    /// Mass and momentum at constant entropy give `dρ/du = ρ (ξ − u)/c²` and, with `j` the exponent of
    /// symmetry, `dξ/du = (ξ/(j u)) ((ξ − u)²/c² − 1)`. The gas velocity serves as the variable because the
    /// slope over distance is infinite at the front. In the plane the flow is a simple wave, `ξ = u + c`.
    pub fn new(explosive: &Explosive, symmetry: Symmetry) -> Result<FollowingFlow> {
        let front = explosive.chapman_jouguet()?;
        let isentrope = explosive.products.isentrope(front.density, front.pressure);
        let exponent = f64::from(symmetry.exponent());
        // In terms of s = ln u, which resolves the approach to rest.
        let slope = |velocity: f64, [speed, density]: [f64; 2]| {
            let sound = isentrope.sound_speed(density);
            let mach = (speed - velocity) / sound;
            match symmetry {
                Symmetry::Plane => [0.0, velocity * density / sound],
                _ => [speed / exponent * (mach * mach - 1.0), velocity * density * mach / sound],
            }
        };
        let step = libm::log(AT_REST) / STEPS as f64;
        let mut state = [front.front_velocity, front.density];
        let mut rows = vec![(state[0], front.velocity, state[1])];
        for index in 0..STEPS {
            let velocity = |part: f64| front.velocity * libm::exp(step * (index as f64 + part));
            let ahead =
                |k: [f64; 2], part: f64| [state[0] + part * step * k[0], state[1] + part * step * k[1]];
            let k1 = slope(velocity(0.0), state);
            let k2 = slope(velocity(0.5), ahead(k1, 0.5));
            let k3 = slope(velocity(0.5), ahead(k2, 0.5));
            let k4 = slope(velocity(1.0), ahead(k3, 1.0));
            let sum = |row: usize| step / 6.0 * (k1[row] + 2.0 * (k2[row] + k3[row]) + k4[row]);
            state = [state[0] + sum(0), state[1] + sum(1)];
            let now = velocity(1.0);
            if symmetry == Symmetry::Plane {
                state[0] = now + isentrope.sound_speed(state[1]);
            }
            rows.push((state[0], now, state[1]));
        }
        rows.reverse();
        Ok(FollowingFlow {
            front,
            speed: rows.iter().map(|row| row.0).collect(),
            velocity: rows.iter().map(|row| row.1).collect(),
            density: rows.iter().map(|row| row.2).collect(),
            isentrope,
        })
    }

    /// The state at the front.
    pub fn front(&self) -> Behind {
        self.front
    }

    /// Radius of the core at rest over that of the front.
    pub fn core(&self) -> f64 {
        self.speed[0] / self.front.front_velocity
    }

    /// The gas at `place`, a distance from the origin over that of the front (0 to 1).
    pub fn at(&self, place: f64) -> FlowPoint {
        let speed = place * self.front.front_velocity;
        let last = self.speed.len() - 1;
        let (velocity, density) = if speed <= self.speed[0] {
            (0.0, self.density[0])
        } else if speed >= self.speed[last] {
            (self.velocity[last], self.density[last])
        } else {
            let upper = self.speed.partition_point(|sample| *sample <= speed).clamp(1, last);
            let (start, end) = (self.speed[upper - 1], self.speed[upper]);
            let part = (speed - start) / (end - start);
            let between = |column: &[f64]| column[upper - 1] + part * (column[upper] - column[upper - 1]);
            (between(&self.velocity), between(&self.density))
        };
        FlowPoint {
            velocity,
            density,
            pressure: self.isentrope.pressure(density),
            energy: self.isentrope.energy(density),
        }
    }
}
