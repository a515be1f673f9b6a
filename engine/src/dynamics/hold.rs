//! A piece that is held before it flies: by the pane it is part of, then perhaps by the frame.

use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};

use super::RigidBody;

/// How far a pane bends over time, in units of the deflection that even pressure of 1 Pa gives it [Pa].
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Bowing {
    /// Times [s], rising, with amplitude [Pa] and its rate [Pa/s] at each.
    samples: Vec<(f64, [f64; 2])>,
}

/// How a held piece moves until it is free.
#[derive(Debug, Clone)]
pub struct Hold {
    /// How its pane bends.
    pub bowing: Arc<Bowing>,
    /// Deflection of the pane at the piece's centre [m/Pa] along [`normal`](Self::normal).
    pub deflection: f64,
    /// Slope of the pane there, along the axis in the world about which it turns a piece [1/Pa].
    pub tilt: DVec3,
    /// The pane's own +z in the world.
    pub normal: DVec3,
    /// When its outline has closed [s]: until then it moves with the pane. Infinite where it never closes.
    pub closed: f64,
    /// How it turns in the rebate of the frame from then on, where it lies in one.
    pub swing: Option<Swing>,
    /// When it is free.
    pub until: Until,
}

/// When a held piece is free.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Until {
    /// When the first front comes to it.
    TheFront,
    /// At a time [s].
    Time(f64),
    /// It stays.
    Forever,
}

/// A piece that turns about the edge of its rebate, like a door.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Swing {
    /// Axis in the world; a turn about it moves the centre outward.
    pub axis: DVec3,
    /// From the axis to the centre in the world [m].
    pub arm: DVec3,
    /// Speed of the centre along its arc [m/s] when the outline closes.
    pub speed: f64,
    /// When the swing ends [s], and how far the centre has then come along its arc [m], and how fast it is [m/s].
    pub end: (f64, f64, f64),
}

/// Place, rotation and motion of a held piece beside those that it has at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Displacement {
    /// Shift of the centre of mass [m].
    pub shift: DVec3,
    /// Rotation from rest.
    pub turn: DQuat,
    /// Velocity of the centre of mass [m/s].
    pub velocity: DVec3,
    /// Angular velocity [rad/s].
    pub spin: DVec3,
}

impl Bowing {
    /// A bowing through samples at rising times [s] of amplitude [Pa] and rate [Pa/s]. Before them the pane is flat and
    /// still; after them it stays as the last one says, still.
    pub fn new(samples: Vec<(f64, [f64; 2])>) -> Self {
        Self { samples }
    }

    /// Amplitude [Pa] and rate [Pa/s] at a time [s]: the cubic through the samples and their rates.
    pub fn at(&self, t: f64) -> [f64; 2] {
        let after = self.samples.partition_point(|&(time, _)| time <= t);
        let Some(&(from, before)) = after.checked_sub(1).map(|i| &self.samples[i]) else { return [0.0; 2] };
        let Some(&(to, next)) = self.samples.get(after) else {
            return [before[0], if t == from { before[1] } else { 0.0 }];
        };
        hermite(before, next, (t - from) / (to - from), to - from)
    }

    /// When the pane begins to move [s], and when it last does.
    pub fn span(&self) -> (f64, f64) {
        let time = |sample: Option<&(f64, [f64; 2])>| sample.map_or(0.0, |s| s.0);
        (time(self.samples.first()), time(self.samples.last()))
    }
}

/// Value and slope of the cubic between two values with slopes, at the part `s` of an interval.
fn hermite([p, v]: [f64; 2], [q, w]: [f64; 2], s: f64, interval: f64) -> [f64; 2] {
    let (rise, v, w) = (q - p, v * interval, w * interval);
    let (square, cube) = (3.0 * rise - 2.0 * v - w, v + w - 2.0 * rise);
    let value = p + s * (v + s * (square + s * cube));
    [value, (v + s * (2.0 * square + s * 3.0 * cube)) / interval]
}

