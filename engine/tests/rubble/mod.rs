//! Boxes, shards and meshes as bodies in the contact world, and how deep they are in each other: by their true outlines,
//! not by their collision shapes.

#[path = "../following/mod.rs"]
mod following;

use brisance_engine::dynamics::contact::{CollisionShape, ContactBody, ContactWorld, Passes, REACH, step_at};
use brisance_engine::dynamics::ground::Ground;
use brisance_engine::dynamics::{GRAVITY, RigidBody};
use brisance_engine::geometry::{MassProperties, Polygon, PrincipalAxes, TriangleMesh};
use brisance_engine::loading::Resistance;
use following::follow;
use glam::{DQuat, DVec2, DVec3};

/// What a body truly is, about its centre of mass in its own frame.
#[derive(Clone)]
pub enum Solid {
    /// A box with these half edges [m].
    Box(DVec3),
    /// A flat piece in the plane z = 0, and half its thickness [m].
    Flat(Polygon, f64),
    /// A closed mesh.
    Mesh(TriangleMesh),
}

/// A kind of body, to be thrown.
#[derive(Clone)]
pub struct Piece {
    pub solid: Solid,
    pub shape: CollisionShape,
    pub mass: f64,
    pub axes: PrincipalAxes,
    /// Points of the edges in the own frame, to look for in other bodies [m].
    edges: Vec<DVec3>,
}

impl Piece {
    pub fn of_box(size: DVec3, density: f64) -> Self {
        let mass = density * size.x * size.y * size.z;
        let axes = PrincipalAxes::of(MassProperties::of_box(size, mass).inertia);
        let shape = CollisionShape::of_box(size, axes.object_from_principal);
        let corner = |code: usize| {
            let sign = |bit: usize| if code >> bit & 1 == 0 { -0.5 } else { 0.5 };
            size * DVec3::new(sign(0), sign(1), sign(2))
        };
        let pairs = (0..8).flat_map(|a| (0..3).map(move |bit| (a, a | 1 << bit))).filter(|(a, b)| a != b);
        let edges = pairs.flat_map(|(a, b)| along(corner(a), corner(b))).collect();
        Self { solid: Solid::Box(0.5 * size), shape, mass, axes, edges }
    }

    /// A flat piece whose outline is about its centroid [m].
    pub fn of_flat(outline: Polygon, thickness: f64, density: f64) -> Self {
        let solid = outline.moments().prism(thickness, density);
        let axes = PrincipalAxes::of(solid.inertia);
        let shape = CollisionShape::of_flat(&outline, thickness, axes.object_from_principal);
        let mut edges = Vec::new();
        for ring in outline.rings() {
            for (i, &p) in ring.iter().enumerate() {
                let next = ring[(i + 1) % ring.len()];
                for z in [-0.5 * thickness, 0.5 * thickness] {
                    edges.extend(along(p.extend(z), next.extend(z)));
                }
            }
        }
        Self { solid: Solid::Flat(outline, 0.5 * thickness), shape, mass: solid.mass, axes, edges }
    }

    pub fn of_mesh(mut mesh: TriangleMesh, density: f64) -> Self {
        let solid = MassProperties::of_mesh(&mesh, density).unwrap();
        mesh.vertices.iter_mut().for_each(|p| *p -= solid.centre);
        let axes = PrincipalAxes::of(solid.inertia);
        let volume = solid.mass / density;
        let shape = CollisionShape::of_mesh(&mesh, volume, DVec3::ZERO, axes.object_from_principal);
        let edges =
            mesh.corners().flat_map(|[a, b, c]| [(a, b), (b, c), (c, a)]).flat_map(|(a, b)| along(a, b));
        Self { edges: edges.collect(), solid: Solid::Mesh(mesh), shape, mass: solid.mass, axes }
    }

    pub fn reach(&self) -> f64 {
        self.edges.iter().map(|p| p.length()).fold(0.0, f64::max)
    }

    /// How deep a point of the own frame lies within [m]; nothing or less outside.
    fn depth(&self, point: DVec3) -> f64 {
        match &self.solid {
            Solid::Box(half) => (*half - point.abs()).min_element(),
            Solid::Flat(outline, half) => {
                let across = half - point.z.abs();
                if across <= 0.0 { across } else { across.min(depth_in_outline(outline, point.truncate())) }
            }
            Solid::Mesh(mesh) if !mesh.encloses(point) => 0.0,
            Solid::Mesh(mesh) => {
                mesh.corners().map(|t| distance_to_triangle(point, t)).fold(f64::INFINITY, f64::min)
            }
        }
    }
}

/// Five points from one end to just before the other.
fn along(a: DVec3, b: DVec3) -> impl Iterator<Item = DVec3> {
    (0..5).map(move |k| a.lerp(b, 0.2 * f64::from(k)))
}

