//! What a fragment costs, stage by stage, one core: moments, triangles, panels, closed mesh, and all of them.
//!
//! Straight-sided pieces of a mosaic with 4 to 8 corners, T-junctions among them, and bent shards of 250 corners.
//! The time shown is for the whole set; the throughput is in pieces. A thousand pieces in all of a fracture have
//! 10 ms, the crack tree included.

#[path = "../tests/fragments/mod.rs"]
mod fragments;

use std::hint::black_box;

use brisance_engine::geometry::{PieceMeshes, PlaneMoments, Polygon, Sample, Triangulator, sample_panels};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

/// All that a thread keeps from piece to piece.
#[derive(Default)]
struct Scratch {
    triangulator: Triangulator,
    triangles: Vec<[u32; 3]>,
    samples: Vec<Sample>,
    meshes: PieceMeshes,
}

const THICKNESS: f64 = 0.006;

impl Scratch {
    fn make(&mut self, piece: &Polygon) {
        let moments = piece.moments();
        black_box(moments.prism(THICKNESS, 2500.0));
        sample_panels(piece, &moments, &mut self.samples);
        self.triangulator.triangulate(piece, &mut self.triangles).unwrap();
        self.meshes.push_prism(piece, &self.triangles, moments.centroid, THICKNESS);
    }

    fn clear(&mut self) {
        self.samples.clear();
        self.meshes.clear();
    }
}

fn stages(c: &mut Criterion, name: &str, pieces: &[Polygon]) {
    let mut group = c.benchmark_group(name);
    group.throughput(Throughput::Elements(pieces.len() as u64));
    group.bench_function("moments and mass", |b| {
        b.iter(|| {
            for piece in pieces {
                black_box(piece.moments().prism(THICKNESS, 2500.0));
            }
        });
    });
    let mut scratch = Scratch::default();
    group.bench_function("triangles", |b| {
        b.iter(|| {
            for piece in pieces {
                scratch.triangulator.triangulate(black_box(piece), &mut scratch.triangles).unwrap();
            }
        });
    });
    let moments: Vec<PlaneMoments> = pieces.iter().map(Polygon::moments).collect();
    group.bench_function("panels", |b| {
        b.iter(|| {
            scratch.samples.clear();
            for (piece, moments) in pieces.iter().zip(&moments) {
                sample_panels(black_box(piece), moments, &mut scratch.samples);
            }
        });
    });
    let triangles: Vec<Vec<[u32; 3]>> = pieces
        .iter()
        .map(|piece| {
            scratch.triangulator.triangulate(piece, &mut scratch.triangles).unwrap();
            scratch.triangles.clone()
        })
        .collect();
    group.bench_function("closed mesh", |b| {
        b.iter(|| {
            scratch.meshes.clear();
            for ((piece, moments), triangles) in pieces.iter().zip(&moments).zip(&triangles) {
                scratch.meshes.push_prism(black_box(piece), triangles, moments.centroid, THICKNESS);
            }
        });
    });
    group.bench_function("all", |b| {
        b.iter(|| {
            scratch.clear();
            pieces.iter().for_each(|piece| scratch.make(black_box(piece)));
        });
    });
    group.finish();
}

fn fragments_of_both_kinds(c: &mut Criterion) {
    let straight: Vec<Polygon> = fragments::mosaic(2000, 1)
        .into_iter()
        .filter(|piece| (4..=8).contains(&piece.points().len()))
        .take(1000)
        .collect();
    stages(c, "1000 straight pieces of 4 to 8 corners", &straight);
    let bent: Vec<Polygon> = (0..20).map(|seed| fragments::shard(250, seed)).collect();
    stages(c, "20 bent pieces of 250 corners", &bent);
}

criterion_group!(benches, fragments_of_both_kinds);
criterion_main!(benches);
