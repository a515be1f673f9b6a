//! The reference solutions themselves: Riemann's problem and the Sedov–Taylor blast.

mod hydro;

use brisance_engine::hydrocode::{GasState, RiemannProblem, Sedov, Symmetry, whole};
use hydro::{SYMMETRIES, relative};
use proptest::prelude::*;

fn gas(density: f64, velocity: f64, pressure: f64) -> GasState {
    GasState { density, velocity, pressure }
}

#[test]
fn toro_s_five_tests_have_their_published_solution() {
    // Toro (2009), Tables 4.1 and 4.2: states, then pressure and velocity between the waves, to five digits.
    let tests = [
        (gas(1.0, 0.0, 1.0), gas(0.125, 0.0, 0.1), 0.30313, 0.92745),
        (gas(1.0, -2.0, 0.4), gas(1.0, 2.0, 0.4), 0.00189, 0.0),
        (gas(1.0, 0.0, 1000.0), gas(1.0, 0.0, 0.01), 460.894, 19.5975),
        (gas(1.0, 0.0, 0.01), gas(1.0, 0.0, 100.0), 46.0950, -6.19633),
        (gas(5.99924, 19.5975, 460.894), gas(5.99242, -6.19633, 46.0950), 1691.64, 8.68975),
    ];
    for (left, right, pressure, velocity) in tests {
        let solved = RiemannProblem::new(left, right, 1.4).unwrap();
        let rounding = if pressure < 0.01 { 3e-3 } else { 2e-5 };
        assert!(relative(solved.pressure, pressure) < rounding, "{solved:?}");
        assert!((solved.velocity - velocity).abs() < 1e-5 * velocity.abs().max(1e-3), "{solved:?}");
    }
}

#[test]
fn gases_that_part_too_fast_leave_a_vacuum_and_say_so() {
    let error = RiemannProblem::new(gas(1.0, -20.0, 1.0), gas(1.0, 20.0, 1.0), 1.4).unwrap_err();
    assert!(error.to_string().contains("vacuum"), "{error}");
    assert!(RiemannProblem::new(gas(-1.0, 0.0, 1.0), gas(1.0, 0.0, 1.0), 1.4).is_err());
    assert!(RiemannProblem::new(gas(1.0, 0.0, 0.0), gas(1.0, 0.0, 1.0), 1.4).is_err());
    assert!(RiemannProblem::new(gas(1.0, 0.0, 1.0), gas(1.0, 0.0, 1.0), 1.0).is_err());
}

#[test]
fn the_sedov_constant_is_the_published_one() {
    // Kamm and Timmes (2007): energies 0.0673185 (one side of a plane), 0.311357 and 0.851072 bring the shock
    // to 0.5, 0.75 and 1 at time 1, for γ = 1.4. Their energy of the plane is 4 parts in ten thousand off what
    // the similarity equations give (next test): their integrand is singular there.
    for (symmetry, energy, radius) in [
        (Symmetry::Plane, 2.0 * 0.0673185, 0.5),
        (Symmetry::Cylindrical, 0.311357, 0.75),
        (Symmetry::Spherical, 0.851072, 1.0),
    ] {
        let blast = Sedov::new(symmetry, 1.4, 1.0, energy).unwrap();
        let rounding = if symmetry == Symmetry::Plane { 2e-4 } else { 1e-5 };
        assert!(relative(blast.radius(1.0), radius) < rounding, "{symmetry:?} {}", blast.radius(1.0));
    }
    assert!(Sedov::new(Symmetry::Plane, 2.5, 1.0, 1.0).is_err());
}

/// Slopes of velocity, density and pressure, over those of the shock's speed and the gas ahead, in the place
/// `x` = r/R: mass, momentum and entropy with R growing as a power of time, solved for the three slopes.
fn similarity(x: f64, [v, g, p]: [f64; 3], j: f64, gamma: f64) -> [f64; 3] {
    let slowing = -j / 2.0;
    let away = v - x;
    let square = gamma * p / g;
    let spread = (j - 1.0) * v / x;
    let dv = (slowing * (away * v - 2.0 * p / g) - square * spread) / (square - away * away);
    let dg = -g * (dv + spread) / away;
    let dp = -g * (slowing * v + away * dv);
    [dv, dg, dp]
}

