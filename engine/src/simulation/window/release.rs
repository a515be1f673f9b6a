//! When the pieces of a failed pane come free, and how they move before.
//!
//! - From the moment it fails a pane has no stiffness left: its parts go on as they were bent, pushed by what pushes
//!   them. A piece goes with it until its outline has closed, and takes along the speed and the turn of its place.
//! - A piece that reaches into the rebate of a frame then turns about the edge of the rebate like a door, pushed by the
//!   mean load on the pane. Once its centre has come out by as much as the rebate holds, or it has turned by a radian, it
//!   is free. One that the load leaves turning more slowly than [`SLOWEST`] stays, and so does one whose centre lies in
//!   the rebate: a splinter in the frame.
//! - On an interlayer nothing comes free. The pane hangs on in the interlayer as in a membrane that yields
//!   ([`INTERLAYER`]), until it has stopped, and stays as far out as that. That is a look, not a model of the interlayer.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::response::{Load, Response, swing};
use crate::dynamics::{Bowing, Hold, Swing, Until};
use crate::fracture::{CrackClock, Pattern, Pieces};
use crate::geometry::PlaneMoments;
use crate::structure::Plate;
use crate::window::Window;

/// A piece in the rebate is free once it has turned so far [rad].
const OPEN: f64 = 1.0;
/// A centre that comes out of the rebate more slowly than this once the load is over stays there [m/s].
const SLOWEST: f64 = 0.1;
/// Tension of an interlayer that yields [N/m]: 1.5 mm of polyvinyl butyral at some 15 MPa.
const INTERLAYER: f64 = 23e3;
/// Steps in which a pane goes on while a piece of crack closes, or an interlayer stretches.
const STEPS_ON: f64 = 100.0;
/// Times at which the load on pieces in the rebate is looked at.
const LOOKS: usize = 400;

/// The cracks of a failed pane and what they leave.
pub(super) struct Cracks<'a> {
    pub clock: CrackClock,
    pub pattern: &'a Pattern,
    pub pieces: &'a Pieces,
}

/// How a failed pane goes on, and how each of its pieces is held.
pub(super) fn holds(
    window: &Window,
    plate: &Plate,
    load: &Load,
    response: Response,
    cracks: &Cracks,
) -> (Arc<Bowing>, Vec<Hold>) {
    let failure = response.failure.expect("the pane has failed");
    let outward = response.record.last().map_or(1.0, |(_, now)| now[0].signum());
    let glued = window.recipe.glass.holds();
    let closed: Vec<f64> =
        cracks.pattern.fragments().map(|f| failure + cracks.clock.time(f.closed_at())).collect();
    let last = if glued { f64::INFINITY } else { closed.iter().copied().fold(failure, f64::max) };
    let bowing = Arc::new(if glued {
        stretch(plate, load, response.record, failure)
    } else {
        go_on(plate, load, response.record, last)
    });
    let rebate = window.bite.filter(|&bite| bite > 0.0 && !glued).map(|bite| Rebate {
        window,
        bite,
        outward,
        pushes: Pushes::new(load, failure, plate.mass_per_area(), outward),
    });
    let holds = closed
        .iter()
        .zip(&cracks.pieces.moments)
        .enumerate()
        .map(|(index, (&closed, moments))| {
            let deflection = plate.deflection(moments.centroid);
            let mut hold = Hold {
                bowing: Arc::clone(&bowing),
                deflection,
                tilt: Hold::tilt_of(plate.slope(moments.centroid), window.orientation),
                normal: window.orientation * DVec3::Z,
                closed: if glued { f64::INFINITY } else { closed },
                swing: None,
                until: if glued { Until::Forever } else { Until::at(closed) },
            };
            if let Some(rebate) = &rebate
                && rebate.reaches(cracks, index)
            {
                let speed = outward * deflection * bowing.at(closed)[1];
                rebate.keep(&mut hold, moments, speed.max(0.0));
            }
            hold
        })
        .collect();
    (bowing, holds)
}

/// The bowing of a pane from its failure on, without stiffness, until `last` [s].
fn go_on(plate: &Plate, load: &Load, mut record: Vec<(f64, [f64; 2])>, last: f64) -> Bowing {
    let softness = plate.frequency() * plate.frequency();
    let Some(&(failure, mut now)) = record.last() else { return Bowing::default() };
    let interval = (last - failure) / STEPS_ON;
    if interval > 0.0 {
        for step in 0..STEPS_ON as usize {
            let from = failure + interval * step as f64;
            let gain = softness * load.bending(from, from + interval) * interval;
            now = [now[0] + (now[1] + 0.5 * gain) * interval, now[1] + gain];
            record.push((from + interval, now));
        }
    }
    Bowing::new(record)
}

/// The bowing of a pane on an interlayer from its failure on: held as by a membrane, until it has stopped.
fn stretch(plate: &Plate, load: &Load, mut record: Vec<(f64, [f64; 2])>, failure: f64) -> Bowing {
    // Of a rectangle's first mode, the stiffness of a membrane over that of the plate: N / (√(D ρh) ω).
    let share = INTERLAYER / (libm::sqrt(plate.stiffness() * plate.mass_per_area()) * plate.frequency());
    let frequency = plate.frequency() * libm::sqrt(share);
    let step = core::f64::consts::PI / frequency / STEPS_ON;
    let Some(&(_, mut now)) = record.last() else { return Bowing::default() };
    let outward = now[0].signum();
    let mut from = failure;
    loop {
        let pressure = load.bending(from, from + step) / share;
        let next = swing(frequency, step, now, pressure);
        from += step;
        if next[1] * outward <= 0.0 {
            record.push((from, [next[0], 0.0]));
            return Bowing::new(record);
        }
        record.push((from, next));
        now = next;
    }
}

