//! Thin glass that lands: through no floor at any speed, in no heap deeper than glass lets it, and quiet where it is
//! only let go.

mod glass;

use brisance_engine::dynamics::GRAVITY;
use brisance_engine::dynamics::contact::{CollisionShape, LONGEST_STEP, REACH, step_at};
use brisance_engine::geometry::{Polygon, Triangulator, convex_hull, convex_parts};
use glam::{DQuat, DVec2, DVec3};
use glass::{pane, spin};
use proptest::prelude::*;

/// A thousand shards thrown flat and down, up to three times as fast as glass breaks at: none ends below the floor, and
/// none that rests in it by more than two millimetres.
#[test]
fn no_shard_goes_through_the_floor_at_any_speed() {
    for (count, thickness, velocity) in [
        (1000, 0.004, DVec3::new(0.0, 0.0, 12.0)),
        (1000, 0.004, DVec3::new(0.0, -100.0, 30.0)),
        (250, 0.003, DVec3::new(5.0, -300.0, 0.0)),
        (250, 0.006, DVec3::new(0.0, -40.0, 0.0)),
    ] {
        let throw = |p: DVec3| (velocity + DVec3::new(p.x, p.y - 1.0, 0.0), spin(p, 60.0));
        let mut glass = pane(count, thickness, throw);
        let speed = velocity.length();
        let (start, mut highest) = (glass.energy(), 0.0_f64);
        let mut time = 0.0;
        while time < 6.0 && glass.world.awake() > 0 {
            // As a run chooses its steps.
            let fastest = glass.states.iter().map(|s| s.velocity.length()).fold(0.0, f64::max);
            let dt = step_at(fastest);
            glass.step(dt);
            time += dt;
            highest = highest.max(glass.energy());
        }
        let resting = |&i: &usize| glass.states[i].velocity == DVec3::ZERO;
        let depths: Vec<f64> = (0..glass.states.len()).filter(resting).map(|i| -glass.lowest(i)).collect();
        let deepest = depths.iter().copied().fold(0.0, f64::max);
        let below: Vec<DVec3> = (glass.states.iter())
            .filter(|s| s.position.y < 0.0 && s.position.length() < REACH)
            .map(|s| s.position)
            .collect();
        println!(
            "{speed:.0} m/s: {} of {} at rest after {time:.1} s, deepest {:.2} mm, energy {:.3}",
            depths.len(),
            glass.states.len(),
            1e3 * deepest,
            highest / start
        );
        assert!(glass.states.iter().all(|s| s.position.is_finite()));
        assert!(below.is_empty(), "at {speed} m/s these are below the floor: {below:?}");
        assert!(deepest < 2e-3, "at {speed} m/s the deepest is {deepest} m in the floor");
        assert!(highest < 1.01 * start, "at {speed} m/s energy rises to {} of itself", highest / start);
    }
}

/// A pane that is in pieces and only let go falls as one: its pieces touch everywhere and gain nothing from that. What
/// they may gain is what pockets in the collision shapes push apart: here less than a hundredth of what the fall gives.
#[test]
fn neighbours_that_touch_are_not_pushed_apart() {
    let mut glass = pane(1000, 0.006, |_| (DVec3::ZERO, DVec3::ZERO));
    let mass: f64 = glass.states.iter().map(|s| 1.0 / s.inverse_mass).sum();
    let mut fallen = 0.0;
    while fallen < 0.25 {
        glass.step(LONGEST_STEP);
        fallen += LONGEST_STEP;
    }
    let free = 0.5 * mass * (GRAVITY * fallen).powi(2);
    let gained = (glass.kinetic_energy() - free) / mass;
    println!("gained {gained} J/kg of {}", free / mass);
    assert!(gained.abs() < 1e-2 * free / mass, "{gained} J/kg");
    let drift = glass.states.iter().map(|s| s.position.z.abs()).fold(0.0, f64::max);
    assert!(drift < 0.01, "a piece has left the plane by {drift} m");
}

/// Convex parts cover a piece and reach beyond it by no more than was asked for.
#[test]
fn parts_cover_a_shard_within_their_tolerance() {
    for seed in 0..40_u64 {
        let outline = wavy(40 + seed as usize, seed);
        let mut triangles = Vec::new();
        Triangulator::default().triangulate(&outline, &mut triangles).unwrap();
        for tolerance in [1e-6, 0.01, 0.05] {
            let parts = convex_parts(&outline, &triangles, tolerance);
            for point in outline.points() {
                assert!(parts.iter().any(|part| depth(part, *point) > -1e-12), "{point} is in no part");
            }
            let area: f64 = parts.iter().map(|part| Polygon::new(part).area()).sum();
            assert!(area >= outline.area() * (1.0 - 1e-9));
            for part in &parts {
                assert_eq!(part.len(), convex_hull(part.iter().copied()).len(), "a part is convex");
                let deepest = outline.points().iter().map(|&p| depth(part, p)).fold(0.0, f64::max);
                assert!(deepest <= tolerance + 1e-12, "a corner lies {deepest} deep in a part");
            }
        }
        let exact = convex_parts(&outline, &triangles, 1e-9);
        let area: f64 = exact.iter().map(|part| Polygon::new(part).area()).sum();
        assert!((area - outline.area()).abs() < 1e-6 * outline.area());
    }
}

/// How deep a point lies in a convex ring; negative outside.
fn depth(ring: &[DVec2], point: DVec2) -> f64 {
    let side = |i: usize| {
        let (from, along) = (ring[i], ring[(i + 1) % ring.len()] - ring[i]);
        along.perp_dot(point - from) / along.length()
    };
    (0..ring.len()).map(side).fold(f64::INFINITY, f64::min)
}

/// A ring with waves in its radius.
fn wavy(count: usize, seed: u64) -> Polygon {
    let waves = 2 + seed % 5;
    let ring: Vec<DVec2> = (0..count)
        .map(|i| {
            let angle = std::f64::consts::TAU * i as f64 / count as f64;
            DVec2::from_angle(angle) * (1.0 + 0.4 * (angle * waves as f64 + seed as f64).sin())
        })
        .collect();
    Polygon::new(&ring)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    /// Whatever a piece looks like, needles and specks too, its hulls are built and it falls onto the ground.
    #[test]
    fn any_flat_piece_has_a_shape_that_lands(
        radii in prop::collection::vec(0.05_f64..1.0, 3..60),
        long in 1e-3_f64..0.5,
        slim in 0.01_f64..1.0,
        thickness in 1e-3_f64..0.02,
        turn in 0.0_f64..6.3,
    ) {
        let count = radii.len();
        let ring: Vec<DVec2> = radii.iter().enumerate().map(|(i, r)| {
            let p = DVec2::from_angle(std::f64::consts::TAU * i as f64 / count as f64) * *r * long;
            DVec2::from_angle(turn).rotate(DVec2::new(p.x, p.y * slim))
        }).collect();
        let outline = Polygon::new(&ring);
        let shape = CollisionShape::of_flat(&outline, thickness, DQuat::IDENTITY);
        let CollisionShape::Hulls(hulls) = &shape else { panic!("a flat piece has hulls") };
        prop_assert!(!hulls.is_empty());
        let lowest = glass::drop_onto_ground(shape, &outline, thickness);
        prop_assert!(lowest > -2e-3 && lowest < 2e-3 + 0.05 * long, "it lies {lowest} m above the ground");
    }
}
