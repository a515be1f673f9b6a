//! Windows as a whole: shelter, breaking, loads and flight.

#[path = "../tests/glazed/mod.rs"]
mod glazed;

use std::hint::black_box;

use brisance_engine::dynamics::ground::Ground;
use brisance_engine::scene::{Scene, Time};
use brisance_engine::window::Release;
use criterion::{Criterion, criterion_group, criterion_main};

/// A metre square of 6 mm on its way to the ground.
fn scene(pieces: usize, frames: usize, frame_rate: f64) -> Scene {
    let mut window = glazed::window(1.0, 1.0, 0.006, pieces);
    window.recipe.wiggle_probability = 0.5;
    window.drag_coefficient = 1.17;
    window.lift_coefficient = None;
    window.facade = 3.0;
    let mut scene = glazed::scene(window, 500.0, 110.0);
    scene.charges[0].time = -0.26;
    scene.ground = Some(Ground { height: -1.6, friction: 0.5 });
    scene.time =
        Time { duration: (frames - 1) as f64 / frame_rate, frame_rate, step: None, until_rest: false };
    scene
}

/// The thesis's window in 1 000 pieces, uncoupled, 100 frames: at most 60 ms. The coupled window in some 5 000, as the
/// load asks, 121 frames: at most 300 ms. 10 000 pieces, 240 frames: at most 1 s. On two cores.
fn windows(c: &mut Criterion) {
    let mut uncoupled = scene(1000, 100, 200.0);
    uncoupled.windows[0].release = Release::AllAtOnce;
    uncoupled.windows[0].bite = None;
    let mut coupled = scene(1, 121, 240.0);
    coupled.windows[0].by_load = true;
    let many = scene(10_000, 240, 240.0);
    let mut group = c.benchmark_group("window");
    group.sample_size(10);
    for (name, scene) in [
        ("all at once, 1 000 pieces, 100 frames", &uncoupled),
        ("as it cracks, by load, 121 frames", &coupled),
        ("as it cracks, 10 000 pieces, 240 frames", &many),
    ] {
        group.bench_function(name, |b| b.iter(|| glazed::run(black_box(scene))));
        let panes = glazed::panes(scene);
        println!("  {} pieces", panes.panes[0].pieces.len());
        group.bench_function(format!("{name}: breaking"), |b| b.iter(|| glazed::panes(black_box(scene))));
    }
    group.finish();
}

criterion_group!(benches, windows);
criterion_main!(benches);
