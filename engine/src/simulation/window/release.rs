//! When the pieces of a failed pane come free, and how they move before.
//!
//! - From the moment it fails a pane has no stiffness left: its parts go on as they were bent, pushed by what pushes
//!   them. A piece goes with it until its outline has closed, and takes along the speed and the turn of its place.
//! - A piece that reaches into the rebate of a frame then turns about the edge of the rebate like a door, pushed by the
//!   mean load on the pane. Once its centre has come out by as much as the rebate holds, or it has turned by a radian, it
//!   is free; where the load is over before, or where its centre lies in the rebate, it stays: a splinter in the frame.
//! - On an interlayer nothing comes free. The pane goes on until it has stopped, and stays as far out as that: the
//!   interlayer stretches, it does not spring back. That is a look, not a model of the interlayer.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::response::{Load, Record, Response};
use crate::dynamics::{Bowing, Hold, Swing};
use crate::fracture::{CrackClock, Pattern, Pieces};
use crate::geometry::PlaneMoments;
use crate::structure::Plate;
use crate::window::Window;

/// A piece in the rebate is free once it has turned so far [rad].
const OPEN: f64 = 1.0;
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
    let outward = response.record.now[0].signum();
    let glued = window.recipe.glass.holds();
    let closed: Vec<f64> =
        cracks.pattern.fragments().map(|f| failure + cracks.clock.time(f.closed_at())).collect();
    let last = if glued { f64::INFINITY } else { closed.iter().copied().fold(failure, f64::max) };
    let bowing = Arc::new(go_on(plate, load, response.record, failure, last));
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
                until: if glued { f64::INFINITY } else { closed },
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

/// The bowing of a pane from its failure on, without stiffness, until `last` [s], or until it has stopped.
fn go_on(plate: &Plate, load: &Load, mut record: Record, failure: f64, last: f64) -> Bowing {
    let Record { start, step, .. } = record;
    let softness = plate.frequency() * plate.frequency();
    let end = load.span().map_or(failure, |(_, end)| end);
    let mut from = failure;
    loop {
        let to = start + step * record.samples.len() as f64;
        let [amplitude, rate] = record.now;
        let interval = to - from;
        let gain = softness * load.bending(from, to) * interval;
        let next = [amplitude + (rate + 0.5 * gain) * interval, rate + gain];
        // What an interlayer holds stops where it would turn back, or where nothing pushes it any more.
        let stops = last.is_infinite() && (next[1] * next[0] <= 0.0 || to > end);
        record.now = if stops { [next[0], 0.0] } else { next };
        record.samples.push(record.now);
        from = to;
        if stops || to >= last {
            return Bowing::new(start, step, record.samples);
        }
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
        let end = load.span().map_or(failure, |(_, end)| end).max(failure);
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
        let nearest = self.window.outline.sides().map(on_side).min_by(|a, b| a.1.total_cmp(&b.1));
        nearest.expect("an outline has sides")
    }

    /// Lets a piece turn about the edge of the rebate from when its outline has closed, its centre having moved at `speed`
    /// [m/s] until then. The edge takes what of that does not turn the piece about it.
    fn keep(&self, hold: &mut Hold, moments: &PlaneMoments, speed: f64) {
        hold.until = f64::INFINITY;
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
            hold.until = end;
        }
    }
}
