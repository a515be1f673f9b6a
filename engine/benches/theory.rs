//! What the theory costs: cell updates of the hydrocode beside the machine's memory bandwidth, a whole charge,
//! and a pressure–impulse diagram.

use std::hint::black_box;

use brisance_engine::hydrocode::blast::ChargeRun;
use brisance_engine::hydrocode::{
    Cells, GasState, Godunov, GodunovSettings, Motion, Scheme, Symmetry, Viscosity, ViscositySettings,
};
use brisance_engine::structure::{Oscillator, Pulse, diagram};
use criterion::{BatchSize, Bencher, Criterion, Throughput, criterion_group, criterion_main};

/// Gas in waves, so that every branch of the scheme is taken somewhere.
fn waves(symmetry: Symmetry, count: usize) -> Cells {
    Cells::ideal(symmetry, (0.0, 1.0), count, 1.4, |r| {
        let wave = (40.0 * r).sin();
        GasState { density: 1.0 + 0.5 * wave, velocity: 0.3 * wave, pressure: 1.0 + 0.3 * wave }
    })
}

/// Steps of one cell in one second, as elements a second: in the cache (1000 cells) and in memory (a million).
fn updates(c: &mut Criterion) {
    let mut group = c.benchmark_group("cell updates");
    for (name, symmetry, motion, count) in [
        ("godunov, plane, fixed, 1e3", Symmetry::Plane, Motion::Fixed, 1_000),
        ("godunov, spherical, fixed, 1e3", Symmetry::Spherical, Motion::Fixed, 1_000),
        ("godunov, spherical, with the gas, 1e3", Symmetry::Spherical, Motion::WithGas, 1_000),
        ("godunov, plane, fixed, 1e6", Symmetry::Plane, Motion::Fixed, 1_000_000),
    ] {
        let settings = GodunovSettings { motion, ..GodunovSettings::default() };
        let start = Godunov::new(&waves(symmetry, count), settings).unwrap();
        let steps = (1_000_000 / count).max(5);
        group.sample_size(10).throughput(Throughput::Elements((steps * count) as u64));
        group.bench_function(name, |b| steps_from(b, &start, steps));
    }
    let start = Viscosity::new(&waves(Symmetry::Spherical, 1_000), ViscositySettings::default()).unwrap();
    group.throughput(Throughput::Elements(1_000_000));
    group.bench_function("viscosity, spherical, 1e3", |b| steps_from(b, &start, 1_000));
    group.finish();
}

/// The same steps every time: the work of a step does not then depend on how long the flow has run.
fn steps_from<S: Scheme + Clone>(b: &mut Bencher<'_>, start: &S, steps: usize) {
    b.iter_batched_ref(
        || start.clone(),
        |flow| (0..steps).for_each(|_| flow.step(black_box(f64::MAX)).unwrap()),
        BatchSize::PerIteration,
    );
}

/// `a = b + s c` over arrays too large for the caches: what memory can deliver to one core.
fn bandwidth(c: &mut Criterion) {
    let count = 8_000_000;
    let (mut a, b, d) = (vec![0.0_f64; count], vec![1.0_f64; count], vec![2.0_f64; count]);
    let mut group = c.benchmark_group("memory bandwidth");
    group.sample_size(10).throughput(Throughput::Bytes(24 * count as u64));
    group.bench_function("triad", |bench| {
        bench.iter(|| {
            for ((a, b), d) in a.iter_mut().zip(&b).zip(&d) {
                *a = b + 3.0 * d;
            }
            black_box(&mut a);
        });
    });
    group.finish();
}

fn whole(c: &mut Criterion) {
    let mut group = c.benchmark_group("whole");
    group.sample_size(10);
    group.bench_function("a charge from Z = 0.1 to 10", |b| {
        let run = ChargeRun::default();
        let distances: Vec<f64> = (0..=20).map(|i| 0.1 * 100.0_f64.powf(f64::from(i) / 20.0)).collect();
        b.iter(|| run.record(&mut run.godunov().unwrap(), &distances, 0.0, |_| Ok(())).unwrap());
    });
    group.bench_function("a pressure-impulse diagram of 41 points", |b| {
        let wall = Oscillator { yield_resistance: 1e5, ..Oscillator::elastic(1000.0, 4e6) };
        let pulse = Pulse::Triangle { peak: 1.0, duration: 1.0 };
        b.iter(|| diagram(black_box(&wall), &pulse, 0.05, (0.01, 100.0), 41).unwrap());
    });
    group.finish();
}

criterion_group!(benches, updates, bandwidth, whole);
criterion_main!(benches);
