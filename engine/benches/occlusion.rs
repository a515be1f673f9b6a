//! What shelter costs: a yard of crates from 100 to 100 000, and one scene at rising resolution.
//!
//! Time over `elements` is the cost of a body, or of a pixel of the map. 10 000 bodies at resolution 32 must take at
//! most 0.5 s on two cores.

#[path = "../tests/shelter/mod.rs"]
mod shelter;

use std::hint::black_box;

use brisance_engine::occlusion::{Settings, SphereMap};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::DVec3;

fn bodies(c: &mut Criterion) {
    let mut group = c.benchmark_group("shelter in a yard");
    group.sample_size(10);
    let settings = Settings::default();
    for count in [100, 1_000, 10_000, 100_000] {
        let solids = shelter::yard(count);
        group.throughput(Throughput::Elements(count as u64));
        group.bench_with_input(BenchmarkId::from_parameter(count), &solids, |b, solids| {
            b.iter(|| {
                brisance_engine::occlusion::shelter(black_box(solids), DVec3::ZERO, None, &settings).unwrap()
            });
        });
    }
    group.finish();
}

fn resolutions(c: &mut Criterion) {
    let mut group = c.benchmark_group("shelter of 1 000 bodies by resolution");
    group.sample_size(10);
    let solids = shelter::yard(1_000);
    for resolution in [16, 32, 64, 128, 256] {
        let settings = Settings { resolution, ..Settings::default() };
        group.throughput(Throughput::Elements(SphereMap::new(resolution).unwrap().len() as u64));
        group.bench_with_input(BenchmarkId::from_parameter(resolution), &solids, |b, solids| {
            b.iter(|| {
                brisance_engine::occlusion::shelter(black_box(solids), DVec3::ZERO, None, &settings).unwrap()
            });
        });
    }
    group.finish();
}

criterion_group!(benches, bodies, resolutions);
criterion_main!(benches);
