//! Pulses: closed forms against quadrature and against each other.

mod published;

use brisance_engine::air::Air;
use brisance_engine::blast::pulse::{
    MAX_DECAY, NegativePhase, Pulse, PulseShape, friedlander_decay, integrate_poly_exp,
};
use brisance_engine::blast::{BlastField, negative_phase};
use brisance_engine::charge::{Burst, Charge};
use glam::DVec3;
use published::{json, log_spaced};

/// Composite Gauss–Legendre quadrature with five points, exact to degree nine in each of `panels` panels.
fn quadrature(f: impl Fn(f64) -> f64, start: f64, end: f64, panels: usize) -> f64 {
    let nodes = [
        (0.0, 0.568_888_888_888_888_9),
        (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
        (0.906_179_845_938_664, 0.236_926_885_056_189_08),
    ];
    let half = 0.5 * (end - start) / panels as f64;
    (0..panels)
        .map(|panel| {
            let middle = start + (2 * panel + 1) as f64 * half;
            let both =
                |x: f64| if x == 0.0 { f(middle) } else { f(middle - half * x) + f(middle + half * x) };
            half * nodes.iter().map(|(x, weight)| weight * both(*x)).sum::<f64>()
        })
        .sum()
}

#[test]
fn moments_of_an_exponential_are_exact_for_every_decay() {
    // Panels are short against 1/b: each is then exact to 1e-14.
    for b in [0.0, 1e-12, 1e-6, 1e-3, 0.1, 1.0, 7.9, 19.9, 20.1, 60.0, 300.0, 1000.0] {
        for (x0, x1) in [(0.0, 1.0), (0.25, 0.75), (0.0, 1e-6), (0.999, 1.0), (-0.5, 0.5)] {
            let c = [0.3, 1.7, 0.4, 2.0, 0.05];
            let f = |x: f64| (c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * c[4])))) * (-b * x).exp();
            let truth = quadrature(f, x0, x1, 4000);
            let size = quadrature(|x| f(x).abs(), x0, x1, 4000);
            let value = integrate_poly_exp(c, b, x0, x1);
            assert!(
                (value - truth).abs() <= 1e-12 * size,
                "b {b} from {x0} to {x1}: {value} against {truth}"
            );
        }
    }
}

#[test]
fn without_decay_the_integral_is_that_of_the_polynomial() {
    let value = integrate_poly_exp([1.0, 2.0, 3.0, 4.0], 0.0, 0.0, 2.0);
    assert!((value - 30.0).abs() < 1e-13);
    assert_eq!(integrate_poly_exp([1.0], 0.0, 3.0, 3.0), 0.0);
    assert_eq!(integrate_poly_exp([1.0, 1.0], 2.0, 1.0, 0.5), -integrate_poly_exp([1.0, 1.0], 2.0, 0.5, 1.0));
}

#[test]
fn the_decay_gives_the_impulse_back() {
    for truth in log_spaced(1e-6, 999.0, 400) {
        let pulse = Pulse { peak: 2e5, duration: 3e-3, decay: truth, negative: None };
        let solved = friedlander_decay(2e5, 3e-3, pulse.impulse(0.0, 3e-3));
        // Near 0 the impulse depends on b only through 1/2 − b/6: rounding in it is 1e-16 in b.
        assert!((solved.decay - truth).abs() <= 1e-12 * truth + 1e-14, "{truth}: {}", solved.decay);
        assert!(!solved.clamped);
    }
}

#[test]
fn the_decay_is_bounded() {
    assert_eq!(friedlander_decay(1.0, 1.0, 0.5).decay, 0.0);
    assert!(!friedlander_decay(1.0, 1.0, 0.5).clamped);
    for (impulse, decay) in [(0.6, 0.0), (1e9, 0.0), (1e-6, MAX_DECAY), (0.0, MAX_DECAY)] {
        let solved = friedlander_decay(1.0, 1.0, impulse);
        assert!(solved.clamped && solved.decay == decay, "{impulse}: {solved:?}");
    }
}

#[test]
fn the_two_triangles_of_figure_2_9() {
    let (peak, duration, impulse) = (70e3, 13e-3, 280.0);
    let one = Pulse::new(PulseShape::TriangleDuration, peak, duration, impulse);
    assert_eq!((one.duration, one.impulse(0.0, 1.0)), (duration, 0.5 * peak * duration));
    let two = Pulse::new(PulseShape::TriangleImpulse, peak, duration, impulse);
    assert_eq!(two.duration, 2.0 * impulse / peak);
    assert!((two.impulse(0.0, 1.0) / impulse - 1.0).abs() < 1e-14);
    let friedlander = Pulse::new(PulseShape::Friedlander, peak, duration, impulse);
    assert_eq!(friedlander.duration, duration);
    assert!((friedlander.impulse(0.0, 1.0) / impulse - 1.0).abs() < 1e-13);
    for pulse in [one, two, friedlander] {
        assert_eq!((pulse.value(0.0), pulse.value(-1e-9), pulse.value(1.0)), (peak, 0.0, 0.0));
        assert_eq!(pulse.value(pulse.duration), 0.0);
    }
}

