//! When the front arrives: the thesis's predictor–corrector (§3.5.3) on `dR/dt = U(R)`.
//!
//! The march is done once, in scaled distance and time at sea level, where it depends on the curves alone;
//! Sachs scaling carries it to any charge and atmosphere exactly. Between the march's points a cubic with the
//! front's own slope `1/U` is read, forwards for arrival times and inverted for radii, so that the two agree.
//! Relative error of the arrival time at [`STEP`]: below 1e-4 (halving the step changes it by less).
//!
//! The march starts where [`Curves`] have their first own arrival time, else at the surface of a TNT sphere
//! that detonated from its centre; nearer in, the front comes at constant speed. Beyond the last point it
//! outruns sound by a share that falls as `1/R`: `1/U = 1/a0 − (1/a0 − 1/U_e) R_e/R`.

use crate::air::Air;
use crate::blast::curves::Curves;

/// Relative growth of the radius in one step of the march.
pub const STEP: f64 = 0.016;

/// The march ends at this multiple of the source's own reach.
const REACH: f64 = 4.0;

/// A front's path: radius against time, both scaled by W^⅓, at sea level.
#[derive(Debug, Clone)]
pub struct Front {
    nodes: Vec<Node>,
    sound_slowness: f64,
}

/// A point of the march.
#[derive(Debug, Clone, Copy)]
struct Node {
    radius: f64,
    time: f64,
    /// `1/U` [s/m].
    slowness: f64,
}

impl Front {
    /// Marches the front of `curves` out with steps of relative size `step` (above 0; [`STEP`] by default).
    pub fn new(curves: &Curves, step: f64) -> Front {
        let (mut radius, mut time) = curves.front_start();
        let end = REACH * curves.range().1;
        let mut velocity = curves.front_velocity(radius);
        let mut nodes = vec![Node { radius, time, slowness: 1.0 / velocity }];
        while radius < end {
            let interval = step * radius / velocity;
            let predicted = radius + velocity * interval;
            let corrected = radius + 0.5 * (velocity + curves.front_velocity(predicted)) * interval;
            (radius, time, velocity) = (corrected, time + interval, curves.front_velocity(corrected));
            nodes.push(Node { radius, time, slowness: 1.0 / velocity });
        }
        Front { nodes, sound_slowness: 1.0 / Air::SEA_LEVEL.sound_speed() }
    }

    /// Scaled time [s/kg^⅓] from detonation to the front's arrival at scaled distance `z` [m/kg^⅓], 0 or
    /// more.
    pub fn arrival_time(&self, z: f64) -> f64 {
        let (first, last) = self.ends();
        if z <= first.radius {
            return first.time * z / first.radius;
        }
        if z >= last.radius {
            return self.tail_time(z);
        }
        let upper = self.nodes.partition_point(|node| node.radius <= z).max(1);
        Segment::new(&self.nodes[upper - 1], &self.nodes[upper]).time(z).0
    }

    /// Scaled radius [m/kg^⅓] of the front at scaled `time` [s/kg^⅓] after detonation; 0 before it.
    pub fn radius(&self, time: f64) -> f64 {
        let (first, last) = self.ends();
        if time <= 0.0 {
            return 0.0;
        }
        if time <= first.time {
            return first.radius * time / first.time;
        }
        if time >= last.time {
            return self.tail_radius(time);
        }
        let upper = self.nodes.partition_point(|node| node.time <= time).max(1);
        let (start, end) = (&self.nodes[upper - 1], &self.nodes[upper]);
        let segment = Segment::new(start, end);
        let guess =
            start.radius + (end.radius - start.radius) * (time - start.time) / (end.time - start.time);
        invert(|z| segment.time(z), time, guess, (start.radius, end.radius))
    }

    /// Number of points of the march.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Never true: a march has a start.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    fn ends(&self) -> (&Node, &Node) {
        (&self.nodes[0], &self.nodes[self.nodes.len() - 1])
    }

    fn tail_time(&self, z: f64) -> f64 {
        let last = self.ends().1;
        let lead = (self.sound_slowness - last.slowness) * last.radius;
        last.time + (z - last.radius) * self.sound_slowness - lead * libm::log(z / last.radius)
    }

    fn tail_radius(&self, time: f64) -> f64 {
        let last = self.ends().1;
        let lead = (self.sound_slowness - last.slowness) * last.radius;
        let guess = last.radius + (time - last.time) / self.sound_slowness;
        let curve = |z: f64| (self.tail_time(z), self.sound_slowness - lead / z);
        invert(curve, time, guess, (last.radius, 2.0 * guess))
    }
}

/// The cubic through two points of the march with the front's slopes there.
struct Segment {
    start: f64,
    width: f64,
    /// Coefficients of the scaled place `s` between the points.
    cubic: [f64; 4],
}

impl Segment {
    fn new(start: &Node, end: &Node) -> Segment {
        let width = end.radius - start.radius;
        let rise = end.time - start.time;
        // Slopes above three times the chord's would let the cubic turn back.
        let (left, right) =
            ((start.slowness * width).min(3.0 * rise), (end.slowness * width).min(3.0 * rise));
        let cubic = [start.time, left, 3.0 * rise - 2.0 * left - right, left + right - 2.0 * rise];
        Segment { start: start.radius, width, cubic }
    }

    /// Time and its slope at radius `z`.
    fn time(&self, z: f64) -> (f64, f64) {
        let s = (z - self.start) / self.width;
        let [c0, c1, c2, c3] = self.cubic;
        (c0 + s * (c1 + s * (c2 + s * c3)), (c1 + s * (2.0 * c2 + s * 3.0 * c3)) / self.width)
    }
}

/// Where a rising `curve` (value, slope) reaches `target`: Newton's method within `bounds`.
fn invert(curve: impl Fn(f64) -> (f64, f64), target: f64, guess: f64, bounds: (f64, f64)) -> f64 {
    let (mut low, mut high) = bounds;
    let mut place = guess.clamp(low, high);
    for _ in 0..60 {
        let (value, slope) = curve(place);
        if value < target {
            low = place;
        } else {
            high = place;
        }
        let newton = place + (target - value) / slope;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if (next - place).abs() <= 1e-15 * place {
            return next;
        }
        place = next;
    }
    place
}
