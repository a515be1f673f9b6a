//! Numbers that are each possible and together beyond all numbers: a run ends in poses or in one sentence, never in
//! poses that are none.

mod wall;

use std::ops::ControlFlow;

use brisance_engine::blast::BlastField;
use brisance_engine::charge::Charge;
use brisance_engine::error::{Error, Result};
use brisance_engine::recording::Recording;
use brisance_engine::scene::{Body, Scene, Time};
use brisance_engine::simulation::Simulation;
use glam::DVec3;
use proptest::prelude::*;
use wall::block;

/// A post and a crate 5 m before a charge.
fn yard() -> Scene {
    let post = Body { anchored: true, ..block(DVec3::ONE, DVec3::new(3.0, 0.5, 0.0), 500.0) };
    let crate_ = block(DVec3::ONE, DVec3::new(0.0, 0.5, 0.0), 100.0);
    let mut scene = wall::scene(vec![post, crate_], vec![Charge::tnt(5.0, DVec3::new(0.0, 0.5, -5.0))]);
    scene.time = Time { duration: 0.05, frame_rate: 200.0, step: None, until_rest: false };
    scene
}

fn run(scene: &Scene) -> Result<Recording> {
    Simulation::prepare(scene)?.run(&mut |_, _| ControlFlow::Continue(()))
}

/// A crate that is thrown at 1e300 m/s, and that no air slows down, is nowhere from the first frame on after the front
/// has come to its face.
#[test]
fn a_pose_beyond_all_numbers_is_an_error_that_says_whose_and_when() {
    let mut scene = yard();
    scene.charges[0].gain = 1e300;
    scene.bodies[1].drag_coefficient = 0.0;
    let field = BlastField::new(&scene.charges[0], &scene.air).unwrap();
    let arrival = field.at(DVec3::new(0.0, 0.5, -0.5)).arrival_time;
    let frame = (arrival * scene.time.frame_rate).ceil() / scene.time.frame_rate;
    for contacts in [false, true] {
        scene.dynamics.contacts = contacts;
        let error = run(&scene).unwrap_err();
        let sentence = error.to_string();
        let Error::Overflow { whose, time, .. } = error else { panic!("{sentence}") };
        assert_eq!(whose, "body 1", "{sentence}");
        if contacts {
            // It cannot go on from the very step.
            assert!(arrival < time && time <= frame, "{arrival} {time} {frame}");
        } else {
            assert_eq!(time, frame);
        }
        assert!(sentence.contains(&format!("at {time} s")), "{sentence}");
    }
}

/// Impulses that are nothing but infinite stand in no report, even where nothing moves.
#[test]
fn a_load_beyond_all_numbers_is_an_error_too() {
    let mut scene = yard();
    scene.bodies.pop();
    scene.charges[0].gain = f64::MAX;
    let error = run(&scene).unwrap_err();
    assert!(matches!(&error, Error::Overflow { whose, .. } if whose == "body 0"), "{error}");
}

/// A magnitude from the smallest to the largest, most of them far from real ones.
fn magnitude() -> impl Strategy<Value = f64> {
    (-300.0f64..308.0).prop_map(|exponent| 10f64.powf(exponent))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn a_run_ends_in_poses_or_in_a_sentence(
        which in 0usize..12,
        value in magnitude(),
        sign in prop::bool::ANY,
        contacts in prop::bool::ANY,
    ) {
        let mut scene = yard();
        scene.dynamics.contacts = contacts;
        let signed = if sign { value } else { -value };
        let (charge, body) = (&mut scene.charges[0], &mut scene.bodies[1]);
        match which {
            0 => charge.mass = value,
            1 => charge.gain = value,
            2 => charge.position.z = signed,
            3 => charge.time = signed,
            4 => body.mass = value,
            5 => body.position.x = signed,
            6 => body.friction = value,
            7 => body.drag_coefficient = value,
            8 => body.lift_coefficient = Some(value),
            9 => body.shape = block(DVec3::new(1.0, value, 1.0), DVec3::ZERO, 1.0).shape,
            10 => scene.ground.as_mut().unwrap().height = signed,
            _ => scene.dynamics.rotation_factor = value,
        }
        match run(&scene) {
            Ok(recording) => {
                prop_assert!(recording.positions.iter().all(|p| p.is_finite()));
                prop_assert!(recording.orientations.iter().all(|q| (q.length() - 1.0).abs() < 1e-5));
                prop_assert!(recording.facts.iter().all(|facts| facts.impulse.is_finite()));
            }
            Err(error) => prop_assert!(!error.to_string().contains('\n')),
        }
    }
}
