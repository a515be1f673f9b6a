//! Motion against closed forms, conservation laws and independent integrations.

mod wall;

use brisance_engine::dynamics::ground::Ground;
use brisance_engine::dynamics::standing::{Outcome, Place};
use brisance_engine::dynamics::{Air, Carry, Footing, GRAVITY, RigidBody, Support};
use brisance_engine::loading::Resistance;
use glam::{DQuat, DVec3};
use proptest::prelude::*;

const STILL: Air = Air { density: 1.225, damping: 1.0 };
const VACUUM: Air = Air { density: 0.0, damping: 1.0 };

fn body(mass: f64, moments: DVec3, areas: DVec3) -> RigidBody {
    RigidBody {
        position: DVec3::ZERO,
        world_from_principal: DQuat::IDENTITY,
        velocity: DVec3::ZERO,
        angular_momentum: DVec3::ZERO,
        inverse_mass: 1.0 / mass,
        inverse_moments: moments.recip(),
        resistance: Resistance::new(areas, 1.0, Some(0.0), mass),
        reach: 1.0,
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]
    /// Torque-free tumbling keeps the angular momentum to rounding and the energy within the splitting's own
    /// bounded ripple, (ωh)²/12 at worst, over ten thousand steps.
    #[test]
    fn tumbling_conserves_momentum_and_energy(
        moments in prop::array::uniform3(0.5f64..1.0),
        spin in prop::array::uniform3(-30.0f64..30.0),
    ) {
        let moments = DVec3::from_array(moments);
        let mut b = body(1.0, moments, DVec3::ONE);
        b.angular_momentum = moments * DVec3::from_array(spin);
        let before = b.angular_momentum;
        let energy = b.kinetic_energy();
        let dt = 1e-3;
        let ripple = (DVec3::from_array(spin).length() * 2.0 * dt).powi(2) / 12.0;
        for _ in 0..10_000 {
            b.turn(dt);
            prop_assert!((b.kinetic_energy() / energy - 1.0).abs() <= ripple + 1e-12);
        }
        let after = b.world_from_principal * b.angular_momentum;
        prop_assert!(after.distance(before) <= 1e-10 * before.length());
        prop_assert!((b.world_from_principal.length() - 1.0).abs() < 1e-12);
    }

    /// However it is thrown, a box ends up on the ground: never below it, never faster than it was.
    #[test]
    fn a_thrown_box_stays_above_the_ground_and_gains_no_energy(
        velocity in prop::array::uniform3(-8.0f64..8.0),
        spin in prop::array::uniform3(-20.0f64..20.0),
        turn in prop::array::uniform3(-3.0f64..3.0),
    ) {
        let size = wall::BRICK;
        let moments = DVec3::new(size.y.hypot(size.z), size.x.hypot(size.z), size.x.hypot(size.y)).powf(2.0) * (10.0 / 12.0);
        let mut b = body(10.0, moments, DVec3::ONE * 0.03);
        b.reach = 0.5 * size.length();
        b.position.y = 0.5;
        b.velocity = DVec3::from_array(velocity);
        b.world_from_principal = DQuat::from_scaled_axis(DVec3::from_array(turn));
        b.angular_momentum = moments * DVec3::from_array(spin);
        let corners: Vec<DVec3> = (0..8)
            .map(|i| size * DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)) - size * 0.5)
            .collect();
        let ground = Ground { height: 0.0, friction: 0.6 };
        let energy = |b: &RigidBody| b.kinetic_energy() + 10.0 * GRAVITY * b.position.y;
        let mut last = energy(&b);
        for _ in 0..1500 {
            let dt = 2e-3;
            b.fly(VACUUM, dt);
            let deepest = |b: &RigidBody| {
                corners.iter().map(|&c| (b.position + b.world_from_principal * c).y).fold(f64::INFINITY, f64::min)
            };
            // Being lifted out of the ground may raise the potential energy by the depth of one step.
            let lift = (-deepest(&b)).max(0.0);
            ground.meet(&mut b, &corners, 0.6);
            prop_assert!(deepest(&b) > -1e-9);
            let now = energy(&b);
            prop_assert!(now <= last + 10.0 * GRAVITY * lift + 0.01 * last.abs() , "{last} to {now}");
            last = now;
        }
    }
}

