//! The same scene gives the same bytes for any number of threads.

mod wall;

use brisance_engine::charge::Charge;
use glam::DVec3;

/// Enough bricks for the threads to share the work.
fn yard() -> brisance_engine::scene::Scene {
    let mut bodies = Vec::new();
    for i in 0..3000 {
        let place = DVec3::new(f64::from(i % 60) - 30.0, 0.08, f64::from(i / 60));
        bodies.push(wall::block(wall::BRICK, place, 10.0));
    }
    wall::scene(bodies, vec![Charge::tnt(500.0, DVec3::new(0.0, 1.0, -8.0))])
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let mut twice = yard();
    twice.charges.push(Charge { time: 0.2, ..Charge::tnt(100.0, DVec3::new(5.0, 10.0, 20.0)) });
    for scene in [wall::wall(), yard(), twice] {
        let runs: Vec<_> = [1, 2, 7]
            .into_iter()
            .map(|threads| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                pool.install(|| wall::run(&scene))
            })
            .collect();
        assert_eq!(runs[0].positions, runs[1].positions);
        assert_eq!(runs[0].orientations, runs[1].orientations);
        assert!(runs[0].positions == runs[2].positions && runs[0].orientations == runs[2].orientations);
    }
}
