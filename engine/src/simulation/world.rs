//! One step of one body: waiting, held, standing, sliding, in flight.

use fearless_simd::Level;
use glam::DVec3;

use super::life::{Concern, Held, Life, Phase};
use crate::dynamics::ground::{CALM_TIME, Ground};
use crate::dynamics::standing::Outcome;
use crate::dynamics::{Air, Carry, GRAVITY, RigidBody, Winds};

/// What all bodies share during a step.
pub(super) struct World {
    pub ground: Option<Ground>,
    /// Art direction: multiplies the turning that a piece takes along from its pane.
    pub rotation: f64,
    pub air: Air,
    /// Instructions the processor has.
    pub level: Level,
}

impl World {
    /// One step of one body; what flies has already flown. Returns what of it concerns others.
    pub fn step(
        &self,
        body: &mut RigidBody,
        phase: &mut Phase,
        life: &mut Life,
        carry: &Carry,
        t0: f64,
        t1: f64,
    ) -> Concern {
        let concern = match phase {
            Phase::Flying => return self.land(body, life, t1 - t0),
            Phase::Free => self.fly_loaded(body, life, t0, t1),
            Phase::Held => self.hold(body, life, t0, t1),
            Phase::Standing | Phase::Sliding => self.stand(body, phase, life, carry, t0, t1),
            Phase::Anchored => {
                if life.queue.acts(t0, t1) {
                    self.load(body, life, t0, t1, false);
                    body.velocity = DVec3::ZERO;
                    body.angular_momentum = DVec3::ZERO;
                }
                Concern::Nothing
            }
        };
        self.launch(body, phase, life, t1);
        concern
    }

    /// Notes the speed with which a body's loads leave it.
    pub fn launch(&self, body: &RigidBody, phase: &mut Phase, life: &mut Life, t1: f64) {
        if !life.launched && life.queue.end <= t1 {
            life.launched = true;
            life.facts.launch_speed = life.facts.launch_speed.max(body.velocity.length());
        }
        if *phase == Phase::Free && life.launched {
            *phase = Phase::Flying;
        }
    }

    /// Puts panel loads and wind on a body's velocity and angular momentum.
    pub fn load(&self, body: &mut RigidBody, life: &mut Life, t0: f64, t1: f64, free: bool) {
        let (mut impulse, mut angular) = life.queue.take(t0, t1, free);
        if let Some(sheet) = life.sheet.filter(|_| free && impulse != DVec3::ZERO) {
            (impulse, angular) = sheet.turn(body, impulse, angular, t1 - t0);
        }
        body.push(impulse, angular);
        let winds = Winds { winds: &life.queue.winds, air: self.air };
        life.facts.impulse += body.world_from_principal * impulse + body.blow(winds, t0, t1);
    }

    /// A step of a piece that is held, to its end or until it is free and on from there.
    fn hold(&self, body: &mut RigidBody, life: &mut Life, t0: f64, t1: f64) -> Concern {
        let Held { hold, rest, until } = &**life.held.as_ref().expect("it is held");
        let until = *until;
        let end = until.clamp(t0, t1);
        let (impulse, _) = life.queue.take(t0, end, false);
        let received = body.world_from_principal * impulse;
        life.facts.impulse += received;
        life.facts.held_back += received;
        hold.place(body, rest, end);
        if until > t1 {
            return Concern::Nothing;
        }
        body.angular_momentum *= self.rotation;
        life.facts.held_back -= body.velocity / body.inverse_mass;
        life.facts.free_time = until;
        life.held = None;
        if end < t1 {
            self.fly_loaded(body, life, end, t1);
        }
        life.change = Some(Phase::Free);
        Concern::Settles
    }

    fn stand(
        &self,
        body: &mut RigidBody,
        phase: &mut Phase,
        life: &mut Life,
        carry: &Carry,
        t0: f64,
        t1: f64,
    ) -> Concern {
        let before = body.velocity;
        self.load(body, life, t0, t1, false);
        let (outcome, rubbed) = life.place.resist(body, before, carry, t1 - t0);
        life.rubbed = rubbed;
        match outcome {
            Outcome::Holds => {
                if *phase == Phase::Sliding {
                    *phase = Phase::Standing;
                    life.facts.rest_time = t1;
                }
                if rubbed == DVec3::ZERO { Concern::Nothing } else { Concern::Slides }
            }
            Outcome::Slides => {
                *phase = Phase::Sliding;
                life.facts.rest_time = f64::NAN;
                Concern::Slides
            }
            Outcome::Leaves => {
                life.change = Some(Phase::Free);
                Concern::Settles
            }
        }
    }

    pub fn fly_loaded(&self, body: &mut RigidBody, life: &mut Life, t0: f64, t1: f64) -> Concern {
        let dt = t1 - t0;
        let before = body.velocity;
        let half_fall = DVec3::new(0.0, -0.5 * GRAVITY * dt, 0.0);
        body.velocity += half_fall;
        self.load(body, life, t0, t1, true);
        body.velocity += half_fall;
        body.position += (before + body.velocity) * (0.5 * dt);
        body.turn(dt);
        self.land(body, life, dt)
    }

    /// Lets a body that has just moved meet the ground, and notices when it has come to rest.
    #[inline]
    pub fn land(&self, body: &mut RigidBody, life: &mut Life, dt: f64) -> Concern {
        let Some(ground) = self.ground.filter(|ground| ground.is_near(body.position.y - body.reach)) else {
            return Concern::Nothing;
        };
        let calm = ground.meet(body, &life.corners, life.ground_friction);
        life.calm = if calm { life.calm + dt } else { 0.0 };
        if life.calm < CALM_TIME {
            return Concern::Nothing;
        }
        life.change = Some(Phase::Standing);
        Concern::Settles
    }
}
