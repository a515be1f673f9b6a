//! Mortar: what a joint bears, against the strength of materials, and a wall that stays together.

mod wall;

use brisance_engine::charge::Charge;
use brisance_engine::dynamics::contact::{
    Bond, CollisionShape, ContactBody, ContactWorld, LONGEST_STEP, Mortar, Passes, bonds_of_bricks,
};
use brisance_engine::dynamics::{GRAVITY, RigidBody};
use brisance_engine::loading::Resistance;
use glam::{DQuat, DVec3};
use wall::{BRICK, bricks, run, scene};

const SIZE: DVec3 = DVec3::new(0.3, 0.2, 0.1);
const MASS: f64 = 12.0;

/// Bricks in a row, the first one anchored, bound together, with no ground below.
fn row(places: &[DVec3], mortar: Mortar) -> (ContactWorld, Vec<Bond>) {
    let bodies = (0..places.len()).map(|index| ContactBody {
        shape: CollisionShape::of_box(SIZE, DQuat::IDENTITY),
        friction: 0.6,
        anchored: index == 0,
        passes: Passes::Nothing,
    });
    let mut world = ContactWorld::new(bodies.collect(), None, DVec3::ZERO);
    let moments = (DVec3::splat(SIZE.length_squared()) - SIZE * SIZE) * (MASS / 12.0);
    for (index, &position) in places.iter().enumerate() {
        let state = RigidBody {
            position,
            world_from_principal: DQuat::IDENTITY,
            velocity: DVec3::ZERO,
            angular_momentum: DVec3::ZERO,
            inverse_mass: 1.0 / MASS,
            inverse_moments: moments.recip(),
            resistance: Resistance::new(DVec3::ONE, 1.0, None, MASS),
            reach: SIZE.length() * 0.5,
        };
        world.join(index, &state, true);
    }
    let placed: Vec<_> = places.iter().enumerate().map(|(i, &p)| (i, p, SIZE)).collect();
    let bonds = bonds_of_bricks(&placed, DQuat::IDENTITY, mortar);
    world.bind(&bonds);
    (world, bonds)
}

fn hold(world: &mut ContactWorld) -> usize {
    for _ in 0..(1.0 / LONGEST_STEP) as usize {
        world.step(LONGEST_STEP, |_, _, _, _, _| {});
    }
    world.bonds()
}

/// One brick under another hangs by the joint between them: σ = m g / A. It holds with a quarter more strength than
/// that and falls with a quarter less.
#[test]
fn a_brick_hangs_by_its_joint_as_long_as_that_bears_its_weight() {
    let stress = MASS * GRAVITY / (SIZE.x * SIZE.z);
    for (strength, holds) in [(1.25, 1), (0.75, 0)] {
        let mortar = Mortar { tensile: strength * stress, shear: 1e6, gap: 0.0 };
        let (mut world, bonds) = row(&[DVec3::ZERO, DVec3::NEG_Y * SIZE.y], mortar);
        assert_eq!(bonds.len(), 1);
        assert_eq!(hold(&mut world), holds, "with {strength} times the stress");
    }
}

/// A brick stuck to the side of another shears their joint, τ = m g / A, and bends it, M = m g L/2 on a section of height
/// h: σ = 6 M / (b h²).
#[test]
fn a_brick_at_the_side_shears_and_bends_its_joint() {
    let weight = MASS * GRAVITY;
    let shear = weight / (SIZE.y * SIZE.z);
    let bending = 6.0 * weight * 0.5 * SIZE.x / (SIZE.z * SIZE.y * SIZE.y);
    for (tensile, sheared, holds) in
        [(1.25, 1.25, 1), (0.75, 1.25, 0), (1.25, 0.75, 0), (1e3, 1.25, 1), (1.25, 1e3, 1)]
    {
        let mortar = Mortar { tensile: tensile * bending, shear: sheared * shear, gap: 0.0 };
        let (mut world, bonds) = row(&[DVec3::ZERO, DVec3::X * SIZE.x], mortar);
        assert_eq!(bonds.len(), 1);
        assert_eq!(hold(&mut world), holds, "with {tensile} of the bending and {sheared} of the shear");
    }
}

