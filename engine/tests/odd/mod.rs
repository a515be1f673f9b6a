//! Scenes that no one would build: shapes that a hull builder does not like, bodies of a micrometre beside ones of
//! kilometres, masses that do not fit their moments, many bodies in one place, mortar between very unlike ones.

use brisance_engine::dynamics::RigidBody;
use brisance_engine::dynamics::contact::{
    Bond, CollisionShape, ContactBody, ContactWorld, LONGEST_STEP, Mortar, Passes, REACH,
};
use brisance_engine::dynamics::ground::Ground;
use brisance_engine::loading::Resistance;
use glam::{DQuat, DVec3};

use crate::draws::Draws;

/// The stream of all numbers here.
const STREAM: u64 = 78;
/// Steps of a scene.
const STEPS: usize = 40;

/// A unit vector.
pub fn direction(draws: &mut Draws) -> DVec3 {
    let (y, angle) = (draws.between(-1.0, 1.0), draws.between(0.0, std::f64::consts::TAU));
    let radius = (1.0 - y * y).sqrt();
    DVec3::new(radius * angle.cos(), y, radius * angle.sin())
}

pub fn rotation(draws: &mut Draws) -> DQuat {
    let axis = direction(draws);
    DQuat::from_axis_angle(axis, draws.between(0.0, std::f64::consts::TAU))
}

/// Points that a hull builder does not like, within a cube of this size [m] about the origin.
pub fn nasty(draws: &mut Draws, size: f64) -> Vec<DVec3> {
    let mut count = 4 + (draws.unit() * 40.0) as usize;
    let thin = draws.scale(1e-9, 1e-1);
    let kind = (draws.unit() * 9.0) as usize;
    if kind == 7 {
        count = 3000;
    }
    let mut points: Vec<DVec3> = (0..count)
        .map(|k| {
            let p = DVec3::new(draws.between(-1.0, 1.0), draws.between(-1.0, 1.0), draws.between(-1.0, 1.0));
            match kind {
                // A needle, a plate, both tilted by what follows; a line; one point; nearly one plane.
                0 => p * DVec3::new(1.0, thin, thin),
                1 => p * DVec3::new(1.0, 1.0, thin),
                2 => DVec3::X * p.x,
                3 => DVec3::ONE,
                4 => DVec3::new(p.x, p.y, 0.3 * p.x - 0.2 * p.y + thin * p.z),
                // A prism over a ring with nearly straight corners, and points on a sphere.
                5 => {
                    let angle = std::f64::consts::TAU * k as f64 / count as f64;
                    DVec3::new(angle.cos(), angle.sin() * thin.sqrt(), if k % 2 == 0 { 0.2 } else { -0.2 })
                }
                6 | 7 => direction(draws),
                // On a lattice: many points in each of many planes.
                _ => (p * 3.0).round() / 3.0,
            }
        })
        .collect();
    if draws.unit() < 0.5 {
        let rotation = rotation(draws);
        points.iter_mut().for_each(|p| *p = rotation * *p);
    }
    if draws.unit() < 0.3 {
        points.extend_from_within(..);
    }
    points.iter_mut().for_each(|p| *p *= 0.5 * size);
    if draws.unit() < 0.02 {
        points[0].x = if draws.unit() < 0.5 { f64::NAN } else { f64::INFINITY };
    }
    points
}

/// A number, now and then one that no body should have.
fn odd(draws: &mut Draws, usual: f64) -> f64 {
    match (draws.unit() * 200.0) as usize {
        0 => f64::NAN,
        1 => f64::INFINITY,
        2 => 1e30,
        3 => 0.0,
        4 => 1e-30,
        _ => usual,
    }
}

/// How the bodies of a scene are placed.
#[derive(Clone, Copy)]
enum Layout {
    Spread,
    Spot,
    Column,
}

