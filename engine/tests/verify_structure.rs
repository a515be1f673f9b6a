//! Structures against closed forms, limits and balances of energy.

use brisance_engine::structure::{
    LoadTable, Oscillator, Pulse, Response, diagram, impulsive_limit, quasi_static_force, reaches, respond,
    triangle_response,
};
use proptest::prelude::*;

/// Mass 1000 kg, period 0.1 s.
fn elastic() -> Oscillator {
    let omega = 2.0 * core::f64::consts::PI / 0.1;
    Oscillator::elastic(1000.0, 1000.0 * omega * omega)
}

fn relative(got: f64, expected: f64) -> f64 {
    (got - expected).abs() / expected.abs()
}

/// Largest difference from (2.34), (2.35) over the static displacement.
fn error(duration: f64, step: f64) -> f64 {
    let (oscillator, peak) = (elastic(), 2e5);
    let load = Pulse::Triangle { peak, duration };
    let response = respond(&oscillator, &load, step, 0.3).unwrap();
    let still = peak / oscillator.stiffness;
    response
        .history
        .iter()
        .map(|at| (at.displacement - triangle_response(&oscillator, peak, duration, at.time)).abs() / still)
        .fold(0.0, f64::max)
}

#[test]
fn a_triangle_gives_the_closed_form_to_a_millionth() {
    for duration in [0.01, 0.073, 0.2] {
        assert!(error(duration, 1e-5) < 1e-6, "{duration}: {}", error(duration, 1e-5));
    }
}

#[test]
fn the_integration_is_of_second_order() {
    for duration in [0.01, 0.073, 0.2] {
        let (coarse, fine) = (error(duration, 4e-5), error(duration, 1e-5));
        let order = (coarse / fine).log2() / 2.0;
        assert!((order - 2.0).abs() < 0.1, "{duration}: order {order}");
    }
}

#[test]
fn the_closed_form_solves_its_equation_and_is_smooth_where_the_pulse_ends() {
    // M x'' + k x = F(t) by central differences, whose error is ω⁴h²/12 of x: 1e-5 at this step.
    let (oscillator, peak, duration, h) = (elastic(), 2e5, 0.08, 1e-5);
    let x = |t: f64| triangle_response(&oscillator, peak, duration, t);
    for time in [0.01, 0.05, 0.079, 0.09, 0.2] {
        let acceleration = (x(time + h) - 2.0 * x(time) + x(time - h)) / (h * h);
        let force = peak * (1.0 - time / duration).max(0.0);
        let rest = oscillator.mass * acceleration + oscillator.stiffness * x(time) - force;
        assert!(rest.abs() < 1e-4 * peak, "{time}: {rest}");
    }
    assert!((x(duration * (1.0 + 1e-12)) - x(duration)).abs() < 1e-12);
}

#[test]
fn a_load_put_on_at_once_and_left_doubles_the_static_displacement() {
    let oscillator = elastic();
    let load = Pulse::Step { peak: 1e5, duration: f64::INFINITY };
    // Four crests of equal height: the first is meant.
    let response = respond(&oscillator, &load, 1e-5, 0.4).unwrap();
    let still = 1e5 / oscillator.stiffness;
    assert!(relative(response.max_displacement, 2.0 * still) < 1e-6);
    assert!(relative(response.time_of_max, 0.05) < 1e-5);
    assert_eq!(response.permanent_set, 0.0);
}

#[test]
fn free_damped_swings_decay_by_their_logarithmic_decrement() {
    // After a short push, crests one damped period apart fall by exp(−2πζ/√(1−ζ²)).
    let zeta = 0.05;
    let mut oscillator = elastic();
    oscillator.damping = 2.0 * zeta * oscillator.mass * oscillator.frequency();
    let load = Pulse::Triangle { peak: 1e6, duration: 1e-3 };
    let history = respond(&oscillator, &load, 1e-5, 0.5).unwrap().history;
    let crests: Vec<f64> = history
        .windows(3)
        .filter(|w| w[1].displacement > w[0].displacement && w[1].displacement >= w[2].displacement)
        .map(|w| w[1].displacement)
        .collect();
    let expected = (-2.0 * core::f64::consts::PI * zeta / (1.0_f64 - zeta * zeta).sqrt()).exp();
    assert!(relative(crests[2] / crests[1], expected) < 1e-4);
}

