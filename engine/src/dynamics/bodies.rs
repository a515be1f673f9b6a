//! All bodies of a run, side by side, so that one instruction moves several of them.
//!
//! Bodies stand eight to a block, each quantity of the eight in a row. Free flight is the same function for one body
//! and for a block ([`RigidBody::fly`]); it has no branches, so the compiler turns its eight repetitions into vector
//! instructions, of the width that the processor has. Every operation in it is one that IEEE 754 rounds exactly, and
//! none are fused, so the bits do not depend on the width.

use fearless_simd::{Level, dispatch};
use glam::{DQuat, DVec3};

use super::{Air, RigidBody};
use crate::loading::Resistance;

/// Bodies in a block.
pub const LANES: usize = 8;

/// One quantity of the bodies in a block.
type Row = [f64; LANES];

/// All bodies of a run.
#[derive(Debug, Clone)]
pub struct Bodies {
    blocks: Vec<Block>,
    count: usize,
}

/// Eight bodies side by side; see [`RigidBody`] for what the quantities are.
#[derive(Debug, Clone)]
#[repr(align(64))]
pub struct Block {
    position: [Row; 3],
    world_from_principal: [Row; 4],
    velocity: [Row; 3],
    angular_momentum: [Row; 3],
    inverse_moments: [Row; 3],
    drag: [Row; 3],
    lift: Row,
    reach: Row,
    inverse_mass: Row,
    /// Whether any of them has lift.
    lifts: bool,
}

impl Bodies {
    /// Puts bodies side by side.
    pub fn new(bodies: &[RigidBody]) -> Self {
        let blocks = bodies
            .chunks(LANES)
            .map(|chunk| {
                // Lanes without a body repeat the first one, so that they cost no care.
                let filled = std::array::from_fn(|lane| *chunk.get(lane).unwrap_or(&chunk[0]));
                Block::new(&filled)
            })
            .collect();
        Self { blocks, count: bodies.len() }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// One body.
    pub fn get(&self, index: usize) -> RigidBody {
        self.blocks[index / LANES].get(index % LANES)
    }

    /// Sets where a body is and how it moves.
    pub fn set(&mut self, index: usize, body: &RigidBody) {
        self.blocks[index / LANES].set(index % LANES, body);
    }

    /// The bodies by blocks; the last one may have lanes without a body.
    pub fn blocks_mut(&mut self) -> &mut [Block] {
        &mut self.blocks
    }
}

impl Block {
    fn new(bodies: &[RigidBody; LANES]) -> Self {
        let row = |value: &dyn Fn(&RigidBody) -> f64| std::array::from_fn(|lane| value(&bodies[lane]));
        let rows = |value: &dyn Fn(&RigidBody) -> DVec3| std::array::from_fn(|i| row(&|b| value(b)[i]));
        let lift = row(&|b| b.resistance.lift);
        Self {
            position: rows(&|b| b.position),
            world_from_principal: std::array::from_fn(|i| row(&|b| b.world_from_principal.to_array()[i])),
            velocity: rows(&|b| b.velocity),
            angular_momentum: rows(&|b| b.angular_momentum),
            inverse_moments: rows(&|b| b.inverse_moments),
            drag: rows(&|b| b.resistance.drag),
            lift,
            reach: row(&|b| b.reach),
            inverse_mass: row(&|b| b.inverse_mass),
            lifts: lift.iter().any(|&l| l > 0.0),
        }
    }

    /// The body in a lane.
    #[inline(always)]
    pub fn get(&self, lane: usize) -> RigidBody {
        let at = |rows: &[Row; 3]| DVec3::new(rows[0][lane], rows[1][lane], rows[2][lane]);
        let [x, y, z, w] = &self.world_from_principal;
        RigidBody {
            position: at(&self.position),
            world_from_principal: DQuat::from_xyzw(x[lane], y[lane], z[lane], w[lane]),
            velocity: at(&self.velocity),
            angular_momentum: at(&self.angular_momentum),
            inverse_mass: self.inverse_mass[lane],
            inverse_moments: at(&self.inverse_moments),
            resistance: Resistance { drag: at(&self.drag), lift: self.lift[lane] },
            reach: self.reach[lane],
        }
    }

    /// Sets where the body in a lane is and how it moves.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, body: &RigidBody) {
        for i in 0..3 {
            self.position[i][lane] = body.position[i];
            self.velocity[i][lane] = body.velocity[i];
            self.angular_momentum[i][lane] = body.angular_momentum[i];
        }
        for (row, value) in self.world_from_principal.iter_mut().zip(body.world_from_principal.to_array()) {
            row[lane] = value;
        }
    }

    /// A free step of those bodies that are `flying`; see [`RigidBody::fly`]. `level` says which instructions the
    /// processor has; the result does not depend on it.
    pub fn fly(&mut self, level: Level, flying: [bool; LANES], air: Air, dt: f64) {
        dispatch!(level, _ => if self.lifts {
            self.glide::<true>(flying, air, dt);
        } else {
            self.glide::<false>(flying, air, dt);
        });
    }

    #[inline(always)]
    fn glide<const LIFT: bool>(&mut self, flying: [bool; LANES], air: Air, dt: f64) {
        for (lane, flies) in flying.into_iter().enumerate() {
            let before = self.get(lane);
            let mut body = before;
            body.glide::<LIFT>(air, dt);
            self.set(lane, if flies { &body } else { &before });
        }
    }

    /// The height that no point of a body in the block lies below [m].
    pub fn lowest(&self) -> f64 {
        (0..LANES).map(|lane| self.position[1][lane] - self.reach[lane]).fold(f64::INFINITY, f64::min)
    }
}
