//! A place that records the pressure passing it.

use super::Scheme;

/// Samples that a gauge keeps of its history before it drops every other one.
const HISTORY: usize = 4096;

/// What passed a fixed place.
///
/// If a front bounds the mesh, the gauge knows the very moment and strength in which it passes. Otherwise the
/// shock is spread over a few cells: its arrival is taken at the steepest rise before the highest pressure.
#[derive(Debug, Clone, PartialEq)]
pub struct Gauge {
    /// Distance from the centre [m].
    pub distance: f64,
    /// Pressure before anything passes [Pa].
    ambient: f64,
    /// Time of arrival [s].
    pub arrival: Option<f64>,
    /// Overpressure of the front [Pa]; where no front bounds the mesh, the highest of the positive phase.
    pub overpressure: f64,
    /// Dynamic pressure ½ρu² at that moment [Pa].
    pub dynamic_pressure: f64,
    /// Velocity of the front [m/s], where a front bounds the mesh.
    pub front_velocity: Option<f64>,
    /// Impulse of the positive phase [Pa s], so far.
    pub impulse: f64,
    /// Duration of the positive phase [s]; `None` while it lasts.
    pub duration: Option<f64>,
    /// Times [s] and overpressures [Pa] recorded, thinned evenly.
    pub history: Vec<(f64, f64)>,
    steepest: f64,
    last: (f64, f64),
    cell: usize,
    stride: usize,
    skipped: usize,
}

impl Gauge {
    /// A gauge `distance` [m] from the centre in air of pressure `ambient` [Pa].
    pub fn new(distance: f64, ambient: f64) -> Gauge {
        Gauge {
            distance,
            ambient,
            arrival: None,
            overpressure: 0.0,
            dynamic_pressure: 0.0,
            front_velocity: None,
            impulse: 0.0,
            duration: None,
            history: Vec::with_capacity(HISTORY),
            steepest: 0.0,
            last: (0.0, 0.0),
            cell: 0,
            stride: 1,
            skipped: 0,
        }
    }

    /// Whether the positive phase is over.
    pub fn is_done(&self) -> bool {
        self.duration.is_some()
    }

    /// Records the flow as it is now; called after every step.
    pub fn record(&mut self, flow: &impl Scheme) {
        let now = flow.time();
        let (overpressure, dynamic) = match flow.front() {
            Some((state, speed)) => {
                let edge = flow.face()[flow.face().len() - 1];
                if edge < self.distance {
                    self.last = (now, 0.0);
                    return;
                }
                if self.arrival.is_none() {
                    let passed = now - (edge - self.distance) / speed;
                    self.arrival = Some(passed);
                    self.front_velocity = Some(speed);
                    self.overpressure = state.pressure - self.ambient;
                    self.dynamic_pressure = 0.5 * state.density * state.velocity * state.velocity;
                    self.last = (passed, self.overpressure);
                    self.keep(self.last);
                }
                self.read(flow)
            }
            None => self.read(flow),
        };
        self.take(now, overpressure, dynamic, flow.front().is_some());
        self.keep((now, overpressure));
        self.last = (now, overpressure);
    }

    /// Overpressure and dynamic pressure here, between the centres of the cells.
    fn read(&mut self, flow: &impl Scheme) -> (f64, f64) {
        let centre = flow.centre();
        let last = centre.len() - 1;
        while self.cell < last && centre[self.cell + 1] <= self.distance {
            self.cell += 1;
        }
        while self.cell > 0 && centre[self.cell] > self.distance {
            self.cell -= 1;
        }
        let here = flow.gas(self.cell);
        let (next, far) = match (self.cell == last, flow.front()) {
            (false, _) => (flow.gas(self.cell + 1), centre[self.cell + 1]),
            (true, Some((state, _))) => (state, flow.face()[last + 1]),
            (true, None) => (here, flow.face()[last + 1]),
        };
        let near = centre[self.cell];
        let part = ((self.distance - near) / (far - near)).clamp(0.0, 1.0);
        let mix = |a: f64, b: f64| a + part * (b - a);
        let velocity = mix(here.velocity, next.velocity);
        let dynamic = 0.5 * mix(here.density, next.density) * velocity * velocity;
        (mix(here.pressure, next.pressure) - self.ambient, dynamic)
    }

    /// Adds the stretch since the last sample to peak, arrival, impulse and duration.
    fn take(&mut self, now: f64, overpressure: f64, dynamic: f64, bounded: bool) {
        let (before, last) = self.last;
        if self.is_done() || now <= before {
            return;
        }
        if !bounded && overpressure > self.overpressure {
            self.overpressure = overpressure;
            self.dynamic_pressure = dynamic;
            let rise = (overpressure - last) / (now - before);
            if rise > self.steepest {
                self.steepest = rise;
                self.arrival = Some(0.5 * (before + now));
            }
        }
        if overpressure > 0.0 {
            self.impulse += 0.5 * (now - before) * (last.max(0.0) + overpressure);
            return;
        }
        // A passing ripple is no positive phase: it is one once the wave is well past its peak.
        let Some(arrival) = self.arrival else { return };
        if last > 0.0 && self.overpressure > 1e-6 * self.ambient {
            let part = last / (last - overpressure);
            self.impulse += 0.5 * part * (now - before) * last;
            self.duration = Some(before + part * (now - before) - arrival);
        }
    }

    fn keep(&mut self, sample: (f64, f64)) {
        self.skipped += 1;
        if self.skipped < self.stride {
            return;
        }
        self.skipped = 0;
        if self.history.len() == HISTORY {
            let mut index = 0;
            self.history.retain(|_| {
                index += 1;
                index % 2 == 1
            });
            self.stride *= 2;
        }
        self.history.push(sample);
    }
}
