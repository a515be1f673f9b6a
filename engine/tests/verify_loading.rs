//! Loads on a panel: closed-form impulses against quadrature, and the limits of clearing.

use brisance_engine::air::Air;
use brisance_engine::blast::{BlastField, PulseShape};
use brisance_engine::charge::Charge;
use brisance_engine::loading::{Drag, Face, FaceHistory, HistorySettings, LoadingMode, Resistance, Wind};
use glam::{DQuat, DVec3};
use proptest::prelude::*;

const SETTINGS: HistorySettings = HistorySettings {
    mode: LoadingMode::Translational,
    drag: Drag::FlowRelative,
    shape: PulseShape::Friedlander,
    negative_phase: false,
    gain: 1.0,
};

fn field() -> BlastField {
    BlastField::new(&Charge::tnt(100.0, DVec3::ZERO), &Air::default()).unwrap()
}

fn history(distance: f64, cos_alpha: f64, face: Face, settings: HistorySettings) -> FaceHistory {
    let field = field();
    FaceHistory::new(&field, &field.at_distance(distance), cos_alpha, face, 1.05, settings)
}

/// Midpoint rule, fine enough for 1e-5 of the whole.
fn quadrature(history: &FaceHistory, t0: f64, t1: f64) -> f64 {
    let count = 20_000;
    let dt = (t1 - t0) / f64::from(count);
    (0..count).map(|i| history.pressure(t0 + (f64::from(i) + 0.5) * dt)).sum::<f64>() * dt
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    /// The closed form is the integral of the pressure, whatever is switched on.
    #[test]
    fn impulse_is_the_integral_of_pressure(
        distance in 3.0f64..60.0, cos_alpha in 0.05f64..1.0, clearing_length in 0.02f64..20.0,
        surface: bool, thesis: bool, negative_phase: bool, rear: bool, triangle: bool, gain in 0.1f64..3.0,
    ) {
        let settings = HistorySettings {
            mode: if surface || rear { LoadingMode::Surface } else { LoadingMode::Translational },
            drag: if thesis { Drag::Thesis } else { Drag::FlowRelative },
            shape: if triangle { PulseShape::TriangleImpulse } else { PulseShape::Friedlander },
            negative_phase,
            gain,
        };
        let h = if rear {
            history(distance, -cos_alpha, Face::Rear { clearing_length }, settings)
        } else {
            history(distance, cos_alpha, Face::Front { clearing_length }, settings)
        };
        let whole = h.impulse(f64::NEG_INFINITY, f64::INFINITY);
        let scale = quadrature_of_magnitude(&h);
        let sum = quadrature(&h, h.arrival(), h.end());
        prop_assert!((whole - sum).abs() < 1e-4 * scale, "{} and {}", whole, sum);
        let middle = 0.5 * (h.arrival() + h.end());
        let parts = h.impulse(0.0, middle) + h.impulse(middle, h.end());
        prop_assert!((parts - whole).abs() < 1e-9 * scale, "parts must add up");
    }
}

fn quadrature_of_magnitude(h: &FaceHistory) -> f64 {
    let count = 1000;
    let dt = (h.end() - h.arrival()) / f64::from(count);
    (0..count).map(|i| h.pressure(h.arrival() + (f64::from(i) + 0.5) * dt).abs()).sum::<f64>() * dt
}

#[test]
fn a_face_that_never_clears_receives_the_reflected_impulse() {
    let settings = HistorySettings { drag: Drag::Thesis, ..SETTINGS };
    let h = history(15.0, 1.0, Face::Front { clearing_length: f64::INFINITY }, settings);
    let point = field().at_distance(15.0);
    let share = h.impulse(0.0, 1.0) / point.reflected_impulse;
    assert!((share - 1.0).abs() < 1e-9, "{share}");
    // The chart and Kingery–Bulmash read the reflected peak independently: within 3 %.
    assert!((h.peak() / point.reflected_pressure - 1.0).abs() < 0.03);
}

#[test]
fn a_face_that_clears_at_once_is_left_with_drag() {
    let thesis = HistorySettings { drag: Drag::Thesis, ..SETTINGS };
    let point = field().at_distance(15.0);
    let h = history(15.0, 1.0, Face::Front { clearing_length: 1e-9 }, thesis);
    let t = point.arrival_time + 1e-6;
    assert!((h.pressure(t) / (1.05 * point.dynamic_pressure) - 1.0).abs() < 1e-3);
}

#[test]
fn short_clearing_is_the_straight_line_of_the_thesis() {
    // (2.31): a line from the reflected peak to drag over t' = 3S/U. For t'/T of 1 % the blend differs by as much.
    let point = field().at_distance(15.0);
    let thesis = HistorySettings { drag: Drag::Thesis, ..SETTINGS };
    let clearing_length = 0.01 * point.duration * point.front_velocity / 3.0;
    let h = history(15.0, 1.0, Face::Front { clearing_length }, thesis);
    let relief = 3.0 * clearing_length / point.front_velocity;
    for share in [0.1, 0.5, 0.9] {
        let line = h.peak() + share * (h.pressure(point.arrival_time + relief) - h.peak());
        let blend = h.pressure(point.arrival_time + share * relief);
        assert!((blend / line - 1.0).abs() < 0.03, "at {share}: {blend} and {line}");
    }
}

