//! What it costs to prepare a blast and to ask it.

use std::hint::black_box;

use brisance_engine::air::Air;
use brisance_engine::blast::BlastField;
use brisance_engine::blast::curves::Curves;
use brisance_engine::blast::pulse::{PulseShape, friedlander_decay};
use brisance_engine::charge::{Burst, Charge, CurveSource};
use criterion::{Criterion, criterion_group, criterion_main};
use glam::DVec3;

fn blast(c: &mut Criterion) {
    let charge = Charge::tnt(100.0, DVec3::new(0.0, 0.3, -15.0));
    let air = Air::SEA_LEVEL;
    let field = BlastField::new(&charge, &air).unwrap();
    let curves = Curves::new(&CurveSource::KingeryBulmash, Burst::Air).unwrap();
    let point = field.at(DVec3::new(0.3, 0.5, 0.0));
    let pulse = point.pulse(PulseShape::Friedlander);

    c.bench_function("curves at one scaled distance", |b| b.iter(|| curves.at(black_box(3.2))));
    c.bench_function("field construction", |b| {
        b.iter(|| BlastField::new(black_box(&charge), black_box(&air)).unwrap())
    });
    c.bench_function("field at a point", |b| b.iter(|| field.at(black_box(DVec3::new(0.3, 0.5, 0.0)))));
    c.bench_function("arrival time", |b| b.iter(|| field.arrival_time(black_box(15.0))));
    c.bench_function("front radius", |b| b.iter(|| field.front_radius(black_box(0.021))));
    c.bench_function("reflection coefficient", |b| {
        b.iter(|| field.reflection_coefficient(black_box(0.83), black_box(7e4)))
    });
    c.bench_function("friedlander decay", |b| {
        b.iter(|| friedlander_decay(black_box(7e4), black_box(13e-3), black_box(280.0)))
    });
    c.bench_function("pulse impulse over a step", |b| {
        b.iter(|| pulse.impulse(black_box(1e-3), black_box(1.1e-3)))
    });
}

criterion_group!(benches, blast);
criterion_main!(benches);
