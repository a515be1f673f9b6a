//! Pressure on one panel over time, with its impulse in closed form.
//!
//! Front face (thesis 2.6.4, Figs 2.13 and 2.16): the reflected peak C_R(α, p_s)·p_s gives way, over the
//! clearing time `t' = 3S/U_s` (2.31), to what the open flow exerts. The thesis draws a straight line from
//! one to the other. Here the reflected pulse R(t) and the flow's pressure F(t) are blended by a weight that
//! falls linearly from 1 to 0 over t',
//!
//! `p(t) = F(t) + (R(t) − F(t)) · max(0, 1 − t/t')`.
//!
//! For t' short against the pulse this is the thesis's line; for a wall too wide to clear it tends to the
//! fully reflected pulse, which the line overshoots without bound. The impulse therefore always lies between
//! that of the flow and that of full reflection.

use crate::blast::pulse::integrate_poly_exp;
use crate::blast::{BlastField, BlastPoint, NegativePhase, Pulse, PulseShape};

/// Which part of the load is counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LoadingMode {
    /// The thesis's quasi-static choice (3.2.1, Fig. 2.16): static pressure cancels around an engulfed body;
    /// only panels that face the charge are loaded, by reflection and drag.
    #[default]
    Translational,
    /// Every face has its own history (Fig. 2.13); the net force comes out of the sum.
    Surface,
}

/// How the blast wind acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Drag {
    /// By the flow relative to the moving body, on the body as a whole: see [`Wind`](super::Wind).
    #[default]
    FlowRelative,
    /// As in the thesis: C_D·q(t) on each panel that faces the charge as if the body stood still (2.32), and
    /// air resistance against its own velocity beside it (3.2).
    Thesis,
}

/// How a panel meets the front.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Face {
    /// It faces the charge: reflection, cleared from the silhouette's edge at this distance S [m].
    Front {
        /// Clearing length S [m]; infinite for a face that never clears.
        clearing_length: f64,
    },
    /// It faces away: static pressure only, rising over `3S/a` (2.6.4), less the more it is a side.
    Rear {
        /// Distance S over which the wave has to come round [m].
        clearing_length: f64,
    },
}

/// Load of one charge on one panel: pressure above the ambient one, along the inward normal.
#[derive(Debug, Clone, Copy)]
pub struct FaceHistory {
    arrival: f64,
    end: f64,
    incident: Pulse,
    reflected: Pulse,
    /// Time over which the reflection is relieved, or a rear face filled [s].
    relief: f64,
    /// Drag pressure at the front of φ² and φ³, φ = (1 − x) e^(−bx) [Pa].
    drag: [f64; 2],
    front: bool,
    steady_drag: bool,
    static_pressure: bool,
}

/// What the panels that one charge loads share.
#[derive(Debug, Clone, Copy)]
pub struct HistorySettings {
    /// Which part of the load is counted.
    pub mode: LoadingMode,
    /// How the wind acts.
    pub drag: Drag,
    /// The pulse's shape in time.
    pub shape: PulseShape,
    /// Whether the pressure falls below the ambient one afterwards (surface loading only).
    pub negative_phase: bool,
    /// Art direction: multiplies every load from the charge.
    pub gain: f64,
}

impl FaceHistory {
    /// Load at a point of the field on a panel whose inward normal makes the angle α with the ray, given by
    /// `cos_alpha` (negative for a face turned away).
    pub fn new(
        field: &BlastField,
        point: &BlastPoint,
        cos_alpha: f64,
        face: Face,
        drag_coefficient: f64,
        settings: HistorySettings,
    ) -> Self {
        let gain = settings.gain;
        let mut incident = point.pulse(settings.shape);
        if settings.negative_phase && settings.mode == LoadingMode::Surface {
            let suction = field.negative_phase(point.distance);
            incident.negative = Some(NegativePhase { peak: suction.peak * gain, ..suction });
        }
        let mut reflected = incident;
        let relief;
        let mut drag = [0.0; 2];
        let front = matches!(face, Face::Front { .. });
        match face {
            Face::Front { clearing_length } => {
                let coefficient = field.reflection_coefficient(cos_alpha, point.overpressure);
                reflected = Pulse::new(
                    settings.shape,
                    coefficient * point.overpressure,
                    point.duration,
                    oblique_impulse(field, point, coefficient),
                );
                relief = 3.0 * clearing_length / point.front_velocity;
                drag = drag_pressure(field, point, cos_alpha, drag_coefficient, settings.drag);
            }
            Face::Rear { clearing_length } => {
                relief = 3.0 * clearing_length / field.air().sound_speed() * cos_alpha.abs();
            }
        }
        incident.peak *= gain;
        reflected.peak *= gain;
        let mut history = Self {
            arrival: point.arrival_time,
            end: 0.0,
            incident,
            reflected,
            relief,
            drag: drag.map(|d| d * gain),
            front,
            steady_drag: settings.drag == Drag::Thesis,
            static_pressure: settings.mode == LoadingMode::Surface,
        };
        history.end = point.arrival_time + history.length();
        history
    }

    /// When the front reaches the panel [s].
    pub fn arrival(&self) -> f64 {
        self.arrival
    }

    /// When the load is over [s].
    pub fn end(&self) -> f64 {
        self.end
    }

    /// Highest pressure the panel feels [Pa].
    pub fn peak(&self) -> f64 {
        if self.front { self.reflected.peak } else { self.incident.peak }
    }