/// A structure that yields at twice the static force of a load of 1e5 N.
fn yielding() -> Oscillator {
    Oscillator { yield_resistance: 1.25e5, ..elastic() }
}

#[test]
fn a_step_load_flows_to_the_displacement_of_the_work_balance() {
    // (2.37): F x = ½ R x_el + R (x − x_el), so x = x_el R / (2 (R − F)).
    let oscillator = yielding();
    let force = 1e5;
    let load = Pulse::Step { peak: force, duration: f64::INFINITY };
    let response = respond(&oscillator, &load, 1e-5, 0.3).unwrap();
    let elastic = oscillator.yield_displacement();
    let expected = elastic * 1.25e5 / (2.0 * (1.25e5 - force));
    assert!(expected > 2.0 * elastic);
    assert!(relative(response.max_displacement, expected) < 1e-5);
    assert!(relative(quasi_static_force(&oscillator, expected), force) < 1e-12);
    // Unloading is elastic: what stays is the crest less the elastic part.
    assert!(relative(response.permanent_set, expected - elastic) < 1e-4);
}

#[test]
fn a_pulse_much_shorter_than_the_step_is_not_lost() {
    // A velocity I/M from rest: the crest is I/(M ω).
    let oscillator = elastic();
    let load = Pulse::Friedlander { peak: 1e9, duration: 1e-6, decay: 2.0 };
    let response = respond(&oscillator, &load, 1e-4, 0.1).unwrap();
    let expected = load.impulse() / (oscillator.mass * oscillator.frequency());
    assert!(relative(response.max_displacement, expected) < 1e-4);
}

#[test]
fn an_impulse_flows_until_its_kinetic_energy_is_strain_energy() {
    let oscillator = yielding();
    let limit = 5.0 * oscillator.yield_displacement();
    let impulse = impulsive_limit(&oscillator, limit);
    let duration = 1e-6;
    let load = Pulse::Step { peak: impulse / duration, duration };
    let response = respond(&oscillator, &load, 2e-6, 0.2).unwrap();
    assert!(relative(response.max_displacement, limit) < 1e-4);
}

fn books_balance(oscillator: &Oscillator, response: &Response) -> f64 {
    let most = response.history.iter().map(|at| at.work).fold(0.0, f64::max);
    response
        .history
        .iter()
        .map(|at| (at.work - at.stored(oscillator) - at.damped - at.flowed).abs() / most)
        .fold(0.0, f64::max)
}

#[test]
fn both_asymptotes_of_the_diagram_are_met_within_a_percent() {
    for (oscillator, ductility) in [(elastic(), 1.0), (yielding(), 1.0), (yielding(), 4.0)] {
        let limit = ductility * yielding().yield_displacement();
        for pulse in [
            Pulse::Step { peak: 1.0, duration: 1.0 },
            Pulse::Triangle { peak: 1.0, duration: 1.0 },
            Pulse::Friedlander { peak: 1.0, duration: 1.0, decay: 1.5 },
        ] {
            let drawn = diagram(&oscillator, &pulse, limit, (1e-3, 1e3), 25).unwrap();
            let (short, long) = (drawn.curve[0], drawn.curve[24]);
            assert!(relative(short.impulse, drawn.impulse_asymptote) < 0.01);
            assert!(relative(long.force, drawn.force_asymptote) < 0.01);
            for pair in drawn.curve.windows(2) {
                // Never inside either asymptote, and falling; beyond its crest a long pulse no longer matters.
                assert!(pair[1].force <= pair[0].force * (1.0 + 1e-9));
                assert!(pair[0].impulse >= drawn.impulse_asymptote * (1.0 - 1e-3));
                assert!(pair[1].force >= drawn.force_asymptote * (1.0 - 1e-3));
            }
        }
    }
}

#[test]
fn the_elastic_diagram_is_that_of_the_closed_form() {
    // The greatest value of (2.34), (2.35) by search, at the threshold of each duration.
    let oscillator = elastic();
    let limit = 0.01;
    let pulse = Pulse::Triangle { peak: 1.0, duration: 1.0 };
    for threshold in diagram(&oscillator, &pulse, limit, (0.05, 20.0), 12).unwrap().curve {
        let top = (0..200_000)
            .map(|i| {
                let time = 0.12 * f64::from(i) / 200_000.0;
                triangle_response(&oscillator, threshold.force, threshold.duration, time)
            })
            .fold(0.0, f64::max);
        // 400 steps a period: (2π/400)²/12 of phase, some 1e-4 of the displacement.
        assert!(relative(top, limit) < 1e-4, "{threshold:?} {top}");
    }
}