#[test]
fn a_symmetric_top_precesses_at_its_closed_form_rate() {
    // In body axes the spin turns at (I₃ − I₁)/I₁ ω₃ about the axis of symmetry.
    let moments = DVec3::new(2.0, 2.0, 1.0);
    let mut b = body(1.0, moments, DVec3::ONE);
    b.angular_momentum = moments * DVec3::new(1.0, 0.0, 5.0);
    let rate = (1.0 - 2.0) / 2.0 * 5.0;
    let (dt, steps) = (1e-3, 4000);
    for _ in 0..steps {
        b.turn(dt);
    }
    let angle = rate * dt * f64::from(steps);
    let expected = DVec3::new(2.0 * angle.cos(), 2.0 * angle.sin(), 5.0);
    assert!(b.angular_momentum.distance(expected) < 1e-4, "{} and {expected}", b.angular_momentum);
}

/// A body that spins about one of its axes turns by ωt: exactly, but for the series of the tangent, whose error of
/// 17x⁷/315 at x = ωh/2 makes it slow by x⁶/18 of itself (x = ωh/4 twice about the first two axes).
#[test]
fn spin_about_an_axis_is_steady() {
    for axis in 0..3 {
        for turn_a_step in [0.01, 0.1, 0.5, 1.0] {
            let moments = DVec3::new(0.5, 0.8, 1.0);
            let mut b = body(1.0, moments, DVec3::ONE);
            let spin = DVec3::AXES[axis] * (turn_a_step / 1e-3);
            b.angular_momentum = moments * spin;
            let steps = 100;
            for _ in 0..steps {
                b.turn(1e-3);
            }
            let expected = DQuat::from_scaled_axis(spin * 1e-3 * f64::from(steps));
            let off =
                2.0 * (1.0 - b.world_from_principal.dot(expected).abs().min(1.0)).sqrt() * 2.0_f64.sqrt();
            let x: f64 = turn_a_step / if axis == 2 { 2.0 } else { 4.0 };
            let slow = x.powi(6) / 18.0 * turn_a_step * f64::from(steps);
            assert!(off < 1.05 * slow + 1e-7, "axis {axis}, {turn_a_step} a step: {off} against {slow}");
        }
    }
}

#[test]
fn falls_at_terminal_velocity() {
    let mut b = body(1.0, DVec3::ONE, DVec3::splat(0.1));
    for _ in 0..20_000 {
        b.fly(STILL, 2e-3);
    }
    // ½ρC_D A v² = mg; along an axis the projected area is the axis's own.
    let terminal = (2.0 * GRAVITY / (1.225 * 0.1)).sqrt();
    assert!((b.velocity.y / -terminal - 1.0).abs() < 1e-4);
}

#[test]
fn range_with_quadratic_drag_agrees_with_an_independent_integration() {
    let area = 0.05;
    let mut b = body(2.0, DVec3::ONE, DVec3::splat(area));
    b.velocity = DVec3::new(40.0, 30.0, 0.0);
    // A body with three equal areas has that area from everywhere.
    let k = 0.5 * 1.225 * area / 2.0;
    let slope = |v: DVec3| DVec3::new(0.0, -GRAVITY, 0.0) - v * v.length() * k;
    let (mut x, mut v, h) = (DVec3::ZERO, b.velocity, 1e-4);
    while x.y >= 0.0 || v.y > 0.0 {
        let (a1, v1) = (slope(v), v);
        let (a2, v2) = (slope(v + a1 * (h / 2.0)), v + a1 * (h / 2.0));
        let (a3, v3) = (slope(v + a2 * (h / 2.0)), v + a2 * (h / 2.0));
        let (a4, v4) = (slope(v + a3 * h), v + a3 * h);
        x += (v1 + 2.0 * v2 + 2.0 * v3 + v4) * (h / 6.0);
        v += (a1 + 2.0 * a2 + 2.0 * a3 + a4) * (h / 6.0);
    }
    while b.position.y >= 0.0 || b.velocity.y > 0.0 {
        b.fly(STILL, 2e-3);
    }
    // Second order at 2 ms, and one step of overshoot at about 25 m/s.
    assert!((b.position.x - x.x).abs() < 0.06, "{} and {}", b.position.x, x.x);
}

