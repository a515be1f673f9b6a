//! Free flight in blocks: the same bits as one body alone, whatever flies beside it and whatever the processor is.

use brisance_engine::dynamics::{Air, Bodies, LANES, RigidBody};
use brisance_engine::loading::Resistance;
use fearless_simd::Level;
use glam::{DQuat, DVec3};
use proptest::prelude::*;

const AIR: Air = Air { density: 1.225, damping: 1.0 };

/// Every set of instructions that this processor has.
fn levels() -> Vec<Level> {
    let best = Level::new();
    #[cfg(target_arch = "x86_64")]
    let known = [
        best.as_sse2().map(Level::Sse2),
        best.as_sse4_2().map(Level::Sse4_2),
        best.as_avx2().map(Level::Avx2),
        best.as_avx512().map(Level::Avx512),
    ];
    #[cfg(not(target_arch = "x86_64"))]
    let known = [Some(best)];
    known.into_iter().flatten().collect()
}

fn vector(range: std::ops::Range<f64>) -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(range).prop_map(DVec3::from_array)
}

fn body() -> impl Strategy<Value = RigidBody> {
    let lift = prop_oneof![Just(Some(0.0)), (0.1f64..2.0).prop_map(Some)];
    let moments = prop_oneof![Just(DVec3::INFINITY), vector(1e-6..1.0)];
    (vector(-100.0..100.0), vector(-3.0..3.0), vector(-80.0..80.0), vector(-20.0..20.0), moments, lift)
        .prop_map(|(position, turn, velocity, spin, moments, lift)| RigidBody {
            position,
            world_from_principal: DQuat::from_scaled_axis(turn),
            velocity,
            angular_momentum: if moments.is_finite() { moments * spin } else { DVec3::ZERO },
            inverse_mass: 10.0,
            inverse_moments: moments.recip(),
            resistance: Resistance::new(DVec3::new(0.01, 0.02, 0.05), 1.05, lift, 0.1),
            reach: 0.3,
        })
}

fn bits(body: &RigidBody) -> Vec<u64> {
    let numbers =
        [body.position, body.velocity, body.angular_momentum].into_iter().flat_map(|v| v.to_array());
    numbers.chain(body.world_from_principal.to_array()).map(f64::to_bits).collect()
}

proptest! {
    /// One body alone, in a block of eight, or beside bodies that do not fly: the same bits, at every width.
    #[test]
    fn a_body_flies_alike_alone_and_in_a_block(
        bodies in prop::collection::vec(body(), 1..2 * LANES),
        mask in prop::array::uniform8(prop::bool::weighted(0.8)),
        dt in 1e-5f64..1e-2,
    ) {
        let mut alone = bodies.clone();
        for (index, body) in alone.iter_mut().enumerate().filter(|(index, _)| mask[index % LANES]) {
            for _ in 0..20 {
                body.fly(AIR, dt);
            }
            prop_assert!(bits(body) != bits(&bodies[index]), "it must have moved");
        }
        for level in levels() {
            let mut together = Bodies::new(&bodies);
            for block in together.blocks_mut() {
                for _ in 0..20 {
                    block.fly(level, mask, AIR, dt);
                }
            }
            for (index, body) in alone.iter().enumerate() {
                prop_assert_eq!(bits(body), bits(&together.get(index)), "body {} at {:?}", index, level);
            }
        }
    }

    /// A block gives back the bodies it was made of, and knows how low they reach.
    #[test]
    fn a_block_holds_its_bodies(bodies in prop::collection::vec(body(), 1..2 * LANES)) {
        let mut block = Bodies::new(&bodies);
        prop_assert_eq!(block.len(), bodies.len());
        for (index, body) in bodies.iter().enumerate() {
            prop_assert_eq!(bits(body), bits(&block.get(index)));
        }
        let lowest = block.blocks_mut().iter().map(|b| b.lowest()).fold(f64::INFINITY, f64::min);
        let expected = bodies.iter().map(|b| b.position.y - b.reach).fold(f64::INFINITY, f64::min);
        prop_assert_eq!(lowest, expected);
    }

    /// Lift code on a body without lift changes nothing: a block may hold both kinds.
    #[test]
    fn a_body_without_lift_has_none(flow in vector(-100.0..100.0), turn in vector(-3.0..3.0), still: bool) {
        let chunky = Resistance::new(DVec3::new(0.01, 0.02, 0.05), 1.05, Some(0.0), 0.1);
        let flow = if still { DVec3::ZERO } else { flow };
        let rotation = DQuat::from_scaled_axis(turn);
        let (with, without) =
            (chunky.pass::<true>(flow, rotation, 1e-3, 1.0), chunky.pass::<false>(flow, rotation, 1e-3, 1.0));
        prop_assert_eq!(with.to_array().map(f64::to_bits), without.to_array().map(f64::to_bits));
    }
}

/// Faster than any step can follow, a body still has a rotation and its angular momentum.
#[test]
fn no_spin_is_too_fast() {
    for speed in [10.0, 1e4, 1e9, 1e20] {
        let mut body = RigidBody {
            position: DVec3::ZERO,
            world_from_principal: DQuat::IDENTITY,
            velocity: DVec3::ZERO,
            angular_momentum: DVec3::new(1.0, 0.9, 1.2) * speed,
            inverse_mass: 1.0,
            inverse_moments: DVec3::new(1.0, 0.7, 0.5),
            resistance: Resistance::new(DVec3::ONE, 1.0, None, 1.0),
            reach: 1.0,
        };
        let momentum = body.angular_momentum.length();
        for _ in 0..1000 {
            body.fly(AIR, 2e-3);
        }
        assert!((body.world_from_principal.length() - 1.0).abs() < 1e-12, "{speed}");
        assert!((body.angular_momentum.length() / momentum - 1.0).abs() < 1e-10, "{speed}");
    }
}