#[test]
fn an_impulse_too_large_for_the_duration_stretches_it() {
    let pulse = Pulse::new(PulseShape::Friedlander, 1000.0, 1e-3, 0.8);
    assert_eq!((pulse.decay, pulse.duration), (0.0, 1.6e-3));
    assert!((pulse.impulse(0.0, 1.0) - 0.8).abs() < 1e-14);
    // And one too small for the largest decay cuts it.
    let short = Pulse::new(PulseShape::Friedlander, 1e9, 1e-3, 1.0);
    assert!(short.decay == MAX_DECAY && short.duration < 1e-3);
    assert!((short.impulse(0.0, 1.0) - 1.0).abs() < 1e-12);
}

#[test]
fn the_negative_phase_carries_nine_sixteenths() {
    let negative = NegativePhase { peak: 14e3, duration: 50e-3 };
    let pulse = Pulse { peak: 80e3, duration: 12e-3, decay: 1.3, negative: Some(negative) };
    let suction = pulse.impulse(12e-3, 62e-3);
    assert!((suction / -negative.impulse() - 1.0).abs() < 1e-13);
    assert!((negative.impulse() - 9.0 / 16.0 * 14e3 * 50e-3).abs() < 1e-10);
    // Deepest a third of the way through, level with the ambient at both ends.
    let third = 12e-3 + 50e-3 / 3.0;
    assert!((pulse.value(third) + 14e3).abs() < 1e-8);
    assert!(pulse.value(third - 1e-3) > -14e3 && pulse.value(third + 1e-3) > -14e3);
    assert!(pulse.value(12e-3).abs() < 1e-9 && pulse.value(62e-3).abs() < 1e-9 && pulse.value(63e-3) == 0.0);
}

#[test]
fn the_negative_phase_follows_its_chart() {
    let file = json(include_str!("../data/negative_phase.json"));
    for row in file["ufc_spherical_table"]["rows"].as_array().unwrap() {
        let number = |key: &str| row[key].as_f64().unwrap();
        let phase = negative_phase(number("Z"), 1.0, Burst::Air);
        assert!((phase.peak - 1e3 * number("p_incident_kPa").min(101.325)).abs() < 1e-6);
        let duration = 1e-3 * number("duration_ms_kg13");
        if phase.peak < 101_325.0 {
            assert!((phase.impulse() / number("i_incident_kPa_ms_kg13") - 1.0).abs() < 1e-12);
        }
        if number("Z") >= 3.0 {
            assert!(phase.duration < duration && phase.duration > 0.88 * duration, "at {}", number("Z"));
        }
    }
}

#[test]
fn the_negative_phase_scales_with_the_charge_and_the_atmosphere() {
    // 8 kg: twice the duration at the same Z. 1.8 times the mass stands for the ground.
    let (one, eight) = (negative_phase(4.0, 1.0, Burst::Air), negative_phase(4.0, 8.0, Burst::Air));
    assert_eq!(one.peak, eight.peak);
    assert!((eight.duration / one.duration - 2.0).abs() < 1e-14);
    let surface = negative_phase(4.0, 1.0, Burst::Surface);
    let sphere = negative_phase(4.0 / 1.8f64.cbrt(), 1.8, Burst::Air);
    assert!((surface.peak / sphere.peak - 1.0).abs() < 1e-14);
    assert!((surface.duration / sphere.duration - 1.0).abs() < 1e-14);
    // Krauthammer and Altenberg's plateau for hemispheres is 13.9 ms; the rule above reaches it within 15 %.
    assert!((negative_phase(20.0, 1.0, Burst::Surface).duration / 13.9e-3 - 1.0).abs() < 0.15);

    let charge = Charge::tnt(27.0, DVec3::ZERO);
    let high = Air { pressure: 0.5 * 101_325.0, ..Air::SEA_LEVEL };
    let phase = BlastField::new(&charge, &high).unwrap().negative_phase(20.0);
    let level = BlastField::new(&charge, &Air::SEA_LEVEL).unwrap().negative_phase(20.0 / 2f64.cbrt());
    assert!((phase.peak / level.peak - 0.5).abs() < 1e-12);
    assert!((phase.duration / level.duration - 2f64.cbrt()).abs() < 1e-12);
}

#[test]
fn far_out_the_suction_dies_like_sound() {
    let (near, far) = (negative_phase(40.0, 1.0, Burst::Air), negative_phase(400.0, 1.0, Burst::Air));
    assert!((near.peak / far.peak - 10.0).abs() < 1e-12);
    assert!((near.duration / far.duration - 1.0).abs() < 1e-12);
}
