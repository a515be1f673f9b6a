//! A pane against plate theory.

use std::f64::consts::PI;

use brisance_engine::geometry::Polygon;
use brisance_engine::material::GLASS;
use brisance_engine::structure::Plate;
use glam::DVec2;

fn rectangle(width: f64, height: f64) -> Polygon {
    let (x, y) = (0.5 * width, 0.5 * height);
    Polygon::new(&[DVec2::new(-x, -y), DVec2::new(x, -y), DVec2::new(x, y), DVec2::new(-x, y)])
}

fn stiffness(thickness: f64) -> f64 {
    let poisson = GLASS.poisson_ratio.unwrap();
    GLASS.young_modulus * thickness.powi(3) / (12.0 * (1.0 - poisson * poisson))
}

/// Navier's double series for a rectangle on simple supports under a pressure of 1 Pa: deflection [m] and the greatest
/// bending stress [Pa] in the middle.
fn navier(width: f64, height: f64, thickness: f64) -> (f64, f64) {
    let poisson = GLASS.poisson_ratio.unwrap();
    let (mut deflection, mut moments) = (0.0, [0.0; 2]);
    for m in (1..200).step_by(2) {
        for n in (1..200).step_by(2) {
            let (mx, ny) = ((m as f64 / width).powi(2), (n as f64 / height).powi(2));
            let sign = if (m + n) / 2 % 2 == 1 { 1.0 } else { -1.0 };
            let term = sign * 16.0 / (PI.powi(6) * (m * n) as f64 * (mx + ny).powi(2));
            deflection += term / stiffness(thickness);
            moments[0] += term * PI * PI * (mx + poisson * ny);
            moments[1] += term * PI * PI * (ny + poisson * mx);
        }
    }
    (deflection, moments[0].max(moments[1]) * 6.0 / (thickness * thickness))
}

/// The grid's cells are a fortieth of the side; its error is of second order, some 1/40² of the value.
#[test]
fn a_rectangle_bends_as_navier_says() {
    for (width, height) in [(1.0, 1.0), (1.0, 0.5), (0.7, 1.9), (2.0, 1.7)] {
        let plate = Plate::new(&rectangle(width, height), 0.006, &GLASS).unwrap();
        let (deflection, stress) = navier(width, height, 0.006);
        let middle = plate.deflection(DVec2::ZERO);
        assert!((middle / deflection - 1.0).abs() < 5e-3, "{width} × {height}: {middle} {deflection}");
        assert!((plate.strongest() / stress - 1.0).abs() < 1e-2, "{} {stress}", plate.strongest());
    }
}

/// First mode of a rectangle: ω = π² (1/a² + 1/b²) √(D/ρh). Rayleigh's quotient can only be above it, and is by more
/// the longer the pane, whose first mode tapers toward the ends where the deflection is even.
#[test]
fn it_swings_as_fast_as_its_first_mode() {
    for (width, height) in [(1.0, 1.0), (1.0, 0.4), (3.0, 2.0)] {
        let thickness = 0.01;
        let plate = Plate::new(&rectangle(width, height), thickness, &GLASS).unwrap();
        let exact = PI
            * PI
            * (1.0 / (width * width) + 1.0 / (height * height))
            * (stiffness(thickness) / (GLASS.density * thickness)).sqrt();
        let ratio = plate.frequency() / exact;
        assert!((0.999..1.011).contains(&ratio), "{width} × {height}: {ratio}");
    }
}

/// A many-sided polygon is the disc whose edge does not resist twist at its corners, w = p a⁴ 3/64 D in the middle: two
/// membranes of (a² − r²)/4 and of that. It stands for the border that runs aslant between nodes.
#[test]
fn a_many_sided_pane_bends_as_two_membranes() {
    let radius = 0.5;
    let corners: Vec<DVec2> =
        (0..96).map(|i| DVec2::from_angle(2.0 * PI * f64::from(i) / 96.0) * radius).collect();
    let plate = Plate::new(&Polygon::new(&corners), 0.006, &GLASS).unwrap();
    let exact = 3.0 * radius.powi(4) / (64.0 * stiffness(0.006));
    assert!((plate.deflection(DVec2::ZERO) / exact - 1.0).abs() < 1e-2);
    assert_eq!(plate.deflection(DVec2::new(0.49, 0.49)), 0.0);
}

/// Deflection goes with side⁴/h³ and stress with (side/h)², at any size.
#[test]
fn size_and_thickness_scale() {
    let small = Plate::new(&rectangle(0.01, 0.02), 1e-4, &GLASS).unwrap();
    let large = Plate::new(&rectangle(10.0, 20.0), 0.1, &GLASS).unwrap();
    assert!((small.strongest() / large.strongest() - 1.0).abs() < 1e-9);
    let middle = |plate: &Plate| plate.deflection(DVec2::ZERO);
    assert!((middle(&large) / middle(&small) / 1e3 - 1.0).abs() < 1e-9);
}

/// The slope is that of the deflection.
#[test]
fn the_slope_is_the_deflections() {
    let plate = Plate::new(&rectangle(1.0, 1.0), 0.006, &GLASS).unwrap();
    let (at, step) = (DVec2::new(0.21, -0.13), 1e-4);
    let along = |d: DVec2| (plate.deflection(at + d * step) - plate.deflection(at - d * step)) / (2.0 * step);
    let slope = plate.slope(at);
    assert!((slope.x - along(DVec2::X)).abs() < 1e-9 * slope.x.abs().max(1.0));
    assert!((slope.y - along(DVec2::Y)).abs() < 1e-9 * slope.y.abs().max(1.0));
    assert!(slope.x < 0.0 && slope.y > 0.0);
}
