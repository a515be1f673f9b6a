//! The thesis's brick wall (Fig. 3.4) as the tests and benchmarks use it: 27 bricks in six courses, 100 kg of TNT
//! 15 m behind them.
#![allow(dead_code)] // each test program uses its own part

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use brisance_engine::air::Air;
use brisance_engine::charge::Charge;
use brisance_engine::dynamics::ground::Ground;
use brisance_engine::occlusion::Settings;
use brisance_engine::recording::Recording;
use brisance_engine::scene::{Body, Dynamics, Loading, Scene, Shape, Time};
use brisance_engine::simulation::Simulation;
use glam::{DQuat, DVec3};

pub const BRICK: DVec3 = DVec3::new(0.32, 0.16, 0.10);

/// A box of its own that stands alone.
pub fn block(size: DVec3, position: DVec3, mass: f64) -> Body {
    Body {
        shape: Shape::Box { size, buried: [false; 6] },
        position,
        orientation: DQuat::IDENTITY,
        mass,
        assembly: None,
        anchored: false,
        occludes: true,
        can_rotate: true,
        friction: 0.6,
        drag_coefficient: 1.05,
        lift_coefficient: None,
        surround: 0.0,
        hold: None,
    }
}

/// Courses of four bricks, and of three between two halves.
pub fn bricks(courses: usize, friction: f64) -> Vec<Body> {
    let mut bodies = Vec::new();
    for course in 0..courses {
        let widths: &[f64] = if course % 2 == 0 { &[1.0; 4] } else { &[0.5, 1.0, 1.0, 1.0, 0.5] };
        let mut left = -2.0;
        for (column, &width) in widths.iter().enumerate() {
            let size = BRICK * DVec3::new(width, 1.0, 1.0);
            let middle = DVec3::new((left + 0.5 * width) * BRICK.x, (course as f64 + 0.5) * BRICK.y, 0.0);
            left += width;
            let buried = [column > 0, column + 1 < widths.len(), true, course + 1 < courses, false, false];
            bodies.push(Body {
                shape: Shape::Box { size, buried },
                assembly: Some(0),
                friction,
                ..block(size, middle, 10.0 * width)
            });
        }
    }
    bodies
}

pub fn scene(bodies: Vec<Body>, charges: Vec<Charge>) -> Scene {
    Scene {
        air: Air::default(),
        ground: Some(Ground { height: 0.0, friction: 0.6 }),
        charges,
        bodies,
        mortar: BTreeMap::new(),
        windows: Vec::new(),
        time: Time { duration: 0.4, frame_rate: 100.0, step: None, until_rest: false },
        loading: Loading::default(),
        occlusion: Settings::default(),
        dynamics: Dynamics::default(),
    }
}

pub fn wall() -> Scene {
    scene(bricks(6, 0.1), vec![Charge::tnt(100.0, DVec3::new(0.0, 0.3, -15.0))])
}

pub fn run(scene: &Scene) -> Recording {
    Simulation::prepare(scene).unwrap().run(&mut |_, _| ControlFlow::Continue(())).unwrap()
}
