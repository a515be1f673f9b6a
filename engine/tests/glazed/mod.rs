//! Windows as the tests and benchmarks use them: a pane in the plane z = 0 with a charge behind it.
#![allow(dead_code)] // each test program uses its own part

#[path = "../wall/mod.rs"]
pub mod wall;

use std::ops::ControlFlow;

use brisance_engine::charge::Charge;
use brisance_engine::fracture::{Fineness, Recipe};
use brisance_engine::geometry::Polygon;
use brisance_engine::material::GLASS;
use brisance_engine::recording::Recording;
use brisance_engine::scene::{Scene, Time};
use brisance_engine::simulation::{Panes, Shelters, Simulation};
use brisance_engine::window::{Release, Window};
use glam::{DQuat, DVec2, DVec3};

pub fn rectangle(width: f64, height: f64) -> Polygon {
    let (x, y) = (0.5 * width, 0.5 * height);
    Polygon::new(&[DVec2::new(-x, -y), DVec2::new(x, -y), DVec2::new(x, y), DVec2::new(-x, y)])
}

/// A framed pane of annealed glass about the origin, without drag or lift, in about `pieces` straight pieces.
pub fn window(width: f64, height: f64, thickness: f64, pieces: usize) -> Window {
    Window {
        outline: rectangle(width, height),
        thickness,
        position: DVec3::ZERO,
        orientation: DQuat::IDENTITY,
        material: GLASS,
        strength: 45e6,
        may_break: true,
        recipe: Recipe { fineness: Fineness::Pieces(pieces), wiggle_probability: 0.0, ..Recipe::default() },
        by_load: false,
        release: Release::AsItCracks,
        bite: Some(0.01),
        facade: 1e3,
        assembly: Some(7),
        occludes: true,
        can_rotate: true,
        friction: 0.6,
        drag_coefficient: 0.0,
        lift_coefficient: Some(0.0),
    }
}

/// A pane under `mass` [kg] of TNT `distance` [m] behind it, without ground.
pub fn scene(window: Window, mass: f64, distance: f64) -> Scene {
    let charge = Charge::tnt(mass, DVec3::new(0.0, 0.0, -distance));
    Scene {
        windows: vec![window],
        ground: None,
        time: Time { duration: 0.5, frame_rate: 100.0, step: None, until_rest: false },
        ..wall::scene(Vec::new(), vec![charge])
    }
}

/// What becomes of the panes of a scene.
pub fn panes(scene: &Scene) -> Panes {
    let mut shelters = Shelters::find(scene).unwrap();
    Panes::find(scene, &mut shelters, usize::MAX, &mut || ControlFlow::Continue(())).unwrap()
}

/// A whole run.
pub fn run(scene: &Scene) -> (Panes, Recording) {
    let go_on = &mut || ControlFlow::Continue(());
    let mut shelters = Shelters::find(scene).unwrap();
    let panes = Panes::find(scene, &mut shelters, usize::MAX, go_on).unwrap();
    let simulation = Simulation::prepare_broken(scene, shelters, &panes, go_on).unwrap();
    let recording = simulation.run(&mut |_, _| ControlFlow::Continue(())).unwrap();
    (panes, recording)
}