#[test]
fn the_sedov_constant_is_that_of_the_similarity_equations() {
    let gamma = 1.4;
    for (symmetry, j) in SYMMETRIES.into_iter().zip([1.0, 2.0, 3.0]) {
        let both = if symmetry == Symmetry::Plane { 2.0 } else { 1.0 };
        let mut y: [f64; 3] = [2.0 / (gamma + 1.0), (gamma + 1.0) / (gamma - 1.0), 2.0 / (gamma + 1.0)];
        let (steps, inner) = (20_000, 0.02);
        let h = -(1.0 - inner) / f64::from(steps);
        let held = |x: f64, y: [f64; 3]| (0.5 * y[1] * y[0] * y[0] + y[2] / (gamma - 1.0)) * x.powf(j - 1.0);
        let mut sum = 0.0;
        for step in 0..steps {
            let x = 1.0 + h * f64::from(step);
            let add = |k: [f64; 3], part: f64| [0, 1, 2].map(|i| y[i] + part * h * k[i]);
            let k1 = similarity(x, y, j, gamma);
            let k2 = similarity(x + 0.5 * h, add(k1, 0.5), j, gamma);
            let k3 = similarity(x + 0.5 * h, add(k2, 0.5), j, gamma);
            let k4 = similarity(x + h, add(k3, 1.0), j, gamma);
            let next = [0, 1, 2].map(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
            sum -= 0.5 * h * (held(x, y) + held(x + h, next));
            y = next;
        }
        // The core holds no motion to speak of, and one pressure.
        sum += y[2] / (gamma - 1.0) * f64::powf(inner, j) / j;
        let alpha = both * whole(symmetry) * sum * (2.0 / (j + 2.0)).powi(2);
        let got = Sedov::new(symmetry, gamma, 1.0, 1.0).unwrap().alpha();
        assert!(relative(got, alpha) < 1e-5, "{symmetry:?} {got} {alpha}");
    }
}

#[test]
fn a_sedov_blast_holds_the_gas_it_has_swept_and_its_energy() {
    for symmetry in SYMMETRIES {
        let both = if symmetry == Symmetry::Plane { 2.0 } else { 1.0 };
        let blast = Sedov::new(symmetry, 1.4, 1.3, 2.0).unwrap();
        let (time, cells) = (0.7, 20_000);
        let radius = blast.radius(time);
        let power = symmetry.exponent();
        let (mut mass, mut energy) = (0.0, 0.0);
        for cell in 0..cells {
            let r = radius * (f64::from(cell) + 0.5) / f64::from(cells);
            let volume = both * whole(symmetry) * r.powi(power) * radius / f64::from(cells);
            let at = blast.at(r, time);
            mass += volume * at.density;
            energy += volume * (at.pressure / 0.4 + 0.5 * at.density * at.velocity * at.velocity);
        }
        let swept = both * whole(symmetry) * radius.powi(power + 1) / f64::from(power + 1);
        // The midpoint rule at this step.
        assert!(relative(mass, 1.3 * swept) < 1e-4, "{symmetry:?}");
        assert!(relative(energy, 2.0) < 1e-4, "{symmetry:?} {energy}");
    }
}

#[test]
fn a_sedov_blast_is_still_and_smooth_in_the_middle() {
    // Near the centre the velocity grows in proportion to the distance, u = r δ/(γ t), δ = 2/(j + 2).
    for (symmetry, j) in SYMMETRIES.into_iter().zip([1.0, 2.0, 3.0]) {
        let blast = Sedov::new(symmetry, 1.4, 1.0, 1.0).unwrap();
        for r in [1e-6, 1e-3, 0.02] {
            let expected = r * 2.0 / ((j + 2.0) * 1.4);
            // In the plane the next term is of relative order r^3.5 only; here the largest r leaves 2e-3.
            assert!(relative(blast.at(r, 1.0).velocity, expected) < 5e-3, "{symmetry:?} {r}");
        }
    }
}

proptest! {
    #[test]
    fn what_the_waves_cover_is_conserved(
        rl in 0.1_f64..10.0, ul in -1.0_f64..1.0, pl in 0.1_f64..10.0,
        rr in 0.1_f64..10.0, ur in -1.0_f64..1.0, pr in 0.1_f64..10.0,
        gamma in 1.1_f64..1.9,
    ) {
        let (left, right) = (gas(rl, ul, pl), gas(rr, ur, pr));
        let Ok(solved) = RiemannProblem::new(left, right, gamma) else { return Ok(()) };
        let (slow, fast) = solved.heads();
        let reach = 1.1 * slow.abs().max(fast.abs());
        let energy = |s: &GasState| s.pressure / (gamma - 1.0) + 0.5 * s.density * s.velocity * s.velocity;
        let held = |s: &GasState| [s.density, s.density * s.velocity, energy(s)];
        let flux = |s: &GasState| {
            let through = s.density * s.velocity;
            [through, through * s.velocity + s.pressure, s.velocity * (energy(s) + s.pressure)]
        };
        let cells = 20_000;
        let width = 2.0 * reach / f64::from(cells);
        let mut sum = [0.0; 3];
        for cell in 0..cells {
            let at = solved.at(-reach + width * (f64::from(cell) + 0.5));
            for (total, part) in sum.iter_mut().zip(held(&at)) {
                *total += width * part;
            }
        }
        for (k, sum) in sum.into_iter().enumerate() {
            let expected = reach * (held(&left)[k] + held(&right)[k]) + flux(&left)[k] - flux(&right)[k];
            // Shocks and the contact are placed to one of 20 000 cells: some 1e-4 of what they separate.
            let scale = reach * (held(&left)[k].abs() + held(&right)[k].abs() + held(&left)[0]);
            prop_assert!((sum - expected).abs() < 1e-3 * scale);
        }
    }

    #[test]
    fn mirrored_problems_have_mirrored_solutions(
        rl in 0.1_f64..10.0, pl in 0.1_f64..10.0, u in -0.5_f64..0.5, speed in -3.0_f64..3.0,
    ) {
        let (left, right) = (gas(rl, u, pl), gas(1.0, 0.0, 1.0));
        let one = RiemannProblem::new(left, right, 1.4).unwrap().at(speed);
        let mirror = |s: GasState| GasState { velocity: -s.velocity, ..s };
        let other = RiemannProblem::new(mirror(right), mirror(left), 1.4).unwrap().at(-speed);
        prop_assume!((one.density - other.density).abs() < 1e-9 || (speed - one.velocity).abs() > 1e-9);
        prop_assert!((one.pressure - other.pressure).abs() < 1e-9);
        prop_assert!((one.velocity + other.velocity).abs() < 1e-9);
    }
}
