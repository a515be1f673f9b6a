//! Bodies that touch, against what mechanics says of a block that falls, slides, tips or stands.

mod following;
mod wall;

use std::ops::ControlFlow;

use brisance_engine::charge::Charge;
use brisance_engine::dynamics::contact::{CollisionShape, ContactBody, ContactWorld, LONGEST_STEP, Passes};
use brisance_engine::dynamics::ground::{Ground, RESTITUTION};
use brisance_engine::dynamics::{GRAVITY, RigidBody};
use brisance_engine::geometry::Polygon;
use brisance_engine::loading::Resistance;
use brisance_engine::scene::Scene;
use brisance_engine::simulation::Simulation;
use following::follow;
use glam::{DQuat, DVec2, DVec3};
use proptest::prelude::*;
use wall::{BRICK, block, bricks, run, scene};

/// As long as a run's.
const STEP: f64 = LONGEST_STEP;

/// A uniform box in the contact world.
fn solid(size: DVec3, position: DVec3, mass: f64) -> RigidBody {
    let moments = (DVec3::splat(size.length_squared()) - size * size) * (mass / 12.0);
    RigidBody {
        position,
        world_from_principal: DQuat::IDENTITY,
        velocity: DVec3::ZERO,
        angular_momentum: DVec3::ZERO,
        inverse_mass: 1.0 / mass,
        inverse_moments: moments.recip(),
        resistance: Resistance::new(DVec3::ONE, 1.0, None, mass),
        reach: size.length() * 0.5,
    }
}

struct Yard {
    world: ContactWorld,
    states: Vec<RigidBody>,
}

impl Yard {
    /// Boxes on the ground y = 0, with one friction everywhere.
    fn new(sizes: &[DVec3], states: Vec<RigidBody>, friction: f64) -> Self {
        let bodies = sizes.iter().map(|&size| ContactBody {
            shape: CollisionShape::of_box(size, DQuat::IDENTITY),
            friction,
            anchored: false,
            passes: Passes::Nothing,
        });
        let ground = Ground { height: 0.0, friction };
        let mut world = ContactWorld::new(bodies.collect(), Some(ground), DVec3::ZERO);
        for (index, state) in states.iter().enumerate() {
            world.join(index, state, true);
        }
        Self { world, states }
    }

    fn step(&mut self, dt: f64) {
        follow(&mut self.world, &mut self.states, dt, |_| {});
    }

    fn energy(&self) -> f64 {
        self.states.iter().map(|s| s.kinetic_energy() + s.position.y * GRAVITY / s.inverse_mass).sum()
    }
}

/// Dropped from a height h, a block comes up again to e² h. Box3D goes over the four corners once to give them their
/// speed back, so that the last ones take some of it from the first: by up to an eighth of the speed.
#[test]
fn a_block_bounces_as_high_as_its_restitution_says() {
    let (edge, height) = (0.2, 5.0);
    let size = DVec3::splat(edge);
    let body = solid(size, DVec3::new(0.0, height + 0.5 * edge, 0.0), 20.0);
    let mut yard = Yard::new(&[size], vec![body], 0.5);
    let (mut landed, mut highest) = (false, 0.0_f64);
    for _ in 0..(2.0 / STEP) as usize {
        yard.step(STEP);
        landed |= yard.states[0].velocity.y > 0.1;
        if landed {
            highest = highest.max(yard.states[0].position.y - 0.5 * edge);
        }
    }
    let expected = RESTITUTION * RESTITUTION * height;
    assert!(highest < 1.02 * expected && highest > 0.75 * expected, "{highest} instead of {expected}");
}

/// A block that slides at v stops after v² / (2 μ g), whatever its mass.
#[test]
fn a_block_slides_as_far_as_its_friction_says() {
    for (friction, speed, mass) in [(0.6, 3.0, 5.0), (0.3, 4.0, 200.0), (0.1, 2.0, 30.0)] {
        let size = DVec3::new(0.6, 0.1, 0.6);
        let mut body = solid(size, DVec3::new(0.0, 0.05, 0.0), mass);
        body.velocity = DVec3::X * speed;
        let mut yard = Yard::new(&[size], vec![body], friction);
        for _ in 0..(6.0 / STEP) as usize {
            yard.step(STEP);
        }
        let expected = speed * speed / (2.0 * friction * GRAVITY);
        let way = yard.states[0].position.x;
        assert!((way - expected).abs() < 0.02 * expected, "{way} instead of {expected} m at μ = {friction}");
        assert!(yard.states[0].position.z.abs() < 1e-3);
    }
}

