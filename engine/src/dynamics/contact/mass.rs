//! Masses and moments of inertia as Box3D can hold them.
//!
//! It works in single precision, forms the product of a body's three moments, and turns bodies by an equation that has the
//! moments' third power in it. Only the ratios of masses matter to motion, so all are scaled alike; what is still beyond
//! its range is brought into it.

use boxddd::{MassData, Matrix3, Vec3};
use glam::DVec3;

use super::hull;
use crate::dynamics::RigidBody;

/// Moments of inertia that Box3D can invert [in its units]: it forms their product, in single precision.
const MOMENTS: (f64, f64) = (3e-11, 3e11);
/// Least mass in the same units.
const LEAST_MASS: f64 = 1e-12;
/// A body's smallest moment of inertia is at least this part of its largest.
const SLENDER: f64 = 1e-4;
/// About what the largest body's moment of inertia becomes in Box3D where that body is a metre or larger.
const LARGEST_MOMENT: f64 = 1e9;
/// A body's largest moment of inertia may be this many times ρ^(4/3), with ρ its smallest radius of gyration [m].
///
/// Box3D turns a body by solving for three angular velocities at once, in single precision. The largest number that
/// comes up is some (I h ω)³ ω, for a step h. Within a step a blow at the highest speed v turns a body by up to
/// ω = v/ρ before anything limits it. With this, that number is 1e36, and 3e38 is infinite.
const MOST_MOMENT: f64 = 9e9;

/// How many times ours Box3D's masses are where the largest body has this reach [m]. That body counts as a ball of stone.
pub fn gain(largest: f64) -> f64 {
    // Bodies that are all small turn faster, which leaves less room. By powers of two, which change no digit.
    let halvings = (4.0 / 3.0 * -libm::log2(largest)).max(0.0);
    LARGEST_MOMENT / (4000.0 * libm::pow(largest, 5.0)) * libm::exp2(-libm::ceil(halvings))
}

/// Mass and moments in Box3D's units, of a body that reaches this far [m]: true ones as long as they belong to a solid
/// body and single precision holds them. And how many times as much it could hold.
pub fn mass_data(state: &RigidBody, reach: f64, gain: f64) -> (MassData, f64) {
    let mass = 1.0 / state.inverse_mass;
    let reach = reach.max(hull::THINNEST);
    // Squares of the radii of gyration, of no less than the thinnest cube and no more than what is all at the rim. A
    // body that may not turn has none; its rotation is locked.
    let square = |inverse: f64| if inverse > 0.0 { 1.0 / (inverse * mass) } else { 0.4 * reach * reach };
    let (thinnest, rim) = (2.0 / 3.0 * hull::THINNEST * hull::THINNEST, 4.0 * reach * reach);
    let squares = state.inverse_moments.to_array().map(|inverse| square(inverse).clamp(thinnest, rim));
    let squares = DVec3::from_array(squares);
    // A needle that turns about itself must not make the others' turn overflow.
    let squares = squares.max(DVec3::splat(SLENDER * squares.max_element()));
    let most = (MOST_MOMENT * libm::pow(squares.min_element(), 2.0 / 3.0)).min(MOMENTS.1);
    let most = most / squares.max_element();
    let mass = (gain * mass).clamp(LEAST_MASS, most);
    let moments = mass * squares;
    let moments = moments.max(DVec3::splat(MOMENTS.0.max(SLENDER * moments.max_element())));
    let [x, y, z] = moments.to_array().map(|moment| moment as f32);
    (MassData { mass: mass as f32, center: Vec3::ZERO, inertia: diagonal(x, y, z) }, most / mass)
}

/// Mass and moments times a power of two, which changes no digit, so that a body can get back the very mass it had.
pub fn scaled(data: &MassData, factor: f32) -> MassData {
    let MassData { mass, center, inertia } = *data;
    let inertia = diagonal(factor * inertia.cx.x, factor * inertia.cy.y, factor * inertia.cz.z);
    MassData { mass: factor * mass, center, inertia }
}

fn diagonal(x: f32, y: f32, z: f32) -> Matrix3 {
    Matrix3 { cx: Vec3::new(x, 0.0, 0.0), cy: Vec3::new(0.0, y, 0.0), cz: Vec3::new(0.0, 0.0, z) }
}

