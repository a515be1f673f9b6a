//! A thrown pane of shards in the contact world, alone: what `benches/contact_rivals.py` measures beside other engines.
//!
//! `thrown_shards COUNT THICKNESS VX VY VZ STEPS RATE` breaks a square metre of glass into about COUNT pieces that stand half
//! a metre above the ground, throws them all at that velocity [m/s], and steps them STEPS times by 1 / RATE [s] with sub-steps
//! of at most 1/1920 s. It prints one JSON object: the shards as other engines need them (convex parts about the centre of mass
//! in principal axes, mass, moments, pose, velocities), how long making and stepping took, and where all ended.

use std::time::Instant;

use brisance_engine::dynamics::RigidBody;
use brisance_engine::dynamics::contact::CollisionShape;
use glam::DVec3;
use serde_json::{Value, json};

#[path = "../engine/tests/glass/mod.rs"]
mod glass;

fn main() {
    let numbers: Vec<f64> =
        std::env::args().skip(1).map(|word| word.parse().expect("seven numbers")).collect();
    let [count, thickness, x, y, z, steps, rate] = numbers[..] else {
        panic!("thrown_shards COUNT THICKNESS VX VY VZ STEPS RATE")
    };
    let throw = |place: DVec3| (DVec3::new(x, y, z), glass::spin(place, 60.0));
    let start = Instant::now();
    let mut glass = glass::pane(count as usize, thickness, throw);
    let make = start.elapsed().as_secs_f64();
    let shards: Vec<Value> =
        glass.states.iter().zip(&glass.shapes).map(|(s, hulls)| shard(s, hulls)).collect();
    let start = Instant::now();
    for _ in 0..steps as usize {
        glass.step(1.0 / rate);
    }
    let step = start.elapsed().as_secs_f64();
    let lowest: Vec<f64> = (0..glass.states.len()).map(|index| glass.lowest(index)).collect();
    let height: Vec<f64> = glass.states.iter().map(|s| s.position.y).collect();
    let speed: Vec<f64> = glass.states.iter().map(|s| s.velocity.length()).collect();
    let asleep = glass.states.len() - glass.world.awake();
    let ours = json!({
        "make_s": make, "step_s": step, "asleep": asleep,
        "lowest_m": lowest, "height_m": height, "speed_m_s": speed,
    });
    println!("{}", json!({ "shards": shards, "ours": ours }));
}

fn shard(state: &RigidBody, shape: &CollisionShape) -> Value {
    let CollisionShape::Hulls(hulls) = shape else { unreachable!("a shard is flat") };
    let q = state.world_from_principal;
    json!({
        "parts": hulls.iter().map(|part| part.iter().map(DVec3::to_array).collect()).collect::<Vec<Vec<[f64; 3]>>>(),
        "mass_kg": 1.0 / state.inverse_mass,
        "moments_kg_m2": state.inverse_moments.recip().to_array(),
        "position_m": state.position.to_array(),
        "orientation_xyzw": [q.x, q.y, q.z, q.w],
        "velocity_m_s": state.velocity.to_array(),
        "spin_rad_s": state.angular_velocity().to_array(),
    })
}