/// Pressure lets a joint bear more shear, tension none.
#[test]
fn pressed_joints_bear_more_shear() {
    let bond = Bond {
        bodies: [0, 1],
        middle: DVec3::ZERO,
        world_from_joint: DQuat::IDENTITY,
        size: [0.1, 0.2],
        mortar: Mortar { tensile: 1e5, shear: 2e5, gap: 0.0 },
    };
    let area = 0.02;
    assert!(bond.bears(DVec3::new(0.0, 1.9e5 * area, 0.0), DVec3::ZERO));
    assert!(!bond.bears(DVec3::new(0.0, 2.1e5 * area, 0.0), DVec3::ZERO));
    assert!(bond.bears(DVec3::new(1e5 * area, 2.3e5 * area, 0.0), DVec3::ZERO));
    assert!(!bond.bears(DVec3::new(1e5 * area, 2.5e5 * area, 0.0), DVec3::ZERO));
    assert!(!bond.bears(DVec3::new(-1.1e5 * area, 0.0, 0.0), DVec3::ZERO));
}

/// Every brick of a running bond is bound to those beside, above and below it: in a wall of six courses of four, 3 + 4
/// joints in the courses and 8 between any two of them.
#[test]
fn a_wall_has_its_joints() {
    let bodies = bricks(6, 0.6);
    let placed: Vec<_> = bodies
        .iter()
        .enumerate()
        .map(|(i, body)| {
            let brisance_engine::scene::Shape::Box { size, .. } = body.shape else { unreachable!() };
            (i, body.position, size)
        })
        .collect();
    let mortar = Mortar { tensile: 1.0, shear: 1.0, gap: 0.0 };
    let bonds = bonds_of_bricks(&placed, DQuat::IDENTITY, mortar);
    assert_eq!(bonds.len(), 3 * (3 + 4) + 5 * 8);
    let beds: f64 = bonds
        .iter()
        .filter(|b| (b.world_from_joint * DVec3::X).y.abs() > 0.5)
        .map(|b| b.size[0] * b.size[1])
        .sum();
    assert!((beds - 5.0 * 4.0 * BRICK.x * BRICK.z).abs() < 1e-9, "bed joints have {beds} m²");
}

/// The same blast throws a dry wall apart, a bound one in clumps, and leaves one of strong mortar in one piece.
#[test]
fn stronger_mortar_leaves_bricks_together() {
    let together = |strength: f64| {
        let mut scene = scene(bricks(8, 0.6), vec![Charge::tnt(8.0, DVec3::new(0.2, 0.6, -6.0))]);
        scene.dynamics.contacts = true;
        scene.time.duration = 6.0;
        if strength > 0.0 {
            scene.mortar.insert(0, Mortar { tensile: strength, shear: strength, gap: 0.0 });
        }
        let count = scene.bodies.len();
        let result = run(&scene);
        let last = &result.positions[result.positions.len() - count..];
        let placed = |i: usize| scene.bodies[i].position;
        let near = |a: usize, b: usize| {
            (placed(a).distance(placed(b)) - f64::from(last[a].distance(last[b]))).abs() < 5e-3
        };
        let pairs = || (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b)));
        let neighbours = pairs().filter(|&(a, b)| placed(a).distance(placed(b)) < 0.36);
        neighbours.clone().filter(|&(a, b)| near(a, b)).count() as f64 / neighbours.count() as f64
    };
    let [dry, lime, strong] = [0.0, 3e5, 1e8].map(together);
    println!("neighbours still together: dry {dry:.2}, lime {lime:.2}, strong {strong:.2}");
    assert!(dry < lime && lime < strong && strong > 0.99, "{dry}, {lime}, {strong}");
}