/// Distance to the nearest side of a point inside an outline; nothing outside [m].
fn depth_in_outline(outline: &Polygon, point: DVec2) -> f64 {
    let (mut inside, mut nearest) = (false, f64::INFINITY);
    for ring in outline.rings() {
        for (i, &a) in ring.iter().enumerate() {
            let b = ring[(i + 1) % ring.len()];
            if (a.y > point.y) != (b.y > point.y)
                && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)
            {
                inside = !inside;
            }
            let share = ((point - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
            nearest = nearest.min(point.distance(a.lerp(b, share)));
        }
    }
    if inside { nearest } else { 0.0 }
}

/// Distance of a point from a triangle [m].
fn distance_to_triangle(point: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let within = [(a, b), (b, c), (c, a)].iter().all(|&(p, q)| (q - p).cross(point - p).dot(normal) >= 0.0);
    let to_side = |(p, q): (DVec3, DVec3)| {
        let share = ((point - p).dot(q - p) / (q - p).length_squared().max(1e-300)).clamp(0.0, 1.0);
        point.distance(p.lerp(q, share))
    };
    let sides = [(a, b), (b, c), (c, a)].map(to_side).into_iter().fold(f64::INFINITY, f64::min);
    if within { (point - a).dot(normal).abs() } else { sides }
}

/// Where and how a body begins.
#[derive(Clone, Copy)]
pub struct Throw {
    pub position: DVec3,
    pub world_from_object: DQuat,
    pub velocity: DVec3,
    pub spin: DVec3,
    pub anchored: bool,
}

/// Bodies on the ground y = 0.
pub struct Rubble {
    pub world: ContactWorld,
    pub pieces: Vec<Piece>,
    pub states: Vec<RigidBody>,
    pub anchored: Vec<bool>,
    pub asleep: Vec<bool>,
    pub gone: Vec<bool>,
}

impl Rubble {
    pub fn new(throws: Vec<(Piece, Throw)>, friction: f64) -> Self {
        let body = |(piece, throw): &(Piece, Throw)| ContactBody {
            shape: piece.shape.clone(),
            friction,
            anchored: throw.anchored,
            passes: Passes::Nothing,
        };
        let bodies = throws.iter().map(body).collect();
        let mut world = ContactWorld::new(bodies, Some(Ground { height: 0.0, friction }), DVec3::ZERO);
        let state = |(piece, throw): &(Piece, Throw)| {
            let rotation = throw.world_from_object * piece.axes.object_from_principal;
            RigidBody {
                position: throw.position,
                world_from_principal: rotation,
                velocity: throw.velocity,
                angular_momentum: rotation.conjugate() * throw.spin * piece.axes.moments,
                inverse_mass: 1.0 / piece.mass,
                inverse_moments: piece.axes.moments.recip(),
                resistance: Resistance::new(DVec3::ONE, 1.0, None, piece.mass),
                reach: piece.reach(),
            }
        };
        let states: Vec<RigidBody> = throws.iter().map(state).collect();
        let mut gone = vec![false; states.len()];
        for (index, state) in states.iter().enumerate() {
            gone[index] = !world.join(index, state, true);
        }
        let anchored = throws.iter().map(|(_, throw)| throw.anchored).collect();
        let asleep = vec![false; states.len()];
        Self {
            world,
            pieces: throws.into_iter().map(|(piece, _)| piece).collect(),
            states,
            anchored,
            asleep,
            gone,
        }
    }

    /// A step as a run chooses it; returns its length [s].
    pub fn step(&mut self) -> f64 {
        let fastest = self.states.iter().map(|s| s.velocity.length()).fold(0.0, f64::max);
        let dt = step_at(fastest);
        let asleep = &mut self.asleep;
        follow(&mut self.world, &mut self.states, dt, |moved| asleep[moved.index] = moved.asleep);
        for (index, state) in self.states.iter_mut().enumerate() {
            if !self.gone[index] && state.position.length() > REACH {
                self.world.leave(index);
                self.gone[index] = true;
                // What it takes along is not this world's any more.
                (state.velocity, state.angular_momentum) = (DVec3::ZERO, DVec3::ZERO);
            }
        }
        dt
    }

    /// Bodies that move and are here.
    pub fn free(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.states.len()).filter(|&i| !self.anchored[i] && !self.gone[i])
    }

    /// Energy of motion and height of each body [J].
    pub fn energy_of(&self, index: usize) -> f64 {
        let state = &self.states[index];
        state.kinetic_energy() + state.position.y * GRAVITY / state.inverse_mass
    }

    pub fn energy(&self) -> f64 {
        self.free().map(|i| self.energy_of(i)).sum()
    }

    /// How deep a body is in the ground [m].
    pub fn sunk(&self, index: usize) -> f64 {
        -self.points(index).map(|p| p.y).fold(f64::INFINITY, f64::min)
    }

    /// How deep edges of one body are in another at most [m].
    pub fn inside(&self, index: usize, other: usize) -> f64 {
        let (state, piece) = (&self.states[other], &self.pieces[other]);
        if self.states[index].position.distance(state.position) > self.states[index].reach + state.reach {
            return 0.0;
        }
        let own = piece.axes.object_from_principal * state.world_from_principal.conjugate();
        self.points(index).map(|p| piece.depth(own * (p - state.position))).fold(0.0, f64::max)
    }

    fn points(&self, index: usize) -> impl Iterator<Item = DVec3> + '_ {
        let (state, piece) = (&self.states[index], &self.pieces[index]);
        let rotation = state.world_from_principal * piece.axes.object_from_principal.conjugate();
        piece.edges.iter().map(move |&p| state.position + rotation * p)
    }
}
