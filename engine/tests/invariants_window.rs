//! What holds for any window under any charge.

mod glazed;

use brisance_engine::dynamics::{Bowing, Hold, Swing, Until};
use brisance_engine::fracture::Glass;
use brisance_engine::loading::LoadingMode;
use brisance_engine::simulation::{Fate, Panes, Shelters};
use brisance_engine::window::Release;
use glam::{DQuat, DVec3};
use glazed::{run, scene, wall, window};
use proptest::prelude::*;
use std::ops::ControlFlow;
use std::sync::Arc;

fn glass() -> impl Strategy<Value = Glass> {
    prop_oneof![Just(Glass::Annealed), Just(Glass::Tempered), Just(Glass::Laminated)]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    /// No mass is lost, no number is lost, nothing is free before its pane has failed or the front has come, and all that
    /// may go goes: under one charge or two, from any side, in either mode, behind a block or not.
    #[test]
    fn nothing_is_lost(
        (width, height) in (0.05f64..3.0, 0.05f64..3.0),
        thickness in 0.001f64..0.02,
        (mass, distance) in (0.1f64..2000.0, 5.0f64..200.0),
        pieces in 2usize..60,
        kind in glass(),
        bite in prop::option::of(0.0f64..0.02),
        at_once in any::<bool>(),
        seed in any::<u64>(),
        turn in (-1.0f64..1.0, -3.0f64..3.0, -1.0f64..1.0),
        surface in any::<bool>(),
        later in prop::option::of(0.0f64..0.2),
        block in any::<bool>(),
    ) {
        let mut window = window(width, height, thickness, pieces);
        window.recipe.glass = kind;
        window.recipe.seed = seed;
        window.bite = bite;
        window.facade = 3.0;
        window.drag_coefficient = 1.17;
        window.lift_coefficient = None;
        if at_once {
            window.release = Release::AllAtOnce;
        }
        window.orientation = DQuat::from_scaled_axis(DVec3::new(turn.0, turn.1, turn.2));
        let mut scene = scene(window, mass, distance);
        if surface {
            scene.loading.mode = LoadingMode::Surface;
        }
        if let Some(after) = later {
            let mut second = scene.charges[0].clone();
            (second.time, second.position) = (after, DVec3::new(distance, 0.0, 0.3));
            scene.charges.push(second);
        }
        if block {
            let mut block = wall::block(DVec3::new(2.0, 6.0, 0.2), DVec3::new(-1.0, 0.0, -4.0), 900.0);
            block.anchored = true;
            scene.bodies.push(block);
        }
        // Dice of a narrow pane come in rows: not every number of them can be had.
        let grown = Panes::find(&scene, &mut Shelters::find(&scene).unwrap(), usize::MAX, &mut || ControlFlow::Continue(()));
        prop_assume!(!grown.is_err_and(|error| error.to_string().contains("cannot be had with these cracks")));
        let (panes, recording) = run(&scene);
        let pane = &panes.panes[0];
        let whole = width * height * thickness * 2500.0;
        let own = &recording.facts[scene.bodies.len()..];
        let sum: f64 = own.iter().map(|f| f.mass).sum();
        prop_assert!((sum / whole - 1.0).abs() < 1e-9);
        prop_assert!(recording.positions.iter().all(|p| p.is_finite()));
        prop_assert!(recording.orientations.iter().all(|q| (q.length() - 1.0).abs() < 1e-5));
        let earliest = match pane.fate {
            Fate::Holds => f64::INFINITY,
            Fate::Fails { time, .. } => time,
            Fate::InPieces => own.iter().map(|f| f.arrival_time).fold(f64::INFINITY, f64::min),
        };
        let end = *recording.times.last().unwrap();
        for (facts, hold) in own.iter().zip(&pane.holds) {
            prop_assert!(facts.free_time.is_nan() || facts.free_time >= earliest);
            prop_assert!(facts.impulse.is_finite() && facts.held_back.is_finite());
            // Who may go goes, within the run, sheltered or not.
            let goes = hold.until.time(facts.arrival_time);
            prop_assert!(facts.free_time.is_finite() == (goes < end), "{} {}", facts.free_time, goes);
        }
        if pane.fate == Fate::Holds || kind == Glass::Laminated {
            prop_assert_eq!(pane.staying(), pane.pieces.len());
        }
    }

    /// The velocity of a held piece is the rate of its place, its spin that of its rotation, and the swing out of the
    /// rebate begins where the pane has left it.
    #[test]
    fn held_pieces_move_as_they_say(
        samples in prop::collection::vec((-1e4f64..1e4, -1e6f64..1e6), 3..8),
        tilt in (-1e-5f64..1e-5, -1e-5f64..1e-5),
        arm in 0.01f64..0.2,
        way in 0.001f64..0.05,
        part in 0.05f64..0.95,
    ) {
        let step = 1e-3;
        let last = step * (samples.len() - 1) as f64;
        let times = (0..).map(|i| 0.01 + step * f64::from(i));
        let bowing = Bowing::new(times.zip(samples.iter().map(|&(u, v)| [u, v])).collect());
        let closed = 0.01 + 0.5 * last;
        let swing = Swing {
            axis: DVec3::Y,
            arm: DVec3::new(0.0, 0.0, arm),
            speed: 2.0,
            end: (closed + 0.01, way, 4.0),
        };
        let hold = Hold {
            bowing: Arc::new(bowing),
            deflection: 3e-6,
            tilt: DVec3::new(tilt.0, tilt.1, 0.0),
            normal: DVec3::Z,
            closed,
            swing: Some(swing),
            until: Until::Time(closed + 0.01),
        };
        for t in [0.01 + part * 0.5 * last, closed + part * 0.01] {
            let h = 1e-7;
            let (before, now, after) = (hold.at(t - h), hold.at(t), hold.at(t + h));
            let velocity = (after.shift - before.shift) / (2.0 * h);
            prop_assert!(velocity.distance(now.velocity) < 1e-4 * now.velocity.length().max(1.0));
            let turned = (after.turn * before.turn.conjugate()).normalize();
            let turned = if turned.w < 0.0 { -turned } else { turned };
            let spin = DVec3::new(turned.x, turned.y, turned.z) / h;
            prop_assert!(spin.distance(now.spin) < 0.05 * now.spin.length() + 0.1, "{} {}", spin, now.spin);
        }
        let (held, free) = (hold.at(closed), hold.at(closed + 1e-12));
        prop_assert!(held.shift.distance(free.shift) < 1e-8);
        prop_assert!(held.turn.angle_between(free.turn) < 1e-6);
        prop_assert!(hold.at(closed + 0.01).turn.is_finite() && hold.at(closed + 0.01).turn != DQuat::IDENTITY);
    }
}

/// Same seed, same bits, for any number of threads.
#[test]
fn threads_do_not_matter() {
    let mut scene = scene(window(1.0, 1.0, 0.006, 2500), 500.0, 110.0);
    scene.windows[0].drag_coefficient = 1.17;
    scene.windows[0].lift_coefficient = None;
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| run(&scene).1)
    };
    let (one, three) = (on(1), on(3));
    assert_eq!(one.positions, three.positions);
    assert_eq!(one.orientations, three.orientations);
    assert_eq!(format!("{:?}", one.facts), format!("{:?}", three.facts));
}