    /// Pressure at the time `t` [Pa].
    pub fn pressure(&self, t: f64) -> f64 {
        let since = t - self.arrival;
        if since < 0.0 || t >= self.end {
            return 0.0;
        }
        let weight = (1.0 - since / self.relief).max(0.0);
        let incident = if self.static_pressure { self.incident.value(since) } else { 0.0 };
        let positive = if since < self.incident.duration { self.incident.value(since) } else { 0.0 };
        if !self.front {
            return incident - positive * weight;
        }
        let phi = if positive > 0.0 { positive / self.incident.peak } else { 0.0 };
        let drag = phi * phi * (self.drag[0] + self.drag[1] * phi);
        let flow = if self.steady_drag { drag } else { 0.0 };
        let cancelled = drag + if self.static_pressure { positive } else { 0.0 };
        incident + flow + (self.reflected.value(since) - cancelled) * weight
    }

    /// ∫ p dt between two times [Pa s], in closed form.
    pub fn impulse(&self, t0: f64, t1: f64) -> f64 {
        let from = (t0 - self.arrival).max(0.0);
        let to = t1.min(self.end) - self.arrival;
        if to <= from {
            return 0.0;
        }
        if self.front { self.front_impulse(from, to) } else { self.rear_impulse(from, to) }
    }

    fn front_impulse(&self, from: f64, to: f64) -> f64 {
        let mut sum = 0.0;
        if self.static_pressure {
            sum += self.incident.impulse(from, to);
        }
        if self.steady_drag {
            sum += self.drag_impulse(from, to, 0.0);
        }
        let relieved = to.min(self.relief);
        if relieved > from {
            let slope = 1.0 / self.relief;
            sum +=
                weighted(&self.reflected, from, relieved, slope) - self.drag_impulse(from, relieved, slope);
            if self.static_pressure {
                sum -= weighted(&self.incident, from, relieved, slope);
            }
        }
        sum
    }

    fn rear_impulse(&self, from: f64, to: f64) -> f64 {
        let filled = to.min(self.relief);
        let filling =
            if filled > from { weighted(&self.incident, from, filled, 1.0 / self.relief) } else { 0.0 };
        self.incident.impulse(from, to) - filling
    }

    /// ∫ of the drag pressure times (1 − slope·t) between two times after arrival.
    fn drag_impulse(&self, from: f64, to: f64, slope: f64) -> f64 {
        let duration = self.incident.duration;
        let (x0, x1) = (from / duration, (to / duration).min(1.0));
        if x1 <= x0 || self.drag == [0.0; 2] {
            return 0.0;
        }
        let (b, k) = (self.incident.decay, slope * duration);
        let square = integrate_poly_exp(times_line([1.0, -2.0, 1.0, 0.0, 0.0], k), 2.0 * b, x0, x1);
        let cube = integrate_poly_exp(times_line([1.0, -3.0, 3.0, -1.0, 0.0], k), 3.0 * b, x0, x1);
        duration * (self.drag[0] * square + self.drag[1] * cube)
    }

    fn length(&self) -> f64 {
        let mut length: f64 = 0.0;
        if self.front {
            length = self.relief.min(self.reflected.duration.max(self.incident.duration));
            if self.steady_drag {
                length = length.max(self.incident.duration);
            }
        }
        if self.static_pressure {
            length = length.max(self.incident.duration + self.incident.negative.map_or(0.0, |n| n.duration));
        }
        length
    }
}

/// ∫ of a pulse's positive phase times (1 − slope·t) between two times after arrival.
fn weighted(pulse: &Pulse, from: f64, to: f64, slope: f64) -> f64 {
    let (x0, x1) = (from / pulse.duration, (to / pulse.duration).min(1.0));
    if x1 <= x0 {
        return 0.0;
    }
    let polynomial = times_line([1.0, -1.0, 0.0], slope * pulse.duration);
    pulse.peak * pulse.duration * integrate_poly_exp(polynomial, pulse.decay, x0, x1)
}

/// Coefficients of c(x)·(1 − kx); the last coefficient of `c` must be 0.
fn times_line<const N: usize>(c: [f64; N], k: f64) -> [f64; N] {
    let mut product = c;
    for i in 1..N {
        product[i] -= k * c[i - 1];
    }
    product
}

/// Impulse of the fully reflected pulse at an angle [Pa s]: from the incident one at grazing incidence to the
/// normally reflected one head on, in proportion to the pressure that reflection adds, and never beyond them.
fn oblique_impulse(field: &BlastField, point: &BlastPoint, coefficient: f64) -> f64 {
    let head_on = field.reflection_coefficient(1.0, point.overpressure);
    let share = ((coefficient - 1.0) / (head_on - 1.0)).clamp(0.0, 1.0);
    point.impulse + (point.reflected_impulse - point.impulse) * share
}

/// Drag pressure that a front panel is left with once the reflection is relieved, as factors of φ² and φ³.
///
/// The thesis puts C_D·q on every panel that faces the charge; in a flow that is followed as such, only the
/// part normal to the panel stagnates, cos²α of it.
fn drag_pressure(
    field: &BlastField,
    point: &BlastPoint,
    cos_alpha: f64,
    coefficient: f64,
    drag: Drag,
) -> [f64; 2] {
    let normal = match drag {
        Drag::Thesis => 1.0,
        Drag::FlowRelative => cos_alpha * cos_alpha,
    };
    let peak = coefficient * point.dynamic_pressure * normal;
    let compressed = 1.0 - field.air().density() / point.density;
    [peak * (1.0 - compressed), peak * compressed]
}