/// A block set down on its edge falls back as long as its middle stands behind that edge, and over beyond it.
#[test]
fn a_block_tips_beyond_the_angle_at_which_its_middle_stands_over_its_edge() {
    let size = DVec3::new(0.2, 0.6, 0.2);
    let limit = (size.x / size.y).atan();
    for (angle, falls) in [(limit - 0.02, false), (limit + 0.02, true)] {
        let turn = DQuat::from_rotation_z(-angle);
        let lowest = turn * DVec3::new(0.5 * size.x, -0.5 * size.y, 0.0);
        let mut body = solid(size, DVec3::new(-lowest.x, -lowest.y, 0.0), 30.0);
        body.world_from_principal = turn;
        let mut yard = Yard::new(&[size], vec![body], 0.9);
        for _ in 0..(4.0 / STEP) as usize {
            yard.step(STEP);
        }
        let upright = (yard.states[0].world_from_principal * DVec3::Y).y;
        assert_eq!(upright < 0.5, falls, "tilted by {angle} of {limit}, it ends with its axis at {upright}");
    }
}

/// Ten blocks on each other stand for ten seconds, and sink by less than half a millimetre each.
#[test]
fn a_stack_of_ten_blocks_stands() {
    let size = DVec3::new(0.3, 0.3, 0.3);
    let states: Vec<_> =
        (0..10).map(|i| solid(size, DVec3::new(0.0, 0.15 + 0.3 * f64::from(i), 0.0), 50.0)).collect();
    let places: Vec<DVec3> = states.iter().map(|s| s.position).collect();
    let mut yard = Yard::new(&[size; 10], states, 0.6);
    for _ in 0..(10.0 / STEP) as usize {
        yard.step(STEP);
    }
    for (i, (state, place)) in yard.states.iter().zip(places).enumerate() {
        let moved = state.position - place;
        assert!(moved.length() < 5e-4 * (i + 1) as f64, "block {i} moved by {moved:?}");
    }
    assert_eq!(yard.world.awake(), 0);
}

/// Four small blocks carry one of ten thousand times their mass. Contacts alone would give way by W/(m ω²), some 30 mm,
/// three times the height of the small blocks; they may by a millimetre above and one below, and by what a body that is
/// pressed in less than that is left with.
#[test]
fn light_blocks_bear_a_heavy_one() {
    let (small, large) = (DVec3::new(0.03, 0.01, 0.03), DVec3::splat(0.3));
    let place = |x: f64, z: f64| DVec3::new(0.12 * x, 0.005, 0.12 * z);
    let mut states: Vec<_> = [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)]
        .map(|(x, z)| solid(small, place(x, z), 0.01))
        .into();
    states.push(solid(large, DVec3::Y * 0.16, 100.0));
    let mut yard = Yard::new(&[small, small, small, small, large], states, 0.6);
    for _ in 0..(3.0 / STEP) as usize {
        yard.step(STEP);
    }
    assert_eq!(yard.world.awake(), 0);
    for light in &yard.states[..4] {
        let into_ground = 0.005 - light.position.y;
        let into_heavy = light.position.y + 0.005 - (yard.states[4].position.y - 0.15);
        assert!(into_ground < 1.2e-3 && into_heavy < 1.2e-3, "by {into_ground} and {into_heavy} m");
    }
}

