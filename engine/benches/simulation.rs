//! The wall as a whole.

#[path = "../tests/wall/mod.rs"]
mod wall;

use std::hint::black_box;

use brisance_engine::simulation::Simulation;
use criterion::{Criterion, criterion_group, criterion_main};

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

criterion_group!(benches, brick_wall);
criterion_main!(benches);