fn shape(draws: &mut Draws, size: f64) -> CollisionShape {
    if draws.chance(0.4) {
        let edges = DVec3::new(draws.scale(1e-9, 1.0), draws.scale(1e-2, 1.0), draws.scale(1e-2, 1.0));
        CollisionShape::of_box(edges * size, DQuat::IDENTITY)
    } else {
        let hulls = draws.whole(1, 3);
        CollisionShape::Hulls((0..hulls).map(|_| nasty(draws, size)).collect())
    }
}

fn state(draws: &mut Draws, size: f64, position: DVec3, fastest: f64) -> RigidBody {
    let usual = if draws.chance(0.5) {
        draws.scale(1e-2, 1.0) * 2000.0 * size.powi(3)
    } else {
        draws.scale(1e-12, 1e9)
    };
    let mass = odd(draws, usual);
    let fitting = DVec3::new(draws.scale(1e-4, 1.0), 1.0, draws.scale(0.5, 1.0)) * 0.1 * mass * size * size;
    let moments = match draws.whole(0, 4) {
        0 => DVec3::new(draws.scale(1e-25, 1e15), draws.scale(1e-25, 1e15), draws.scale(1e-25, 1e15)),
        1 => DVec3::splat(draws.scale(1e-25, 1e15)),
        _ => fitting,
    };
    let moments = moments.to_array().map(|moment| odd(draws, moment));
    let moments = DVec3::from_array(moments);
    let speed = draws.scale(1e-3, fastest);
    let spin = draws.scale(1e-3, fastest);
    let momentum = direction(draws) * odd(draws, spin) * moments;
    let (velocity, rotation) = (direction(draws) * odd(draws, speed), rotation(draws));
    let locked = draws.chance(0.05);
    RigidBody {
        position: DVec3::new(odd(draws, position.x), position.y, position.z),
        world_from_principal: if draws.chance(0.005) { rotation * 2.0 } else { rotation },
        velocity,
        angular_momentum: momentum,
        inverse_mass: 1.0 / mass,
        inverse_moments: if locked { DVec3::ZERO } else { moments.recip() },
        resistance: Resistance::new(DVec3::ONE, 1.0, None, mass),
        reach: odd(draws, size),
    }
}

fn bond(draws: &mut Draws, states: &[RigidBody]) -> Bond {
    let pick = |draws: &mut Draws| draws.whole(0, states.len() - 1);
    let one = pick(draws);
    let step = if draws.chance(0.5) { 1 } else { draws.whole(1, states.len() - 1) };
    let other = (one + step) % states.len();
    let halfway = states[one].reach / (states[one].reach + states[other].reach);
    let along = if draws.chance(0.3) { draws.unit() } else { halfway };
    let middle = states[one].position.lerp(states[other].position, along);
    let middle = if middle.is_finite() { middle.clamp_length_max(2.0 * REACH) } else { DVec3::ZERO };
    let strength = |draws: &mut Draws| if draws.chance(0.3) { 1e30 } else { draws.scale(1e-3, 1e12) };
    Bond {
        bodies: [one, other],
        middle,
        world_from_joint: rotation(draws),
        size: [draws.scale(1e-6, 1e2), draws.scale(1e-6, 1e2)],
        mortar: Mortar { tensile: strength(draws), shear: strength(draws), gap: 0.0 },
    }
}

/// What came of a scene.
#[derive(Debug, Clone, Copy, Default)]
pub struct Fate {
    pub bodies: usize,
    /// Bodies that the contact world did not take.
    pub refused: usize,
    /// Bonds that hold at first.
    pub bonds: usize,
    /// Longest step, in seconds of the clock.
    pub slowest: f64,
    /// Box3D could not solve a step; the scene ended there.
    pub unsolved: bool,
}