/// Two plates stand crossed, one through the seam between the halves of the other, which hold it from both sides. They
/// come apart: the rest of the way to the nearer edge is 23 mm.
#[test]
fn crossed_plates_come_apart() {
    let corners = |low: DVec3, high: DVec3| -> Vec<DVec3> {
        let pick = |code: usize| {
            let from = |bit: usize, low: f64, high: f64| if code >> bit & 1 == 0 { low } else { high };
            DVec3::new(from(0, low.x, high.x), from(1, low.y, high.y), from(2, low.z, high.z))
        };
        (0..8).map(pick).collect()
    };
    let (along_x, along_z) = (DVec3::new(0.2, 0.2, 0.006), DVec3::new(0.006, 0.2, 0.2));
    let halves = [(-0.1, -1e-4), (1e-4, 0.1)]
        .map(|(from, to)| corners(DVec3::new(-0.003, -0.1, from), DVec3::new(0.003, 0.1, to)));
    let shapes = [
        CollisionShape::Hulls(vec![corners(-0.5 * along_x, 0.5 * along_x)]),
        CollisionShape::Hulls(halves.into()),
    ];
    let bodies =
        shapes.map(|shape| ContactBody { shape, friction: 0.5, anchored: false, passes: Passes::Nothing });
    let mut states = [solid(along_x, DVec3::Y * 0.1, 0.6), solid(along_z, DVec3::new(0.08, 0.1, 0.0), 0.6)];
    let ground = Ground { height: 0.0, friction: 0.5 };
    let mut world = ContactWorld::new(bodies.into(), Some(ground), DVec3::ZERO);
    let mut first_apart = None;
    for (index, state) in states.iter().enumerate() {
        world.join(index, state, true);
    }
    for step in 0..(5.0 / STEP) as usize {
        follow(&mut world, &mut states, STEP, |_| {});
        // While both stand, the one reaches to 0.1 m from its middle and the other begins 3 mm before its own.
        let gap = (states[1].position - states[0].position).length() - 0.103;
        if gap > 0.0 && first_apart.is_none() {
            first_apart = Some(step as f64 * STEP);
        }
        let speed = states.iter().map(|state| state.velocity.length()).fold(0.0, f64::max);
        // They are moved, not thrown: what speed there is comes from falling over, from 0.1 m at most.
        assert!(speed < 1.5, "{speed} m/s");
    }
    assert!(first_apart.is_some_and(|time| time < 2.0), "{first_apart:?}");
    assert_eq!(world.awake(), 0);
}

/// A heap of blocks thrown at each other never gains energy. What is allowed is a thousandth of what it starts with,
/// for rounding and for contacts that are soft.
#[test]
fn energy_never_rises() {
    let size = DVec3::new(0.4, 0.2, 0.3);
    let states: Vec<_> = (0..60)
        .map(|i| {
            let k = f64::from(i);
            let mut state =
                solid(size, DVec3::new((k * 0.7).sin() * 1.5, 0.5 + 0.25 * k, (k * 1.3).cos() * 1.5), 30.0);
            state.velocity = DVec3::new(-state.position.x, -3.0, -state.position.z) * 4.0;
            state.angular_momentum = DVec3::new(k.sin(), k.cos(), 1.0);
            state
        })
        .collect();
    let mut yard = Yard::new(&[size; 60], states, 0.5);
    let start = yard.energy();
    let mut before = start;
    for step in 0..(8.0 / STEP) as usize {
        yard.step(STEP);
        let now = yard.energy();
        assert!(now < before + 1e-3 * start, "step {step}: {before} J rise to {now} J");
        before = before.min(now);
    }
    assert_eq!(yard.world.awake(), 0);
}

/// A heavy block that falls spinning onto a light one on the ground is hardly thrown up: in eighty such falls energy rises by
/// no more than 1.5 % of what there was, and most of that is height that the block gets back as it comes out of the light one,
/// which it had overlapped by a centimetre. The library alone makes 2.8 %.
#[test]
fn a_heavy_block_that_strikes_a_light_one_gains_little() {
    let sizes = [DVec3::new(0.15, 0.1, 0.2), DVec3::new(0.4, 0.3, 0.25)];
    let worst = (0..80).map(|k| {
        let turn = f64::from(k);
        let low = solid(sizes[0], DVec3::Y * 0.05, 2.0);
        let mut high = solid(sizes[1], DVec3::new(0.05 * turn.sin(), 0.8, 0.05 * turn.cos()), 120.0);
        high.world_from_principal = DQuat::from_rotation_x(turn) * DQuat::from_rotation_z(0.7 * turn);
        high.velocity = DVec3::new(0.5, -3.0, 0.3);
        high.angular_momentum = DVec3::new(turn.sin(), turn.cos(), 0.5) * 10.0 / high.inverse_moments;
        let mut yard = Yard::new(&sizes, vec![low, high], 0.5);
        let start = yard.energy();
        let (mut least, mut rise) = (start, 0.0_f64);
        for _ in 0..(2.0 / STEP) as usize {
            yard.step(STEP);
            rise = rise.max((yard.energy() - least) / start);
            least = least.min(yard.energy());
        }
        rise
    });
    let worst = worst.fold(0.0, f64::max);
    println!("energy rises by {worst}");
    assert!(worst < 1.5e-2, "energy rises by {worst}");
}