fn carried(normal_force: f64) -> Carry {
    Carry { normal_force, ..Carry::default() }
}

/// Applies a steady force for a while to a standing body and lets it slide out.
fn pushed(force: f64, push_time: f64, dt: f64) -> f64 {
    let mut b = body(10.0, DVec3::ONE, DVec3::ZERO);
    let place = Place::new(&b, 2.0, 0.5);
    let mut t = 0.0;
    while t < 2.0 {
        let before = b.velocity;
        let acting = (push_time - t).clamp(0.0, dt);
        b.velocity.z += force * acting / 10.0;
        let (outcome, _) = place.resist(&mut b, before, &carried(10.0 * GRAVITY), dt);
        assert_ne!(outcome, Outcome::Leaves);
        t += dt;
    }
    b.position.z
}

#[test]
fn friction_must_be_exceeded() {
    assert_eq!(pushed(0.49 * 10.0 * GRAVITY, 1.0, 1e-3), 0.0);
    assert!(pushed(0.51 * 10.0 * GRAVITY, 1.0, 1e-3) > 0.0);
}

#[test]
fn a_pushed_block_slides_its_closed_form_distance_for_any_step() {
    // v = (F − μN)t/m, then v²/(2μg) on top of vt/2.
    let (force, time) = (200.0, 0.1);
    let v = (force - 0.5 * 10.0 * GRAVITY) * time / 10.0;
    let expected = 0.5 * v * time + v * v / (2.0 * 0.5 * GRAVITY);
    for (dt, tolerance) in [(1e-4, 1e-3), (1e-3, 1e-2), (1e-2, 5e-2)] {
        let slid = pushed(force, time, dt);
        assert!((slid / expected - 1.0).abs() < tolerance, "{dt}: {slid} and {expected}");
    }
}

/// A cube of 1 m and 10 kg with its corner at `x`, `y`.
fn cube(x: f64, y: f64) -> Footing {
    let (low, high) = (DVec3::new(x, y, 0.0), DVec3::new(x + 1.0, y + 1.0, 1.0));
    Footing { low, high, centre: (low + high) * 0.5, mass: 10.0, anchored: false, held: false }
}

fn leaving(mut support: Support, body: usize) -> Vec<usize> {
    let mut left = vec![body];
    support.leave(&mut left);
    left
}

#[test]
fn a_weight_above_is_carried_below() {
    // One brick astride two: each carries half of it, and its own weight.
    let mut support = Support::new(&[cube(-1.0, 0.0), cube(0.0, 0.0), cube(-0.5, 1.0)], Some(0.0));
    assert!((support.carry(0).normal_force - 15.0 * GRAVITY).abs() < 1e-9);
    assert!((support.carry(2).normal_force - 10.0 * GRAVITY).abs() < 1e-9);
    let mut left = vec![0];
    support.leave(&mut left);
    assert_eq!(left, [0], "the other brick still carries, just");
    assert!((support.carry(1).normal_force - 20.0 * GRAVITY).abs() < 1e-9, "all of it");
    let mut left = vec![1];
    support.leave(&mut left);
    assert_eq!(left, [1, 2], "nothing carries it any more");
}

#[test]
fn a_brick_on_a_sliver_falls() {
    // Nine tenths on the left one, one tenth on the right one.
    let support = Support::new(&[cube(-1.0, 0.0), cube(0.0, 0.0), cube(-0.9, 1.0)], Some(0.0));
    assert_eq!(leaving(support.clone(), 1), [1], "its centre is above what is left");
    assert_eq!(leaving(support, 0), [0, 2], "its centre is above nothing");
    // Between two slivers the centre is above none of them, but inside.
    let bridge =
        Support::new(&[cube(-0.9, 0.0), cube(0.9, 0.0), cube(0.0, 1.0), cube(-0.05, 0.0)], Some(0.0));
    assert_eq!(leaving(bridge, 3), [3]);
}

#[test]
fn what_overhangs_from_the_start_stays_until_something_leaves() {
    let tower = [cube(0.0, 0.0), cube(0.6, 1.0), cube(1.0, 2.0)];
    assert_eq!(leaving(Support::new(&tower, Some(0.0)), 2), [2]);
    assert_eq!(leaving(Support::new(&tower, Some(0.0)), 0), [0, 1, 2]);
}
