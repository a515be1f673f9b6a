//! What a broken pane costs, stage by stage, on one core: growing the cracks, finding the fragments, and making solid
//! pieces of them (triangles, mass, panels, closed meshes).
//!
//! At most 10 ms for 1 000 straight-sided pieces, 100 ms for 10 000 and 1.5 s for 100 000; 2 µs a vertex of an outline
//! where cracks wiggle. Ends with a table of the cost a piece from 1 000 to 1 000 000, of which the dearest is to be
//! within 40 % of the cheapest, and of memory.

use std::hint::black_box;
use std::ops::ControlFlow;
use std::time::Instant;

use brisance_engine::fracture::{Cracks, Fineness, Pattern, Pieces, Recipe, Settings};
use brisance_engine::geometry::Polygon;
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group};
use glam::DVec2;

fn pane() -> Polygon {
    Polygon::new(&[DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y])
}

/// Settings for about `count` pieces: the critical length scales from a pattern that is quick to search for.
fn settings(count: usize, wiggles: bool) -> Settings {
    let searched = count.min(10_000);
    let recipe = Recipe {
        fineness: Fineness::Pieces(searched),
        starts: Some(count.div_ceil(15)),
        wiggle_probability: if wiggles { 0.5 } else { 0.0 },
        ..Recipe::default()
    };
    let share = Recipe { starts: Some(searched.div_ceil(15)), ..recipe.clone() };
    let found = share.grow(&pane()).expect("a pattern of some thousand pieces").settings.critical_length;
    let length = found * (searched as f64 / count as f64).sqrt();
    recipe.settings(&pane(), length, count).expect("settings for more of the same")
}

fn go_on() -> ControlFlow<()> {
    ControlFlow::Continue(())
}

fn stages(c: &mut Criterion) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let mut group = c.benchmark_group("fracture");
    group.sample_size(10);
    for count in [1_000, 10_000, 100_000] {
        let settings = settings(count, false);
        let pattern = Pattern::grow(&pane(), &settings).expect("a pattern");
        group.throughput(Throughput::Elements(pattern.len() as u64));
        group.bench_function(BenchmarkId::new("grow cracks", count), |b| {
            b.iter(|| drop(black_box(Cracks::grow(&pane(), &settings, &mut go_on))));
        });
        group.bench_function(BenchmarkId::new("grow cracks and find fragments", count), |b| {
            b.iter(|| black_box(Pattern::grow(&pane(), &settings)).expect("a pattern"));
        });
        group.bench_function(BenchmarkId::new("solid pieces", count), |b| {
            b.iter(|| pool.install(|| Pieces::of(black_box(&pattern), 6e-3, 2500.0)).expect("pieces"));
        });
    }
    group.finish();
}

/// Cost a piece and a vertex, and memory, over three decades of count: best of three runs each.
fn table() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    println!("\ncracks    pieces    grow  fragments  solids   total    a piece  a vertex  memory a piece");
    for wiggles in [false, true] {
        for count in [1_000, 10_000, 100_000, 1_000_000] {
            let settings = settings(count, wiggles);
            let mut best = [f64::INFINITY; 3];
            let (mut pieces, mut vertices, mut bytes) = (0, 0, 0);
            for _run in 0..3 {
                let started = Instant::now();
                let cracks = Cracks::grow(&pane(), &settings, &mut go_on).expect("cracks");
                let grown = started.elapsed().as_secs_f64();
                let pattern = cracks.into_pattern();
                let found = started.elapsed().as_secs_f64();
                let solids = pool.install(|| Pieces::of(&pattern, 6e-3, 2500.0)).expect("pieces");
                let made = started.elapsed().as_secs_f64();
                for (least, time) in best.iter_mut().zip([grown, found - grown, made - found]) {
                    *least = least.min(time);
                }
                pieces = pattern.len();
                vertices = pattern.fragments().flat_map(|f| f.rings()).map(<[u32]>::len).sum::<usize>();
                bytes = solids.bytes() + pattern.bytes();
            }
            let total: f64 = best.iter().sum();
            println!(
                "{} {pieces:>9} {:>6.1}ms {:>8.1}ms {:>6.1}ms {:>6.1}ms {:>7.2}µs {:>7.2}µs {:>10.0} B",
                if wiggles { "wiggling" } else { "straight" },
                1e3 * best[0],
                1e3 * best[1],
                1e3 * best[2],
                1e3 * total,
                1e6 * total / pieces as f64,
                1e6 * total / vertices as f64,
                bytes as f64 / pieces as f64,
            );
        }
    }
}

criterion_group!(benches, stages);

fn main() {
    benches();
    Criterion::default().configure_from_args().final_summary();
    table();
}