/// A half disc that stands on its round rim, of forty corners, and is tilted rocks to and fro. Its turn is damped by 3/s from
/// 0.4 s on, which leaves half of the swing after half a second: it rests after three and a half seconds, and after more than
/// five without that.
#[test]
fn what_rocks_comes_to_rest() {
    let (radius, thickness, mass) = (0.1, 0.1, 2.0);
    let rim =
        (0..=40).map(|k| DVec2::from_angle(std::f64::consts::PI * (1.0 + f64::from(k) / 40.0)) * radius);
    // The middle of a half disc.
    let outline = Polygon::new(&rim.map(|p| p + DVec2::Y * 0.4244 * radius).collect::<Vec<_>>());
    let shape = CollisionShape::of_flat(&outline, thickness, DQuat::IDENTITY);
    let mut state = solid(DVec3::new(2.0 * radius, radius, thickness), DVec3::Y * 0.0576, mass);
    state.world_from_principal = DQuat::from_rotation_z(0.3);
    let body = ContactBody { shape, friction: 0.5, anchored: false, passes: Passes::Nothing };
    let ground = Ground { height: 0.0, friction: 0.5 };
    let mut world = ContactWorld::new(vec![body], Some(ground), DVec3::ZERO);
    world.join(0, &state, true);
    let mut time = 0.0;
    while world.awake() > 0 && time < 20.0 {
        world.step(STEP, |_, _, _, _, _| {});
        time += STEP;
    }
    println!("rests after {time} s");
    assert!((0.5..4.5).contains(&time), "it rests after {time} s");
}

fn touching(mut scene: Scene, duration: f64) -> Scene {
    scene.dynamics.contacts = true;
    scene.time.duration = duration;
    scene
}

/// A charge so small and so far away that it moves nothing, which goes off at a given time [s].
fn whisper(time: f64) -> Charge {
    Charge { time, ..Charge::tnt(1e-3, DVec3::new(0.0, 1.0, -500.0)) }
}

/// A wall that nothing moves stays where it is: the bricks touch exactly and nothing drives them apart.
#[test]
fn a_standing_wall_stands_still() {
    let bodies = bricks(20, 0.6);
    let places: Vec<DVec3> = bodies.iter().map(|b| b.position).collect();
    let result = run(&touching(scene(bodies, vec![whisper(5.0)]), 12.0));
    let last = &result.positions[result.positions.len() - places.len()..];
    let moved = last.iter().zip(places).map(|(now, then)| now.as_dvec3().distance(then)).fold(0.0, f64::max);
    // Twenty courses under their own weight: contacts give way by some 0.1 mm each.
    assert!(moved < 2e-3, "moved by {moved} m");
    assert!(result.facts.iter().all(|f| f.rest_time == 0.0));
}

/// The contact world gives bodies the launch speeds of free flight, where nothing is in their way.
#[test]
fn a_free_body_is_launched_as_in_free_flight() {
    let lone = |contacts| {
        let mut scene = scene(
            vec![block(DVec3::splat(0.3), DVec3::new(0.0, 4.0, 0.0), 10.0)],
            vec![Charge::tnt(50.0, DVec3::new(0.0, 4.0, -12.0))],
        );
        scene.ground = None;
        // In free flight what hangs in the air is held by friction until it is blown away.
        scene.bodies[0].friction = 0.0;
        scene.dynamics.contacts = contacts;
        scene.time.duration = 0.1;
        run(&scene).facts[0]
    };
    let (free, touching) = (lone(false), lone(true));
    // In free flight it begins to fall when it has left its place, here when the front comes: g times the loading.
    assert!(
        (free.launch_speed - touching.launch_speed).abs() < 1e-2 * free.launch_speed,
        "{} m/s beside {}",
        free.launch_speed,
        touching.launch_speed
    );
    assert!((free.impulse - touching.impulse).length() < 1e-3 * free.impulse.length());
}

#[test]
fn the_wall_falls_down_and_comes_to_rest() {
    let mut scene = touching(wall::wall(), 20.0);
    scene.time.until_rest = true;
    let result = run(&scene);
    let count = scene.bodies.len();
    let end = *result.times.last().unwrap();
    assert!(end < 15.0, "it takes {end} s");
    assert!(result.warnings.iter().all(|w| !w.contains("still move")), "{:?}", result.warnings);
    for (facts, position) in result.facts.iter().zip(&result.positions[result.positions.len() - count..]) {
        assert!(facts.rest_time > 0.0 && facts.rest_time <= end, "rests at {}", facts.rest_time);
        assert!(position.y > 0.5 * BRICK.z as f32 - 2e-3, "lies at {position:?}");
    }
}

