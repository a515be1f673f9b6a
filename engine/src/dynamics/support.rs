//! What stands on what, and with which weight.

use glam::DVec3;

use super::GRAVITY;
use crate::geometry::Silhouette;

/// Two faces closer than this stand on each other [m]: a bed of mortar, or the sloppiness of a hand-made scene.
const JOINT: f64 = 0.02;

/// A body that another one carries is on the ground as well only when it is this near [m]; and so far may its centre
/// of mass lie beyond the edge of what carries it.
const CONTACT: f64 = 1e-3;

/// Where a body stands at the start of a run.
#[derive(Debug, Clone, Copy)]
pub struct Footing {
    /// Lower corner of the body's bounding box in the world [m].
    pub low: DVec3,
    /// Upper corner of the body's bounding box in the world [m].
    pub high: DVec3,
    /// Centre of mass in the world [m].
    pub centre: DVec3,
    /// Mass [kg].
    pub mass: f64,
    /// Whether the body never moves.
    pub anchored: bool,
    /// Whether something else holds it, so that it neither stands on anything nor carries anything.
    pub held: bool,
}

/// How a standing body is carried during a step.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Carry {
    /// Force with which it presses on what carries it: its own weight and all that stands on it [N].
    pub normal_force: f64,
    /// Velocity of what carries it [m/s].
    pub velocity: DVec3,
    /// What the friction of bodies that stand on it gave it in the step before [N s].
    pub reaction: DVec3,
}

impl Carry {
    /// Whether what is above or below the body moves it.
    pub fn is_moved(&self) -> bool {
        self.velocity != DVec3::ZERO || self.reaction != DVec3::ZERO
    }
}

/// The stack: who carries whom. A body that stands on nothing is held where it is until a blast frees it.
#[derive(Debug, Clone)]
pub struct Support {
    footings: Vec<Footing>,
    standing: Vec<bool>,
    grounded: Vec<bool>,
    /// Bodies that carry this one, with the share of its weight that each takes.
    carriers: Vec<Vec<(usize, f64)>>,
    weight: Vec<f64>,
    carry: Vec<Carry>,
    /// Bodies from the highest to the lowest.
    downward: Vec<usize>,
}

impl Support {
    /// Finds who carries whom: tops within 20 mm of a bottom, where the two overlap seen from above; the weight
    /// is shared in proportion to the overlap.
    pub fn new(footings: &[Footing], ground: Option<f64>) -> Self {
        let count = footings.len();
        let mut by_top: Vec<usize> = (0..count).filter(|&body| !footings[body].held).collect();
        by_top.sort_by(|&a, &b| footings[a].high.y.total_cmp(&footings[b].high.y).then(a.cmp(&b)));
        let carriers: Vec<Vec<(usize, f64)>> =
            (0..count).map(|body| carriers_of(body, footings, &by_top)).collect();
        let grounded = footings
            .iter()
            .zip(&carriers)
            .map(|(foot, carriers)| {
                let joint = if carriers.is_empty() { JOINT } else { CONTACT };
                ground.is_some_and(|height| foot.low.y <= height + joint)
            })
            .collect();
        let mut downward: Vec<usize> = (0..count).collect();
        downward.sort_by(|&a, &b| footings[b].low.y.total_cmp(&footings[a].low.y).then(a.cmp(&b)));
        let mut support = Self {
            footings: footings.to_vec(),
            standing: vec![true; count],
            grounded,
            carriers,
            weight: footings.iter().map(|f| f.mass * GRAVITY).collect(),
            carry: vec![Carry::default(); count],
            downward,
        };
        support.settle_weights();
        support
    }

    /// How a body is carried.
    pub fn carry(&self, body: usize) -> &Carry {
        &self.carry[body]
    }

    /// Tells every standing body how what carries it now moves, and what friction above it did to it.
    ///
    /// `velocity` and `rubbed` give a body's velocity [m/s] and the impulse of friction on its foot [N s].
    pub fn pass_on(&mut self, velocity: impl Fn(usize) -> DVec3, rubbed: impl Fn(usize) -> DVec3) {
        for carry in &mut self.carry {
            carry.reaction = DVec3::ZERO;
        }
        for body in 0..self.carry.len() {
            if !self.standing[body] {
                continue;
            }
            let friction = rubbed(body);
            let mut carried = DVec3::ZERO;
            // A body with a foot on the ground is not carried along by what else stands under it.
            if !self.grounded[body] {
                for &(carrier, share) in &self.carriers[body] {
                    if self.standing[carrier] && !self.footings[carrier].anchored {
                        carried += velocity(carrier) * share;
                        self.carry[carrier].reaction -= friction * share;
                    }
                }
            }
            self.carry[body].velocity = carried.with_y(0.0);
        }
    }

    /// Bodies that carry this one, with their shares of its weight.
    pub fn carriers(&self, body: usize) -> &[(usize, f64)] {
        &self.carriers[body]
    }

