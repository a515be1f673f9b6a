//! The wall as a whole, and free flight against the cost of moving its state through memory.

#[path = "../tests/wall/mod.rs"]
mod wall;

use std::hint::black_box;

use brisance_engine::dynamics::{Air, RigidBody};
use brisance_engine::loading::Resistance;
use brisance_engine::simulation::Simulation;
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::{DQuat, DVec3};

/// The brick wall's 40 frames, loads included: at most 2 ms on one core.
fn brick_wall(c: &mut Criterion) {
    let scene = wall::wall();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    c.bench_function("brick wall, loads, one core", |b| {
        pool.install(|| b.iter(|| Simulation::prepare(black_box(&scene)).unwrap().step()));
    });
    c.bench_function("brick wall, 40 frames, one core", |b| {
        pool.install(|| b.iter(|| wall::run(black_box(&scene))));
    });
}

fn flying(count: usize) -> Vec<RigidBody> {
    (0..count)
        .map(|i| RigidBody {
            position: DVec3::new(i as f64, 100.0, 0.0),
            world_from_principal: DQuat::IDENTITY,
            velocity: DVec3::new(3.0, 1.0, 10.0),
            angular_momentum: DVec3::new(0.1, 0.2, 0.3),
            inverse_mass: 0.1,
            inverse_moments: DVec3::new(5.0, 8.0, 12.0),
            resistance: Resistance::new(DVec3::new(0.016, 0.032, 0.0512), 1.05, None),
            reach: 0.2,
        })
        .collect()
}

/// One step of free flight a body, beside reading and writing the same state once, in the caches (1 000 and
/// 100 000 bodies) and in memory (2 million bodies, 416 MB).
fn free_flight(c: &mut Criterion) {
    let mut group = c.benchmark_group("free flight");
    let air = Air { density: 1.225, damping: 1.0 };
    for count in [1_000, 100_000, 2_000_000] {
        let mut bodies = flying(count);
        group.throughput(Throughput::Elements(count as u64));
        group.sample_size(10);
        group.bench_with_input(BenchmarkId::new("step", count), &count, |b, _| {
            b.iter(|| bodies.iter_mut().for_each(|body| body.fly(air, 1e-6)));
        });
        let mut state = flying(count);
        group.bench_with_input(BenchmarkId::new("read and write the state", count), &count, |b, _| {
            b.iter(|| {
                for body in &mut state {
                    *body = black_box(*body);
                }
            });
        });
    }
    group.finish();
}

criterion_group!(benches, brick_wall, free_flight);
criterion_main!(benches);