#[test]
fn a_side_feels_the_incident_pulse_and_a_rear_face_fills_later() {
    let settings = HistorySettings { mode: LoadingMode::Surface, ..SETTINGS };
    let point = field().at_distance(15.0);
    let side = history(15.0, 0.0, Face::Rear { clearing_length: 1.0 }, settings);
    assert!((side.pressure(point.arrival_time + 1e-9) / point.overpressure - 1.0).abs() < 1e-6);
    assert!((side.impulse(0.0, 1.0) / point.impulse - 1.0).abs() < 1e-9);
    let rear = history(15.0, -1.0, Face::Rear { clearing_length: 0.5 }, settings);
    assert!(rear.pressure(point.arrival_time + 1e-9) < 1e-3 * point.overpressure);
    // Full 3S/a after the front has passed: then it is the side's own pulse.
    let filled = point.arrival_time + 1.5 / Air::default().sound_speed();
    assert!((rear.pressure(filled) - side.pressure(filled)).abs() < 1e-6 * point.overpressure);
}

#[test]
fn longer_clearing_never_gives_less_impulse() {
    let impulse = |s| history(15.0, 1.0, Face::Front { clearing_length: s }, SETTINGS).impulse(0.0, 1.0);
    let lengths = [0.01, 0.05, 0.2, 1.0, 5.0, 50.0];
    assert!(lengths.windows(2).all(|pair| impulse(pair[0]) < impulse(pair[1])));
}

fn brick(mass: f64) -> Resistance {
    Resistance::new(DVec3::new(0.016, 0.032, 0.0512), 1.05, None, mass)
}

/// The wind's push on a heavy body is ∫½ρu²C_D A dt, for any step.
#[test]
fn wind_on_a_heavy_body_gives_the_drag_impulse_for_any_step() {
    let (air, field) = (Air::default(), field());
    let point = field.at_distance(15.0);
    let wind = Wind::new(&point, point.pulse(PulseShape::Friedlander), &air, 1.0);
    // Its own speed, 1e-6 of the wind's, changes the drag by twice that.
    let mass = 1e4;
    let pushed = |steps: u32| {
        let dt = (wind.end - wind.arrival) / f64::from(steps);
        let mut v = DVec3::ZERO;
        for i in 0..steps {
            let t = wind.arrival + f64::from(i) * dt;
            let (flow, excess) = wind.steady(t, (t + dt).min(wind.end));
            v = brick(mass).carry(v, DQuat::IDENTITY, flow, air.density() + excess, 1.0, dt);
        }
        v.x * mass
    };
    let drag = HistorySettings { drag: Drag::Thesis, ..SETTINGS };
    let thesis = FaceHistory::new(&field, &point, 1.0, Face::Front { clearing_length: 0.0 }, 1.05, drag);
    let expected = thesis.impulse(0.0, 1.0) * 0.016;
    for steps in [1, 3, 10, 100] {
        let share = pushed(steps) / expected;
        assert!((share - 1.0).abs() < 2e-5, "{steps} steps: {share}");
    }
}

#[test]
fn a_light_body_never_outruns_the_wind() {
    let v = brick(1e-6).carry(DVec3::ZERO, DQuat::IDENTITY, DVec3::new(80.0, 0.0, 0.0), 1.5, 1.0, 1.0);
    assert!(v.x > 79.0 && v.x < 80.0);
}

#[test]
fn lift_is_normal_to_the_flow_and_only_for_plates() {
    let plate = Resistance::new(DVec3::new(0.001, 0.001, 0.04), 1.2, None, 1.0);
    assert!(plate.lift > 0.0 && brick(10.0).lift == 0.0);
    let tilt = DQuat::from_rotation_y(0.6);
    let before = DVec3::new(0.0, 0.0, 10.0);
    let lifted = plate.carry(before, tilt, DVec3::ZERO, 1.2, 0.0, 1e-3);
    assert!((lifted.length() - 10.0).abs() < 1e-9, "lift alone does no work");
    let (sin, cos) = (0.6_f64.sin(), 0.6_f64.cos());
    let expected = 0.5 * 1.2 * 1.2 * 0.04 * 100.0 * sin * cos * 1e-3;
    assert!((lifted.x.abs() / expected - 1.0).abs() < 1e-3, "{} and {expected}", lifted.x);
}

#[test]
fn damping_multiplies_what_slows_and_not_what_pushes() {
    let calm =
        |damping| brick(10.0).carry(DVec3::X * 30.0, DQuat::IDENTITY, DVec3::ZERO, 1.2, damping, 1e-3).x;
    assert!(calm(1000.0) < calm(1.0));
    let pushed =
        |damping| brick(10.0).carry(DVec3::ZERO, DQuat::IDENTITY, DVec3::X * 30.0, 1.2, damping, 1e-3).x;
    assert_eq!(pushed(1000.0), pushed(1.0));
}
