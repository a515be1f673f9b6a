//! Bodies that move each for itself, and meet the ground alone.
//!
//! What couples them, who stands on whom and the friction between them, is settled between steps, in a fixed order.

use glam::DVec3;
use rayon::prelude::*;

use super::life::{Concern, Life, Phase};
use super::motion::Motion;
use super::state::State;
use super::steps::Steps;
use super::world::World;
use crate::dynamics::ground::CALM_TIME;
use crate::dynamics::standing::Place;
use crate::dynamics::{Block, Carry, LANES};
use crate::error::Result;

/// Below this many bodies a step is not worth sharing among threads.
const WORTH_SHARING: usize = 2048;
/// Blocks of bodies a thread takes at once.
const CHUNK: usize = 32;

/// Each body for itself.
pub(super) struct FreeFlight {
    steps: Steps,
    /// Whether any body slid in the step before.
    slid: bool,
    /// Bodies that left their places in this step.
    left: Vec<usize>,
}

impl FreeFlight {
    pub fn new(steps: Steps) -> Self {
        Self { steps, slid: false, left: Vec::new() }
    }
}

impl Motion for FreeFlight {
    fn steps(&self, _: &State, t0: f64, t1: f64) -> usize {
        self.steps.between(t0, t1)
    }

    /// One step of every body, then what they change for each other.
    fn advance(&mut self, state: &mut State, t0: f64, t1: f64) -> Result<()> {
        let concern = step_all(state, t0, t1);
        if concern == Concern::Settles {
            settle(state, t1, &mut self.left);
        }
        let slides = concern >= Concern::Slides;
        if slides || self.slid {
            let (bodies, lives) = (&state.bodies, &state.lives);
            state.support.pass_on(|i| bodies.get(i).velocity, |i| lives[i].rubbed);
        }
        self.slid = slides;
        Ok(())
    }

    fn rests(&self, state: &State, now: f64) -> bool {
        state.rests(now, |index| state.phases[index] == Phase::Standing)
    }

    /// Bodies note it themselves when they come to rest.
    fn conclude(&self, _: &mut State, _: f64) -> Option<String> {
        None
    }
}

/// One step of every body by itself. Returns the gravest of what concerns others.
fn step_all(state: &mut State, t0: f64, t1: f64) -> Concern {
    let (world, support) = (&state.world, &state.support);
    let (blocks, shared) = (state.bodies.blocks_mut(), state.phases.len() >= WORTH_SHARING);
    let one = |(index, ((block, phases), lives))| {
        step_block(world, block, phases, lives, |lane| support.carry(index * LANES + lane), t0, t1)
    };
    if shared {
        blocks
            .par_iter_mut()
            .zip(state.phases.par_chunks_mut(LANES))
            .zip(state.lives.par_chunks_mut(LANES))
            .enumerate()
            .with_min_len(CHUNK)
            .map(one)
            .reduce(|| Concern::Nothing, Concern::max)
    } else {
        blocks
            .iter_mut()
            .zip(state.phases.chunks_mut(LANES))
            .zip(state.lives.chunks_mut(LANES))
            .enumerate()
            .map(one)
            .fold(Concern::Nothing, Concern::max)
    }
}

/// One step of the bodies in a block: those in flight together, the others one by one. Returns the gravest of
/// what concerns others.
fn step_block<'a>(
    world: &World,
    block: &mut Block,
    phases: &mut [Phase],
    lives: &mut [Life],
    carry: impl Fn(usize) -> &'a Carry,
    t0: f64,
    t1: f64,
) -> Concern {
    let flying = std::array::from_fn(|lane| phases.get(lane) == Some(&Phase::Flying));
    if flying.contains(&true) {
        block.fly(world.level, flying, world.air, t1 - t0);
    }
    if !flying.contains(&false) && world.ground.is_none_or(|ground| !ground.is_near(block.lowest())) {
        return Concern::Nothing;
    }
    let mut gravest = Concern::Nothing;
    for (lane, (phase, life)) in phases.iter_mut().zip(lives).enumerate() {
        let carry = carry(lane);
        if *phase == Phase::Standing && !life.queue.acts(t0, t1) && !carry.is_moved() {
            life.rubbed = DVec3::ZERO;
            continue;
        }
        if *phase == Phase::Held && !life.is_stirred(t0, t1) {
            continue;
        }
        let mut body = block.get(lane);
        gravest = gravest.max(world.step(&mut body, phase, life, carry, t0, t1));
        block.set(lane, &body);
    }
    gravest
}

/// Bodies that left let down what they carried; bodies that came to rest carry themselves again.
fn settle(state: &mut State, now: f64, left: &mut Vec<usize>) {
    left.clear();
    for (index, life) in state.lives.iter_mut().enumerate() {
        match life.change.take() {
            Some(Phase::Free) => left.push(index),
            Some(Phase::Standing) => {
                let mut body = state.bodies.get(index);
                body.velocity = DVec3::ZERO;
                body.angular_momentum = DVec3::ZERO;
                state.bodies.set(index, &body);
                life.place = Place::new(&body, life.extent, life.ground_friction);
                life.facts.rest_time = now - CALM_TIME;
                state.support.stand_up(index);
                state.phases[index] = Phase::Standing;
            }
            _ => {}
        }
    }
    if left.is_empty() {
        return;
    }
    state.support.leave(left);
    for &index in left.iter() {
        state.phases[index] = Phase::Free;
        let life = &mut state.lives[index];
        life.facts.rest_time = f64::NAN;
        life.calm = 0.0;
        state.part(index, now);
    }
}
