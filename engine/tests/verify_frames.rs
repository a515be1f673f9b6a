//! Glass that leaves its frame and meets it again.

mod glazed;

use brisance_engine::charge::Charge;
use brisance_engine::dynamics::{GRAVITY, Until};
use brisance_engine::recording::Recording;
use brisance_engine::scene::{Body, Scene, Time};
use brisance_engine::simulation::Pane;
use brisance_engine::window::{Release, Window};
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
    let mut scene = framed(window(1.0, 1.0, 0.006, 200), 0.1, 20.0);
    scene.charges[0].gain = 0.01;
    scene.windows[0].release = Release::AllAtOnce;
    scene.time = Time { duration: 0.7, frame_rate: 500.0, step: None, until_rest: false };
    let (panes, recording) = run(&scene);
    let (pane, first) = (&panes.panes[0], scene.bodies.len());
    let (mut fell, mut caught) = (0, 0);
    let mut energy = vec![0.0; recording.times.len() - 1];
    for piece in 0..pane.pieces.len() {
        let middle = pane.pieces.moments[piece].centroid;
        let (own, poses) = (corners(pane, piece), poses(&recording, first + piece));
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

/// A window that breaks under `mass` [kg] of TNT `distance` [m] behind it, in its frame, with bodies that touch.
fn framed(glass: Window, mass: f64, distance: f64) -> Scene {
    let mut scene = scene(glass, mass, distance);
    scene.dynamics.contacts = true;
    for (place, half) in bars() {
        scene.bodies.push(Body { anchored: true, assembly: Some(7), ..block(2.0 * half, place, 10.0) });
    }
    scene
}

/// Poses of a body, frame by frame.
fn poses(recording: &Recording, index: usize) -> Vec<(DVec3, DQuat)> {
    let count = recording.facts.len();
    (0..recording.times.len())
        .map(|frame| frame * count + index)
        .map(|at| (recording.positions[at].as_dvec3(), recording.orientations[at].as_dquat()))
        .collect()
}

/// Corners of a piece of a pane about its centre of mass [m].
fn corners(pane: &Pane, piece: usize) -> Vec<DVec3> {
    let vertices = pane.grown.pattern.vertices();
    let middle = pane.pieces.moments[piece].centroid;
    let outline =
        pane.grown.pattern.fragment(piece).rings().flatten().map(|&v| vertices[v as usize] - middle);
    outline.flat_map(|p| [p.extend(0.003), p.extend(-0.003)]).collect()
}

fn stays(pane: &Pane, piece: usize) -> bool {
    pane.holds[piece].until == Until::Forever
}

/// A block is thrown, by a second charge near by, at the splinters that the first one has left in the frame. Where bodies
/// do not touch it flies on at the same speed; where they do the splinters stop it, come no deeper into it than the 2 mm
/// that contacts may give way, and stay in their places, under the second charge as well.
#[test]
fn splinters_in_the_frame_stop_what_is_thrown_at_them() {
    let mut glass = window(1.0, 1.0, 0.006, 200);
    glass.bite = Some(0.1);
    let mut scene = framed(glass, 500.0, 110.0);
    scene.time = Time { duration: 0.7, frame_rate: 500.0, step: None, until_rest: false };
    let (half, thrown) = (0.1, scene.bodies.len());
    scene.bodies.push(block(DVec3::splat(2.0 * half), DVec3::new(-0.36, 0.4, -0.6), 4.0));
    let mut near = Charge::tnt(1.0, DVec3::new(-0.36, 0.3, -1.8));
    near.time = 0.41;
    scene.charges.push(near);
    let speed = |path: &[(DVec3, DQuat)], frame: usize| (path[frame + 5].0.z - path[frame].0.z) * 100.0;

    scene.dynamics.contacts = false;
    let alone = poses(&run(&scene).1, thrown);
    assert!(speed(&alone, 250) > 3.0 && speed(&alone, 340) > 0.99 * speed(&alone, 250));

    scene.dynamics.contacts = true;
    let (panes, recording) = run(&scene);
    let (pane, path) = (&panes.panes[0], poses(&recording, thrown));
    assert!(speed(&path, 250) > 3.0 && speed(&path, 340) < 0.5 * speed(&path, 250), "{path:?}");
    let kept: Vec<usize> = (0..pane.pieces.len()).filter(|&piece| stays(pane, piece)).collect();
    assert!(kept.len() > 50);
    for piece in kept {
        let places = poses(&recording, scene.bodies.len() + piece);
        assert!(places[200..].iter().all(|pose| *pose == places[200]), "piece {piece} has left its place");
        let own = corners(pane, piece);
        for (&(place, turn), &(middle, about)) in places.iter().zip(&path) {
            let seen = |corner: &DVec3| about.conjugate() * (place + turn * corner - middle);
            let is_in = own.iter().map(seen).any(|corner| corner.abs().max_element() < half - 2e-3);
            assert!(!is_in, "piece {piece} is in the block at {middle}");
        }
    }
}

/// A pane that hardly anything pushes cracks, and what comes free falls past and onto what stays. Nothing throws it: from
/// when the last piece is free, motion and height together gain no more than a hundredth of what they lose in the end.
#[test]
fn splinters_throw_nothing_that_comes_free_beside_them() {
    let mut glass = window(1.0, 1.0, 0.006, 300);
    (glass.bite, glass.strength) = (Some(0.03), 1e4);
    let mut scene = framed(glass, 0.1, 20.0);
    scene.charges[0].gain = 0.05;
    let rate = 500.0;
    scene.time = Time { duration: 0.7, frame_rate: rate, step: None, until_rest: false };
    let (panes, recording) = run(&scene);
    let pane = &panes.panes[0];
    let free: Vec<usize> = (0..pane.pieces.len()).filter(|&piece| !stays(pane, piece)).collect();
    let first = scene.bodies.len();
    let last = free.iter().map(|&piece| recording.facts[first + piece].free_time).fold(0.0, f64::max);
    let from = (last * rate).ceil() as usize + 1;
    let mut energy = vec![0.0; recording.times.len() - 1 - from];
    for &piece in &free {
        let (path, mass) = (poses(&recording, first + piece), pane.pieces.masses[piece].mass);
        for (energy, pair) in energy.iter_mut().zip(path[from..].windows(2)) {
            let velocity = (pair[1].0 - pair[0].0) * rate;
            *energy += mass * (0.5 * velocity.length_squared() + GRAVITY * 0.5 * (pair[0].0.y + pair[1].0.y));
        }
    }
    let most = energy.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let lost = energy[0] - energy.last().unwrap();
    assert!(free.len() > 150 && pane.staying() > 30);
    assert!(lost > 1.0 && most - energy[0] < 0.01 * lost, "{most} J after {} J, {lost} J lost", energy[0]);
}

/// A pane that holds is there for others. A box that was put into it by 2 mm is neither thrown out of it, nor falls through
/// the sill on which it stands; one that hangs before it and is thrown at it does not come through.
#[test]
fn a_pane_that_holds_stops_what_is_thrown_at_it() {
    let mut glass = window(1.0, 1.0, 0.006, 10);
    glass.may_break = false;
    let mut scene = framed(glass, 1.0, 20.0);
    scene.time = Time { duration: 1.0, frame_rate: 500.0, step: None, until_rest: false };
    let sill = -0.5 + BITE;
    let half = DVec3::new(0.04, 0.06, 0.012);
    let stands = scene.bodies.len();
    scene.bodies.push(block(2.0 * half, DVec3::new(0.3, sill + half.y, 0.001 + half.z), 0.2));
    scene.bodies.push(block(DVec3::splat(0.2), DVec3::new(0.0, 0.3, -0.3), 4.0));
    let mut near = Charge::tnt(0.3, DVec3::new(0.0, 0.3, -1.5));
    near.time = 0.1;
    scene.charges.push(near);
    let recording = run(&scene).1;
    let (standing, thrown) = (poses(&recording, stands), poses(&recording, stands + 1));
    let moved = standing.iter().map(|(place, _)| place.distance(standing[0].0)).fold(0.0, f64::max);
    let farthest = thrown.iter().map(|(place, _)| place.z).fold(f64::NEG_INFINITY, f64::max);
    assert!(moved < 5e-4, "{moved}");
    assert!(farthest < -0.1, "{farthest}");
}
