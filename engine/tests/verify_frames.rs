//! Glass that leaves its frame and meets it again.

mod glazed;

use brisance_engine::dynamics::GRAVITY;
use brisance_engine::scene::{Body, Time};
use brisance_engine::window::Release;
use glam::{DQuat, DVec3};
use glazed::{run, scene, wall::block, window};

/// Half the frame's depth [m], and the width of its bars [m].
const DEPTH: f64 = 0.03;
const WIDTH: f64 = 0.05;
/// How deep the pane sits in it [m].
const BITE: f64 = 0.01;

/// Centre and half edges of the bars round a pane of a square metre [m]: below, above, left, right.
fn bars() -> [(DVec3, DVec3); 4] {
    let out = 0.5 - BITE + 0.5 * WIDTH;
    let across = DVec3::new(0.5 - BITE + WIDTH, 0.5 * WIDTH, DEPTH);
    let up = DVec3::new(0.5 * WIDTH, 0.5 - BITE, DEPTH);
    [(-DVec3::Y * out, across), (DVec3::Y * out, across), (-DVec3::X * out, up), (DVec3::X * out, up)]
}

/// Bounds overlap those of a bar.
fn overlaps(corners: impl Iterator<Item = DVec3> + Clone) -> bool {
    let low = corners.clone().fold(DVec3::INFINITY, DVec3::min);
    let high = corners.fold(DVec3::NEG_INFINITY, DVec3::max);
    bars().iter().any(|&(place, half)| low.cmplt(place + half).all() && high.cmpgt(place - half).all())
}

/// A pane in pieces that is hardly pushed falls straight down, onto the sill. A piece that once was clear of the bars does
/// not come into them again: a centre inside a bar, by more than the quarter of a millimetre that contacts give way, has
/// passed through its face. And the frame throws none: motion and height together hold no more energy than at the start,
/// but for a hundredth of what they lose in the end.
#[test]
fn glass_does_not_fall_through_its_frame() {
    let mut scene = scene(window(1.0, 1.0, 0.006, 200), 0.1, 20.0);
    scene.dynamics.contacts = true;
    scene.charges[0].gain = 0.01;
    scene.windows[0].release = Release::AllAtOnce;
    scene.time = Time { duration: 0.7, frame_rate: 500.0, step: None, until_rest: false };
    for (place, half) in bars() {
        let bar = Body { anchored: true, assembly: Some(7), ..block(2.0 * half, place, 10.0) };
        scene.bodies.push(bar);
    }
    let (panes, recording) = run(&scene);
    let (pane, first, count) = (&panes.panes[0], scene.bodies.len(), recording.facts.len());
    let vertices = pane.grown.pattern.vertices();
    let (mut fell, mut caught) = (0, 0);
    let mut energy = vec![0.0; recording.times.len() - 1];
    for piece in 0..pane.pieces.len() {
        let middle = pane.pieces.moments[piece].centroid;
        let outline =
            pane.grown.pattern.fragment(piece).rings().flatten().map(|&v| vertices[v as usize] - middle);
        let own: Vec<DVec3> = outline.flat_map(|p| [p.extend(0.003), p.extend(-0.003)]).collect();
        let poses: Vec<(DVec3, DQuat)> = (0..recording.times.len())
            .map(|frame| frame * count + first + piece)
            .map(|at| (recording.positions[at].as_dvec3(), recording.orientations[at].as_dquat()))
            .collect();
        let clear = |&(place, turn): &(DVec3, DQuat)| !overlaps(own.iter().map(move |&p| place + turn * p));
        let from = poses.iter().position(clear).unwrap_or(poses.len());
        for &(place, _) in &poses[from..] {
            let is_in = bars().iter().any(|&(bar, half)| (place - bar).abs().cmplt(half - 5e-4).all());
            assert!(!is_in, "piece {piece} of {middle} is in a bar at {place}");
        }
        let mass = pane.pieces.masses[piece].mass;
        for (energy, pair) in energy.iter_mut().zip(poses.windows(2)) {
            let velocity = (pair[1].0 - pair[0].0) * 500.0;
            let height = 0.5 * (pair[0].0.y + pair[1].0.y) - middle.y;
            *energy += mass * (0.5 * velocity.length_squared() + GRAVITY * height);
        }
        // Pieces that begin clear of the bars, and those of them that are no lower than the sill at the end.
        if from == 0 {
            fell += 1;
            caught += usize::from(poses.last().unwrap().0.y > -0.5);
        }
    }
    let most = energy.iter().copied().fold(0.0, f64::max);
    let least = energy.iter().copied().fold(0.0, f64::min);
    assert!(most < 0.01 * -least, "{most} J at most, {least} J at least");
    assert!(fell > 100 && caught > fell / 4, "{caught} of {fell} lie on the sill");
}