#[cfg(test)]
mod tests {
    use glam::DQuat;

    use super::super::{FASTEST, SUBSTEP};
    use super::*;
    use crate::loading::Resistance;

    /// A body of this mass [kg], moments of inertia [kg m²] and reach [m].
    fn body(mass: f64, moments: DVec3, reach: f64) -> RigidBody {
        RigidBody {
            position: DVec3::ZERO,
            world_from_principal: DQuat::IDENTITY,
            velocity: DVec3::ZERO,
            angular_momentum: DVec3::ZERO,
            inverse_mass: 1.0 / mass,
            inverse_moments: moments.recip(),
            resistance: Resistance::new(DVec3::ONE, 1.0, None, mass),
            reach,
        }
    }

    /// Largest number that comes up as Box3D turns a body that was struck at the highest speed: (I h ω)³ ω, with ω such
    /// that the part of the body at its radius of gyration has that speed.
    fn largest_number(data: &MassData) -> f64 {
        let moments = [data.inertia.cx.x, data.inertia.cy.y, data.inertia.cz.z].map(f64::from);
        let (least, most) =
            moments.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), &moment| (a.min(moment), b.max(moment)));
        let turn = f64::from(FASTEST) * (f64::from(data.mass) / least).sqrt();
        (most * SUBSTEP * turn).powi(3) * turn
    }

    /// Whatever mass and moments a body has beside whatever else, single precision holds them and what comes of them.
    #[test]
    fn no_mass_and_no_moments_overflow() {
        let sizes = [1e-6, 1e-3, 0.1, 10.0, 1e3];
        let masses = [1e-12, 1e-6, 1.0, 1e9];
        let moments = [0.0, 1e-30, 1e-18, 1e-6, 1.0, 1e12, f64::INFINITY, f64::NAN];
        for (&largest, &reach) in sizes.iter().flat_map(|a| sizes.iter().map(move |b| (a, b))) {
            for (&mass, &moment) in masses.iter().flat_map(|a| moments.iter().map(move |b| (a, b))) {
                let fitting = 0.4 * mass * reach * reach;
                let state = body(mass, DVec3::new(moment, fitting, moment), reach);
                let (data, room) = mass_data(&state, reach, gain(largest.max(1e-4)));
                let [x, y, z] = [data.inertia.cx.x, data.inertia.cy.y, data.inertia.cz.z];
                // Box3D takes a product below this for none.
                assert!(x * y * z > 1000.0 * f32::MIN_POSITIVE && (x * y * z).is_finite(), "{data:?}");
                assert!(data.mass > 0.0 && data.mass.is_finite() && room >= 1.0, "{data:?}, {room}");
                assert!(largest_number(&data) < 1e37, "{largest} {reach} {data:?}");
            }
        }
    }

    /// A brick, a pane's piece and a splinter beside a wall have the masses and moments they have.
    #[test]
    fn usual_bodies_have_their_own_masses_and_moments() {
        for (edges, density, largest) in [
            (DVec3::new(0.25, 0.065, 0.12), 1800.0, 0.15),
            (DVec3::new(0.3, 0.2, 0.004), 2500.0, 1.0),
            (DVec3::new(0.002, 0.003, 0.003), 2500.0, 0.7),
            (DVec3::new(1.0, 0.05, 0.05), 7850.0, 0.6),
        ] {
            let mass = density * edges.element_product();
            let square = edges * edges;
            let squares = (DVec3::splat(square.element_sum()) - square) / 12.0;
            let reach = 0.5 * edges.length();
            let state = body(mass, mass * squares, reach);
            let gain = gain(largest);
            let (data, _) = mass_data(&state, reach, gain);
            let same = |a: f32, b: f64| (f64::from(a) / b - 1.0).abs() < 1e-6;
            assert!(same(data.mass, gain * mass), "{edges}: {data:?}");
            let moments = gain * mass * squares;
            assert!(same(data.inertia.cx.x, moments.x), "{edges}: {data:?} {moments}");
            assert!(same(data.inertia.cy.y, moments.y), "{edges}: {data:?} {moments}");
            assert!(same(data.inertia.cz.z, moments.z), "{edges}: {data:?} {moments}");
        }
    }
}