/// Runs the scene of a number, as long as all places and velocities are numbers.
pub fn run(seed: u64) -> Fate {
    let mut draws = Draws::new(seed, STREAM);
    let count = if draws.chance(0.2) { draws.whole(20, 60) } else { draws.whole(1, 12) };
    let (smallest, largest) = if draws.chance(0.5) { (1e-6, 1e4) } else { (1e-3, 1e1) };
    let typical = draws.scale(smallest, largest);
    let alike = draws.chance(0.4);
    let layout = match draws.whole(0, 3) {
        0 => Layout::Spread,
        1 => Layout::Spot,
        _ => Layout::Column,
    };
    let fastest = draws.scale(1e-2, 1e6);
    let (mut bodies, mut states, mut height) = (Vec::new(), Vec::new(), 0.0);
    let distance = draws.scale(1e-3, 3e3);
    for _ in 0..count {
        let size = if alike { typical * draws.scale(0.2, 5.0) } else { draws.scale(smallest, largest) };
        let position = match layout {
            Layout::Spread => direction(&mut draws) * distance * draws.unit(),
            Layout::Spot => direction(&mut draws) * 1e-3 * size,
            Layout::Column => DVec3::new(0.0, height + 0.5 * size, 0.0) + direction(&mut draws) * 0.1 * size,
        };
        height += size;
        let shape = shape(&mut draws, size);
        states.push(state(&mut draws, size, position, fastest));
        let passes = [Passes::Nothing, Passes::Nothing, Passes::Glass, Passes::Frames][draws.whole(0, 3)];
        let (friction, anchored) = (draws.between(0.0, 2.0), draws.chance(0.15));
        bodies.push(ContactBody { shape, friction, anchored, passes });
    }
    let ground = draws.chance(0.8).then(|| Ground { height: odd(&mut draws, 0.0), friction: 0.5 });
    let mut world = ContactWorld::new(bodies, ground, DVec3::ZERO);
    let mut here = vec![false; count];
    for (index, state) in states.iter().enumerate() {
        if draws.chance(0.85) {
            here[index] = world.join(index, state, draws.chance(0.8));
        }
    }
    let refused = here.iter().filter(|here| !**here).count();
    if count > 1 && draws.chance(0.5) {
        let bonds: Vec<Bond> = (0..draws.whole(1, 2 * count)).map(|_| bond(&mut draws, &states)).collect();
        world.bind(&bonds);
    }
    let bonds = world.bonds();
    let busy = draws.unit() * draws.unit();
    let (mut slowest, mut unsolved) = (0.0_f64, false);
    for _ in 0..STEPS {
        if draws.chance(busy) {
            let index = draws.whole(0, count - 1);
            match draws.whole(0, 4) {
                0 if here[index] => {
                    world.leave(index);
                    here[index] = false;
                }
                0 | 1 if !here[index] => here[index] = world.join(index, &states[index], draws.chance(0.8)),
                2 => world.pass(index, Passes::Nothing),
                _ => {
                    let velocity = direction(&mut draws) * odd(&mut draws, fastest);
                    let kick = direction(&mut draws) * odd(&mut draws, fastest);
                    let state = states[index];
                    let momentum = kick / state.inverse_moments;
                    world.drive(index, &RigidBody { velocity, angular_momentum: momentum, ..state });
                }
            }
        }
        let dt = if draws.chance(0.3) { draws.scale(1e-9, LONGEST_STEP) } else { LONGEST_STEP };
        let (begun, mut far) = (std::time::Instant::now(), Vec::new());
        world.step(dt, |moved, position, rotation, velocity, spin| {
            if position.length() > REACH {
                far.push(moved.index);
            }
            let vectors = [position, velocity, spin].iter().all(|v| v.is_finite());
            unsolved |= !vectors || !rotation.is_finite();
        });
        slowest = slowest.max(begun.elapsed().as_secs_f64());
        if unsolved {
            break;
        }
        for index in far {
            world.leave(index);
            here[index] = false;
        }
    }
    Fate { bodies: count, refused, bonds, slowest, unsolved }
}