    /// Whether the body stands on the ground.
    pub fn is_grounded(&self, body: usize) -> bool {
        self.grounded[body]
    }

    /// Whether nothing is below the body, neither another body nor the ground, so that it is held in the air.
    pub fn hangs(&self, body: usize) -> bool {
        self.carriers[body].is_empty() && !self.grounded[body]
    }

    /// Takes out bodies that have left their place. Those that lose their last carrier, or the one that was under
    /// their centre of mass, leave with them and are appended to `left`; weights are settled anew.
    pub fn leave(&mut self, left: &mut Vec<usize>) {
        for &body in left.iter() {
            self.standing[body] = false;
        }
        for i in (0..self.downward.len()).rev() {
            let body = self.downward[i];
            if self.standing[body] && !self.is_carried(body) {
                self.standing[body] = false;
                left.push(body);
            }
        }
        for body in 0..self.carriers.len() {
            let mut carriers = std::mem::take(&mut self.carriers[body]);
            if carriers.len() > 1 && !carriers.iter().all(|&(c, _)| self.carries(c)) {
                carriers.retain(|&(c, _)| self.carries(c));
                share_out(&mut carriers);
            }
            self.carriers[body] = carriers;
        }
        self.settle_weights();
    }

    /// Whether a body still carries what stands on it.
    fn carries(&self, body: usize) -> bool {
        self.standing[body] || self.footings[body].anchored
    }

    /// Whether a standing body is still carried: by all that carried it, or by some of it under its centre of mass.
    fn is_carried(&self, body: usize) -> bool {
        if self.grounded[body] || self.hangs(body) || self.footings[body].anchored {
            return true;
        }
        let foot = &self.footings[body];
        let carriers = || self.carriers[body].iter().filter(|&&(c, _)| self.carries(c));
        if carriers().count() == self.carriers[body].len() {
            return true;
        }
        let corners: Vec<DVec3> = carriers().flat_map(|&(c, _)| patch(&self.footings[c], foot)).collect();
        !corners.is_empty() && Silhouette::new(&corners, DVec3::Y, |_| false).holds(foot.centre, DVec3::Y)
    }

    /// A body has come to rest on the ground again.
    pub fn stand_up(&mut self, body: usize) {
        self.standing[body] = true;
        self.grounded[body] = true;
        self.carriers[body].clear();
        for carriers in &mut self.carriers {
            carriers.retain(|&(carrier, _)| carrier != body);
        }
        self.carry[body] = Carry { normal_force: self.weight[body], ..Carry::default() };
    }

    fn settle_weights(&mut self) {
        for (carry, weight) in self.carry.iter_mut().zip(&self.weight) {
            carry.normal_force = *weight;
        }
        for &body in &self.downward {
            if !self.standing[body] {
                continue;
            }
            let force = self.carry[body].normal_force;
            for &(carrier, share) in &self.carriers[body] {
                self.carry[carrier].normal_force += force * share;
            }
        }
    }
}

/// Bodies whose top is at the bottom of `body` and below it, with their shares of its weight.
fn carriers_of(body: usize, footings: &[Footing], by_top: &[usize]) -> Vec<(usize, f64)> {
    let foot = footings[body];
    if foot.held {
        return Vec::new();
    }
    let first = by_top.partition_point(|&i| footings[i].high.y < foot.low.y - JOINT);
    let mut carriers: Vec<(usize, f64)> = by_top[first..]
        .iter()
        .take_while(|&&i| footings[i].high.y <= foot.low.y + JOINT)
        .filter(|&&i| i != body && footings[i].low.y < foot.low.y)
        .map(|&i| (i, overlap_from_above(&footings[i], &foot)))
        .filter(|&(_, area)| area > 0.0)
        .collect();
    carriers.sort_by_key(|&(i, _)| i);
    share_out(&mut carriers);
    carriers
}

/// Makes shares add up to 1.
fn share_out(carriers: &mut [(usize, f64)]) {
    let total: f64 = carriers.iter().map(|&(_, share)| share).sum();
    for (_, share) in carriers {
        *share /= total;
    }
}

/// Corners of where two bodies overlap seen from above, a little wider than it is [m].
fn patch(a: &Footing, b: &Footing) -> [DVec3; 4] {
    let low = a.low.max(b.low) - CONTACT;
    let high = a.high.min(b.high) + CONTACT;
    [(low.x, low.z), (high.x, low.z), (high.x, high.z), (low.x, high.z)].map(|(x, z)| DVec3::new(x, 0.0, z))
}

fn overlap_from_above(a: &Footing, b: &Footing) -> f64 {
    let width = a.high.x.min(b.high.x) - a.low.x.max(b.low.x);
    let depth = a.high.z.min(b.high.z) - a.low.z.max(b.low.z);
    // A shared edge overlaps by rounding only: it carries nothing.
    if width > 1e-9 && depth > 1e-9 { width * depth } else { 0.0 }
}
