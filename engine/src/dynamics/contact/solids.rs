//! What bodies and the ground are made of, as the library has it: found when it is first asked for.

use std::cell::OnceCell;

use boxddd::BodyId;
use glam::DVec3;

use super::convex::Convex;

/// The convex solids of all bodies, in their principal axes.
pub struct Solids {
    bodies: Vec<Parts>,
    /// The ground's body, and what it is.
    ground: Option<(BodyId, Vec<Convex>)>,
}

/// The parts of one body.
#[derive(Clone, Default)]
struct Parts {
    /// The corners of each part [m].
    corners: Vec<Vec<DVec3>>,
    solids: OnceCell<Vec<Convex>>,
}

impl Solids {
    /// Of so many bodies, nothing of which is known yet, and of the ground: its body, and the height of its surface in the
    /// axes of that [m].
    pub fn new(count: usize, ground: Option<(BodyId, f64)>) -> Self {
        let ground = ground.map(|(id, height)| (id, vec![Convex::below(height)]));
        Self { bodies: vec![Parts::default(); count], ground }
    }

    /// Takes in the corners of a body's parts [m].
    pub fn set(&mut self, index: usize, corners: Vec<Vec<DVec3>>) {
        self.bodies[index] = Parts { corners, solids: OnceCell::new() };
    }

    /// The parts of a body.
    pub fn of(&self, index: usize) -> &[Convex] {
        let Parts { corners, solids } = &self.bodies[index];
        solids.get_or_init(|| corners.iter().map(|points| Convex::hull_of(points)).collect())
    }

    /// The parts of what has no number: the ground, if that is its body.
    pub fn of_ground(&self, id: BodyId) -> Option<&[Convex]> {
        self.ground.as_ref().filter(|(ground, _)| *ground == id).map(|(_, solids)| solids.as_slice())
    }
}