/// What the mean load does to a free square metre of pane from its failure on: velocity [m/s] and way [m] at even
/// steps.
struct Pushes {
    start: f64,
    step: f64,
    velocity: Vec<f64>,
    way: Vec<f64>,
}

impl Pushes {
    fn new(load: &Load, failure: f64, mass_per_area: f64, outward: f64) -> Self {
        let end = load.end_of(failure);
        let step = (end - failure) / LOOKS as f64;
        let (mut velocity, mut way) = (vec![0.0], vec![0.0]);
        for look in 0..LOOKS {
            let from = failure + step * look as f64;
            let before = velocity[look];
            let after = before + outward * load.impulse(from, from + step) / mass_per_area;
            velocity.push(after);
            way.push(way[look] + 0.5 * (before + after) * step);
        }
        Self { start: failure, step, velocity, way }
    }

    /// Velocity [m/s] and way [m] at a time [s].
    fn at(&self, t: f64) -> [f64; 2] {
        let along = ((t - self.start) / self.step).clamp(0.0, LOOKS as f64);
        let index = (along as usize).min(LOOKS - 1);
        let part = along - index as f64;
        let between = |values: &[f64]| values[index] + (values[index + 1] - values[index]) * part;
        if self.step > 0.0 { [between(&self.velocity), between(&self.way)] } else { [0.0; 2] }
    }
}

/// The rebate of a frame.
struct Rebate<'a> {
    window: &'a Window,
    bite: f64,
    outward: f64,
    pushes: Pushes,
}

impl Rebate<'_> {
    /// Whether a piece reaches into the rebate.
    fn reaches(&self, cracks: &Cracks, index: usize) -> bool {
        let vertices = cracks.pattern.vertices();
        let mut corners = cracks.pattern.fragment(index).rings().flatten();
        corners.any(|&corner| self.foot(vertices[corner as usize]).1 < self.bite)
    }

    /// The nearest point of the border and how far it is [m].
    fn foot(&self, place: DVec2) -> (DVec2, f64) {
        let on_side = |(a, b): (DVec2, DVec2)| {
            let along = ((place - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
            let foot = a + (b - a) * along;
            (foot, foot.distance(place))
        };
        // A hole has no frame.
        let count = self.window.outline.rings().next().map_or(0, <[DVec2]>::len);
        let nearest = self.window.outline.sides().take(count).map(on_side).min_by(|a, b| a.1.total_cmp(&b.1));
        nearest.expect("an outline has sides")
    }

    /// Lets a piece turn about the edge of the rebate from when its outline has closed, its centre having moved at `speed`
    /// [m/s] until then. The edge takes what of that does not turn the piece about it.
    fn keep(&self, hold: &mut Hold, moments: &PlaneMoments, speed: f64) {
        hold.until = Until::Forever;
        let (foot, depth) = self.foot(moments.centroid);
        let arm = depth - self.bite;
        if arm <= 0.0 {
            return;
        }
        let inward = (moments.centroid - foot) / depth;
        // Second moment about the line through the centroid along the edge, over the area: of a rod, a third of half its
        // length squared.
        let spread = (moments.xx * inward.x * inward.x
            + 2.0 * moments.xy * inward.x * inward.y
            + moments.yy * inward.y * inward.y)
            / moments.area;
        let share = arm * arm / (arm * arm + spread);
        let speed = share * speed;
        let far_enough = self.bite.min(OPEN * arm);
        let (mut end, mut way, mut rate) = (hold.closed, 0.0, speed);
        let [velocity, start_way] = self.pushes.at(hold.closed);
        let last = self.pushes.start + self.pushes.step * LOOKS as f64;
        while way < far_enough && end < last {
            let next = (end + self.pushes.step).min(last);
            let since = next - hold.closed;
            let [v, w] = self.pushes.at(next);
            let further = speed * since + share * (w - start_way - velocity * since);
            let faster = speed + share * (v - velocity);
            if further >= far_enough {
                let part = (far_enough - way) / (further - way);
                (end, rate) = (end + (next - end) * part, rate + (faster - rate) * part);
                way = far_enough;
            } else {
                (end, way, rate) = (next, further.max(0.0), faster);
            }
        }
        if way < far_enough && rate > SLOWEST {
            (end, way) = (end + (far_enough - way) / rate, far_enough);
        }
        let free = way >= far_enough;
        let world = |v: DVec2| self.window.orientation * v.extend(0.0);
        let direction = hold.normal * self.outward;
        hold.swing = Some(Swing {
            axis: world(inward).cross(direction).normalize(),
            arm: world(inward) * arm,
            speed,
            end: (end, way, if free { rate } else { 0.0 }),
        });
        if free {
            hold.until = Until::at(end);
        }
    }
}
