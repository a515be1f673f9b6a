//! The shards of a broken pane as bodies in the contact world, thrown as a test wants them.
#![allow(dead_code)] // each test program uses its own part

#[path = "../following/mod.rs"]
mod following;

use brisance_engine::dynamics::contact::{CollisionShape, ContactBody, ContactWorld, LONGEST_STEP, Passes};
use brisance_engine::dynamics::ground::Ground;
use brisance_engine::dynamics::{GRAVITY, RigidBody};
use brisance_engine::fracture::{Fineness, Pieces, Recipe};
use brisance_engine::geometry::{Polygon, PrincipalAxes};
use brisance_engine::loading::Resistance;
use following::follow;
use glam::{DVec2, DVec3};

/// Shards in flight and on the ground.
pub struct Glass {
    pub world: ContactWorld,
    pub states: Vec<RigidBody>,
    /// Corners of each shard about its centre of mass in principal axes [m].
    pub corners: Vec<Vec<DVec3>>,
    /// What each shard is to collision detection.
    pub shapes: Vec<CollisionShape>,
}

/// A square metre of glass of this thickness [m] in about `count` pieces, standing half a metre above the ground. Every
/// piece has the velocity [m/s] and angular velocity [rad/s] that `throw` gives for its place.
pub fn pane(count: usize, thickness: f64, throw: impl Fn(DVec3) -> (DVec3, DVec3)) -> Glass {
    let square = Polygon::new(&[DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y]);
    let recipe = Recipe { fineness: Fineness::Pieces(count), ..Recipe::default() };
    let pattern = recipe.grow(&square).unwrap().pattern;
    let pieces = Pieces::of(&pattern, thickness, 2500.0).unwrap();
    let (mut bodies, mut states, mut corners, mut shapes) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let mut outline = Polygon::default();
    for index in 0..pieces.len() {
        pattern.fragment(index).outline(&mut outline);
        let middle = pieces.moments[index].centroid;
        let mut own = Polygon::default();
        for ring in outline.rings() {
            own.push_ring(ring.iter().map(|&p| p - middle));
        }
        let solid = &pieces.masses[index];
        let axes = PrincipalAxes::of(solid.inertia);
        let into_principal = axes.object_from_principal.conjugate();
        let both = [0.5 * thickness, -0.5 * thickness];
        let points: Vec<DVec3> =
            own.points().iter().flat_map(|p| both.map(|z| into_principal * p.extend(z))).collect();
        let place = DVec3::new(middle.x - 0.5, middle.y + 0.5, 0.0);
        let (velocity, spin) = throw(place);
        let area = DVec3::splat(pieces.moments[index].area);
        let mut state = RigidBody {
            position: place,
            world_from_principal: axes.object_from_principal,
            velocity,
            angular_momentum: DVec3::ZERO,
            inverse_mass: 1.0 / solid.mass,
            inverse_moments: axes.moments.recip(),
            resistance: Resistance::new(area, 1.0, None, solid.mass),
            reach: points.iter().map(|p| p.length()).fold(0.0, f64::max),
        };
        state.angular_momentum = into_principal * spin * axes.moments;
        let shape = CollisionShape::of_flat(&own, thickness, axes.object_from_principal);
        shapes.push(shape.clone());
        bodies.push(ContactBody { shape, friction: 0.5, anchored: false, passes: Passes::Nothing });
        states.push(state);
        corners.push(points);
    }
    let ground = Ground { height: 0.0, friction: 0.5 };
    let mut world = ContactWorld::new(bodies, Some(ground), DVec3::ZERO);
    for (index, state) in states.iter().enumerate() {
        world.join(index, state, true);
    }
    Glass { world, states, corners, shapes }
}

impl Glass {
    pub fn step(&mut self, dt: f64) {
        follow(&mut self.world, &mut self.states, dt, |_| {});
    }

    /// Height of the lowest corner of a shard [m].
    pub fn lowest(&self, index: usize) -> f64 {
        let state = &self.states[index];
        let height = |p: &DVec3| (state.position + state.world_from_principal * *p).y;
        self.corners[index].iter().map(height).fold(f64::INFINITY, f64::min)
    }

    /// Energy of motion and height [J].
    pub fn energy(&self) -> f64 {
        let height = |s: &RigidBody| s.position.y * GRAVITY / s.inverse_mass;
        self.kinetic_energy() + self.states.iter().map(height).sum::<f64>()
    }

    pub fn kinetic_energy(&self) -> f64 {
        self.states.iter().map(RigidBody::kinetic_energy).sum()
    }
}

/// A spin without pattern for a place, up to `most` [rad/s].
pub fn spin(place: DVec3, most: f64) -> DVec3 {
    DVec3::new((place.x * 91.7).sin(), (place.y * 57.3).sin(), ((place.x + place.y) * 71.1).sin()) * most
}

/// Drops one piece for two seconds; where its lowest corner ends [m].
pub fn drop_onto_ground(shape: CollisionShape, outline: &Polygon, thickness: f64) -> f64 {
    let middle = outline.moments().centroid;
    let solid = outline.moments().prism(thickness, 2500.0);
    let points: Vec<DVec3> = (outline.points().iter())
        .flat_map(|p| [0.5, -0.5].map(|side| (*p - middle).extend(side * thickness)))
        .collect();
    let reach = points.iter().map(|p| p.length()).fold(0.0, f64::max);
    let axes = PrincipalAxes::of(solid.inertia);
    // The shape was made about the outline's own origin; put the middle there.
    let moved = match shape {
        CollisionShape::Hulls(hulls) => CollisionShape::Hulls(
            hulls
                .into_iter()
                .map(|points| {
                    let own = |p: DVec3| axes.object_from_principal.conjugate() * (p - middle.extend(0.0));
                    points.into_iter().map(own).collect()
                })
                .collect(),
        ),
        shape => shape,
    };
    let state = RigidBody {
        position: DVec3::new(0.0, reach + 0.01, 0.0),
        world_from_principal: axes.object_from_principal,
        velocity: DVec3::ZERO,
        angular_momentum: DVec3::ZERO,
        inverse_mass: 1.0 / solid.mass,
        inverse_moments: axes.moments.recip(),
        resistance: Resistance::new(DVec3::ONE, 1.0, None, solid.mass),
        reach,
    };
    let corners = points.iter().map(|&p| axes.object_from_principal.conjugate() * p).collect();
    let shapes = vec![moved.clone()];
    let body = ContactBody { shape: moved, friction: 0.5, anchored: false, passes: Passes::Nothing };
    let mut world = ContactWorld::new(vec![body], Some(Ground { height: 0.0, friction: 0.5 }), DVec3::ZERO);
    world.join(0, &state, true);
    let mut glass = Glass { world, states: vec![state], corners: vec![corners], shapes };
    for _ in 0..(3.0 / LONGEST_STEP) as usize {
        glass.step(LONGEST_STEP);
    }
    glass.lowest(0)
}