impl Hold {
    /// A hold of a piece that does not move until the front comes to it, and then is free.
    pub fn until_the_front() -> Self {
        Self::still(Until::TheFront)
    }

    /// A hold that only says when a piece is free: it does not move before.
    pub fn still(until: Until) -> Self {
        Self {
            bowing: Arc::default(),
            deflection: 0.0,
            tilt: DVec3::ZERO,
            normal: DVec3::Z,
            closed: f64::INFINITY,
            swing: None,
            until,
        }
    }

    /// The [`tilt`](Self::tilt) [1/Pa] of a pane's frame at a place where its deflection has this slope [1/Pa].
    pub fn tilt_of(slope: DVec2, world_from_pane: DQuat) -> DVec3 {
        world_from_pane * DVec3::new(slope.y, -slope.x, 0.0)
    }

    /// Whether it moves between two times.
    pub fn moves(&self, t0: f64, t1: f64) -> bool {
        let (start, mut end) = self.bowing.span();
        if let Some(swing) = self.swing {
            end = end.max(swing.end.0);
        }
        t1 > start && t0 <= end
    }

    /// Where it is and how it moves at a time [s] before it is free.
    pub fn at(&self, t: f64) -> Displacement {
        let [amplitude, mut rate] = self.bowing.at(t.min(self.closed));
        if t > self.closed {
            rate = 0.0;
        }
        // A slope turns by its arc tangent: a steep bulge never turns a piece past edge-on.
        let slope = self.tilt * amplitude;
        let steepness = slope.length();
        let angle = if steepness > 0.0 { libm::atan(steepness) / steepness } else { 1.0 };
        let bowed = Displacement {
            shift: self.normal * (self.deflection * amplitude),
            turn: DQuat::from_scaled_axis(slope * angle),
            velocity: self.normal * (self.deflection * rate),
            spin: self.tilt * (rate / (1.0 + steepness * steepness)),
        };
        self.swing.filter(|_| t > self.closed).map_or(bowed, |swing| swing.on_top(&bowed, self.closed, t))
    }

    /// Sets a body that rests at `rest` where it is at a time [s] before it is free.
    pub fn place(&self, body: &mut RigidBody, rest: &(DVec3, DQuat), t: f64) {
        let now = self.at(t);
        body.position = rest.0 + now.shift;
        body.velocity = now.velocity;
        if body.inverse_moments == DVec3::ZERO {
            // It may not rotate.
            return;
        }
        body.world_from_principal = (now.turn * rest.1).normalize();
        let spin = body.world_from_principal.conjugate() * now.spin;
        body.angular_momentum = spin / body.inverse_moments;
    }
}

impl Until {
    /// At a time [s]; never where that is infinite.
    pub fn at(time: f64) -> Self {
        if time == f64::INFINITY { Self::Forever } else { Self::Time(time) }
    }

    /// The time [s] for a piece that the first front reaches at `arrival` [s]; infinite for one that stays.
    pub fn time(self, arrival: f64) -> f64 {
        match self {
            Self::TheFront => arrival,
            Self::Time(time) => time,
            Self::Forever => f64::INFINITY,
        }
    }
}

impl Swing {
    fn on_top(&self, bowed: &Displacement, closed: f64, t: f64) -> Displacement {
        let (end, way, speed) = self.end;
        let reach = self.arm.length();
        let interval = end - closed;
        let [along, rate] = if t < end && interval > 0.0 {
            hermite([0.0, self.speed], [way, speed], (t - closed) / interval, interval)
        } else {
            [way, if t == end { speed } else { 0.0 }]
        };
        let turn = DQuat::from_axis_angle(self.axis, along / reach);
        let arm = turn * self.arm;
        let spin = self.axis * (rate / reach);
        Displacement {
            shift: bowed.shift + arm - self.arm,
            turn: turn * bowed.turn,
            velocity: spin.cross(arm),
            spin,
        }
    }
}