#[test]
fn loads_beside_the_curve_fall_on_their_own_side() {
    let oscillator = yielding();
    let limit = 3.0 * oscillator.yield_displacement();
    let pulse = Pulse::Triangle { peak: 1.0, duration: 1.0 };
    for threshold in diagram(&oscillator, &pulse, limit, (0.05, 20.0), 9).unwrap().curve {
        let load = |factor: f64| pulse.scaled(factor * threshold.force, threshold.duration);
        assert!(!reaches(&oscillator, &load(0.999), limit).unwrap());
        assert!(reaches(&oscillator, &load(1.001), limit).unwrap());
    }
}

#[test]
fn heavy_damping_creeps_and_does_not_hang() {
    let mut oscillator = elastic();
    oscillator.damping = 20.0 * oscillator.mass * oscillator.frequency();
    let load = Pulse::Step { peak: 1e5, duration: f64::INFINITY };
    let still = 1e5 / oscillator.stiffness;
    assert!(reaches(&oscillator, &load, 0.999 * still).unwrap());
    assert!(!reaches(&oscillator, &load, 1.001 * still).unwrap());
}

#[test]
fn what_cannot_be_is_refused_in_one_sentence() {
    let load = Pulse::Triangle { peak: 1.0, duration: 1.0 };
    let refuse = |oscillator: Oscillator| respond(&oscillator, &load, 1e-3, 1.0).unwrap_err().to_string();
    assert!(refuse(Oscillator { mass: 0.0, ..elastic() }).contains("mass of the structure [kg] is 0"));
    assert!(refuse(Oscillator { damping: -1.0, ..elastic() }).contains("damping"));
    assert!(refuse(Oscillator { stiffness: f64::NAN, ..elastic() }).contains("stiffness"));
    assert!(respond(&elastic(), &load, 0.0, 1.0).is_err());
    assert!(respond(&elastic(), &load, 1e-9, 1.0).unwrap_err().to_string().contains("steps"));
    assert!(LoadTable::new(vec![0.0, 1.0], vec![1.0]).is_err());
    assert!(LoadTable::new(vec![0.0, 0.0], vec![1.0, 2.0]).is_err());
    assert!(diagram(&elastic(), &load, -1.0, (0.1, 10.0), 5).is_err());
    assert!(diagram(&elastic(), &load, 0.01, (10.0, 0.1), 5).is_err());
    assert!(Pulse::Triangle { peak: 1.0, duration: f64::INFINITY }.validate().is_err());
}

proptest! {
    #[test]
    fn energy_is_accounted_for(
        peak in 1e4_f64..1e6,
        duration in 0.005_f64..0.5,
        damping in 0.0_f64..0.2,
        strength in 0.3_f64..3.0,
        shape in 0..3,
    ) {
        let mut oscillator = elastic();
        oscillator.damping = 2.0 * damping * oscillator.mass * oscillator.frequency();
        oscillator.yield_resistance = strength * peak;
        let load = match shape {
            0 => Pulse::Step { peak, duration },
            1 => Pulse::Triangle { peak, duration },
            _ => Pulse::Friedlander { peak, duration, decay: 2.0 },
        };
        let response = respond(&oscillator, &load, 1e-4, 1.0).unwrap();
        // Each term by the trapezium over a step of 0.1 % of the period: 1e-3 with the kinks of yielding.
        prop_assert!(books_balance(&oscillator, &response) < 1e-3);
        prop_assert!(response.permanent_set >= -1e-9);
        for at in &response.history {
            prop_assert!(at.resistance.abs() <= oscillator.yield_resistance * (1.0 + 1e-12));
        }
    }

    #[test]
    fn a_table_of_the_triangle_does_what_the_triangle_does(peak in 1e4_f64..1e6, duration in 0.01_f64..0.3) {
        let oscillator = yielding();
        let pulse = Pulse::Triangle { peak, duration };
        let table = LoadTable::new(vec![0.0, 0.4 * duration, duration], vec![peak, 0.6 * peak, 0.0]).unwrap();
        let one = respond(&oscillator, &pulse, 1e-4, 1.0).unwrap();
        let other = respond(&oscillator, &table, 1e-4, 1.0).unwrap();
        prop_assert!(relative(other.max_displacement, one.max_displacement) < 1e-4);
    }
}
