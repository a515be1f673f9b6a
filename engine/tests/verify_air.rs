//! Rankine–Hugoniot relations against the thesis's forms, the conservation laws and the known limits.

use brisance_engine::air::{Air, Shock, normal_reflection};

const P0: f64 = 101_325.0;

fn near(value: f64, truth: f64, relative: f64) {
    assert!((value - truth).abs() <= relative * truth.abs(), "{value} is not {truth} within {relative}");
}

fn overpressures() -> impl Iterator<Item = f64> {
    (0..60).map(|step| 10.0 * 10f64.powf(step as f64 / 8.0))
}

#[test]
fn sea_level_density_and_sound_speed_are_those_of_the_standard_atmosphere() {
    // ISA: 1.225 kg/m³ and 340.29 m/s, both rounded to the last digit given.
    assert!((Air::SEA_LEVEL.density() - 1.225).abs() < 5e-4);
    assert!((Air::SEA_LEVEL.sound_speed() - 340.29).abs() < 5e-3);
}

#[test]
fn gamma_1_4_gives_the_equations_of_the_thesis() {
    let air = Air::SEA_LEVEL;
    for ps in overpressures() {
        let shock = Shock::behind(&air, ps);
        // (2.15), (2.16), (2.17), (2.28), (2.29) in this order.
        near(shock.front_velocity, ((6.0 * ps + 7.0 * P0) / (7.0 * P0)).sqrt() * air.sound_speed(), 1e-12);
        near(shock.density, (6.0 * ps + 7.0 * P0) / (ps + 7.0 * P0) * air.density(), 1e-12);
        near(shock.dynamic_pressure, 5.0 * ps * ps / (2.0 * (ps + 7.0 * P0)), 1e-12);
        near(normal_reflection(&air, ps), 2.0 * ps + 2.4 * shock.dynamic_pressure, 1e-12);
        near(normal_reflection(&air, ps), 2.0 * ps * (7.0 * P0 + 4.0 * ps) / (7.0 * P0 + ps), 1e-12);
    }
}

#[test]
fn mass_momentum_and_energy_are_conserved_for_any_gamma() {
    for gamma in [1.1, 1.2, 1.4, 5.0 / 3.0] {
        let air = Air { pressure: 70_000.0, temperature: 250.0, gamma };
        for ps in overpressures() {
            let Shock { front_velocity: speed, density, particle_velocity: wind, dynamic_pressure, .. } =
                Shock::behind(&air, ps);
            let (p1, p2, rho1) = (air.pressure, air.pressure + ps, air.density());
            // Mass and momentum across the front, (2.1) and (2.2); 1e-9 because both sides are differences.
            near(density * (speed - wind), rho1 * speed, 1e-9);
            near(rho1 * speed * wind, ps, 1e-12);
            // The Hugoniot relation of an ideal gas, e = p / ((γ − 1) ρ).
            let energy = |p: f64, rho: f64| p / ((gamma - 1.0) * rho);
            let jump = 0.5 * (p1 + p2) * (1.0 / rho1 - 1.0 / density);
            assert!((energy(p2, density) - energy(p1, rho1) - jump).abs() <= 1e-11 * energy(p2, density));
            // Definition (2.27).
            near(dynamic_pressure, 0.5 * density * wind * wind, 1e-9);
        }
    }
}

#[test]
fn the_reflected_shock_brings_the_gas_to_rest_for_any_gamma() {
    for gamma in [1.2, 1.4, 5.0 / 3.0] {
        let air = Air { gamma, ..Air::SEA_LEVEL };
        for ps in overpressures() {
            let shock = Shock::behind(&air, ps);
            let incident = P0 + ps;
            let reflected = P0 + normal_reflection(&air, ps);
            // Velocity jump across a shock into gas at `incident`: it must undo the wind.
            let jump = (reflected - incident)
                * (2.0 / (shock.density * ((gamma + 1.0) * reflected + (gamma - 1.0) * incident))).sqrt();
            near(jump, shock.particle_velocity, 1e-8);
        }
    }
}

#[test]
fn the_reflection_coefficient_runs_from_2_to_8() {
    let air = Air::SEA_LEVEL;
    // C_R = 2 + 2.4 q/ps: the deviation from a limit is first order in ps/p0 or p0/ps.
    near(normal_reflection(&air, 1.0), 2.0, 1e-5);
    near(normal_reflection(&air, 1e12) / 1e12, 8.0, 1e-5);
    let monatomic = Air { gamma: 5.0 / 3.0, ..air };
    near(normal_reflection(&monatomic, 1e12) / 1e12, 6.0, 1e-5);
    assert_eq!(Shock::behind(&air, 0.0).front_velocity, air.sound_speed());
}

#[test]
fn air_that_cannot_exist_is_refused() {
    for air in [
        Air { pressure: 0.0, ..Air::SEA_LEVEL },
        Air { pressure: f64::NAN, ..Air::SEA_LEVEL },
        Air { temperature: -1.0, ..Air::SEA_LEVEL },
        Air { gamma: 1.0, ..Air::SEA_LEVEL },
    ] {
        assert!(air.validate().is_err(), "{air:?}");
    }
    assert!(Air::default().validate().is_ok());
}
