//! Free flight against the cost of moving its state through memory, measured in the same run.
//!
//! A step reads 19 numbers of a body (pose, velocity, angular momentum, inverse moments, drag) and writes 13 of them
//! (pose, velocity, angular momentum): 152 bytes in, 104 bytes out. "The state" below is a pass over the same bodies
//! that reads and writes just those and does next to nothing in between, with the same instructions, on one core. It is
//! what memory alone would cost. 1 000 bodies lie in the second-level cache, 100 000 in the third, 2 million in memory.
//! The bodies are bricks, which have no lift.

use std::hint::black_box;
use std::time::Instant;

use brisance_engine::dynamics::{Air, Block, Bodies, LANES, RigidBody};
use brisance_engine::loading::Resistance;
use fearless_simd::{Level, dispatch};
use glam::{DQuat, DVec3, DVec4};

const AIR: Air = Air { density: 1.225, damping: 1.0 };
const BYTES: f64 = (152 + 104) as f64;

fn flying(count: usize) -> Bodies {
    let areas = DVec3::new(0.016, 0.032, 0.0512);
    let bodies: Vec<RigidBody> = (0..count)
        .map(|i| RigidBody {
            position: DVec3::new(i as f64, 100.0, 0.0),
            world_from_principal: DQuat::IDENTITY,
            velocity: DVec3::new(3.0, 1.0, 10.0),
            angular_momentum: DVec3::new(0.1, 0.2, 0.3),
            inverse_mass: 0.1,
            inverse_moments: DVec3::new(5.0, 8.0, 12.0),
            resistance: Resistance::new(areas, 1.05, None, 10.0),
            reach: 0.2,
        })
        .collect();
    Bodies::new(&bodies)
}

fn step(bodies: &mut Bodies, level: Level) {
    for block in bodies.blocks_mut() {
        block.fly(level, [true; LANES], AIR, 1e-6);
    }
}

/// Reads and writes what a step does.
fn touch(bodies: &mut Bodies, level: Level, nothing: f64) {
    for block in bodies.blocks_mut() {
        dispatch!(level, _ => touch_block(block, nothing));
    }
}

#[inline(always)]
fn touch_block(block: &mut Block, nothing: f64) {
    for lane in 0..LANES {
        let mut body = block.get(lane);
        let shift = (body.inverse_moments + body.resistance.drag) * nothing;
        body.position += shift;
        body.velocity += shift;
        body.angular_momentum += shift;
        let rotation = DVec4::from(body.world_from_principal) + shift.extend(shift.x);
        body.world_from_principal = DQuat::from_vec4(rotation);
        block.set(lane, &body);
    }
}

/// What a call costs a body [ns], the best of a few timings of about a millisecond, short enough to miss most of what
/// else the machine does.
fn nanoseconds(count: usize, mut work: impl FnMut()) -> f64 {
    let calls = (100_000 / count).max(1);
    let timing = |_| {
        let start = Instant::now();
        (0..calls).for_each(|_| work());
        start.elapsed().as_secs_f64()
    };
    (0..4).map(timing).fold(f64::INFINITY, f64::min) * 1e9 / (calls * count) as f64
}

fn measure(level: Level) {
    println!("free flight on one core, {level:?}");
    println!("   bodies   step ns/body   state ns/body   state GB/s   step / state");
    let mut steps = Vec::new();
    for count in [1_000, 100_000, 2_000_000] {
        let mut bodies = flying(count);
        let (mut stepped, mut touched) = (f64::INFINITY, f64::INFINITY);
        // In turn, so that a disturbance meets both.
        for _ in 0..if count < 1_000_000 { 50 } else { 5 } {
            stepped = stepped.min(nanoseconds(count, || step(black_box(&mut bodies), level)));
            touched =
                touched.min(nanoseconds(count, || touch(black_box(&mut bodies), level, black_box(0.0))));
        }
        let ratio = stepped / touched;
        println!("{count:9} {stepped:14.2} {touched:15.2} {:12.1} {ratio:14.2}", BYTES / touched);
        steps.push(stepped);
    }
    println!("one of 100 000 costs {:.2} times one of 1 000\n", steps[1] / steps[0]);
}

fn main() {
    let best = Level::new();
    measure(best);
    #[cfg(target_arch = "x86_64")]
    for narrower in [best.as_avx2().map(Level::Avx2), best.as_sse2().map(Level::Sse2)].into_iter().flatten() {
        measure(narrower);
    }
}