#[test]
fn threads_do_not_change_a_bit() {
    let scene = touching(wall::wall(), 3.0);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            Simulation::prepare(&scene).unwrap().run(&mut |_, _| ControlFlow::Continue(())).unwrap()
        })
    };
    let one = with(1);
    for threads in [1, 2, 5] {
        let other = with(threads);
        assert!(
            one.positions == other.positions && one.orientations == other.orientations,
            "{threads} threads"
        );
        // Times that never came are not numbers, which equal nothing.
        assert!(format!("{:?}", one.facts) == format!("{:?}", other.facts), "{threads} threads");
    }
}

/// How deep the corners of one box lie in another one at most [m].
fn depth(a: &RigidBody, a_size: DVec3, b: &RigidBody, b_size: DVec3) -> f64 {
    let corners = (0..8).map(|code| {
        let sign = |bit: u32| if code >> bit & 1 == 0 { -0.5 } else { 0.5 };
        a.position + a.world_from_principal * (a_size * DVec3::new(sign(0), sign(1), sign(2)))
    });
    let inside = |corner: DVec3| {
        let own = b.world_from_principal.conjugate() * (corner - b.position);
        (0.5 * b_size - own.abs()).min_element()
    };
    corners.map(inside).fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 250, ..ProptestConfig::default() })]

    /// Boxes of any size thrown at each other from anywhere come down: none is lost, none ends in the ground or in another
    /// by more than 2 mm, and energy never rises by more than a hundredth of what there was. Most gain nothing; the rest is
    /// height that they get back as they come out of what they overlapped.
    #[test]
    fn whatever_is_thrown_comes_to_lie_on_the_ground(
        boxes in prop::collection::vec(
            (0.05_f64..0.6, 0.05_f64..0.6, 0.05_f64..0.6, -1.5_f64..1.5, -1.5_f64..1.5, -20.0_f64..20.0, -20.0_f64..20.0),
            2..14,
        ),
    ) {
        let sizes: Vec<DVec3> = boxes.iter().map(|b| DVec3::new(b.0, b.1, b.2)).collect();
        let states = boxes.iter().enumerate().map(|(i, b)| {
            // One above the other, so that none begins inside another.
            let mut state = solid(sizes[i], DVec3::new(b.3, 0.6 + 1.1 * i as f64, b.4), 2000.0 * b.0 * b.1 * b.2);
            state.velocity = DVec3::new(b.5, -10.0, b.6);
            state.angular_momentum = DVec3::new(b.6, b.5, b.3) / state.inverse_moments * 0.3;
            state
        });
        let mut yard = Yard::new(&sizes, states.collect(), 0.5);
        let (start, mut before) = (yard.energy(), yard.energy());
        // A box thrown at 28 m/s slides and tumbles for some ten seconds.
        for _ in 0..(20.0 / STEP) as usize {
            yard.step(STEP);
            let now = yard.energy();
            prop_assert!(now < before + 1e-2 * start, "{before} J rise to {now} J of {start}");
            before = before.min(now);
        }
        // Nearly all sleep by then; one that rocks in a pile may not yet, but hardly moves.
        let fastest = yard.states.iter().map(|state| state.velocity.length()).fold(0.0, f64::max);
        prop_assert!(yard.world.awake() == 0 || fastest < 0.05, "{fastest} m/s");
        let ground = solid(DVec3::ONE, DVec3::new(0.0, -500.0, 0.0), 1.0);
        for (i, state) in yard.states.iter().enumerate() {
            prop_assert!(state.position.is_finite() && state.position.length() < 200.0);
            let sunk = depth(state, sizes[i], &ground, DVec3::new(1e4, 1e3, 1e4));
            prop_assert!(sunk < 2e-3, "box {i} is {sunk} m in the ground");
            for (j, other) in yard.states.iter().enumerate().filter(|&(j, _)| j != i) {
                let deep = depth(state, sizes[i], other, sizes[j]);
                prop_assert!(deep < 2e-3, "box {i} is {deep} m in box {j}");
            }
        }
    }
}
