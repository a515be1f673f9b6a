//! How a crack pattern is to grow.

use core::f64::consts::PI;

use glam::DVec2;

use crate::error::{Error, Result, finite, not_negative, positive};

/// Everything that decides how cracks run, fork and turn in a pane.
///
/// Lengths in metres, angles in radians. The defaults are those of a large annealed pane that breaks from its
/// middle.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Where cracks start. At least one.
    pub nuclei: Vec<Nucleus>,
    /// Critical length a_c [m]: a tree forks once each time its cracks have grown by this much (thesis 5.4.1).
    ///
    /// Greater than 0 and at most the pane's longer side. Smaller gives more and smaller pieces: their number
    /// grows about linearly with the number of nuclei and with width / a_c.
    pub critical_length: f64,
    /// Which tip forks, and whether it may.
    pub forking: Forking,
    /// Angle between the two branches of a fork [rad], above 0 and below π. Larger gives rounder pieces.
    pub fork_angle: f64,
    /// Full width of the range in which a fork's angle varies [rad]: ± half of it. Each branch draws its own.
    pub fork_variance: f64,
    /// Random turns of a running crack.
    pub wiggle: Wiggle,
    /// What draws running cracks to one side.
    pub guide: Guide,
    /// Cracks that run across from one crack to the next.
    pub rings: Option<Rings>,
    /// How parameters change from fork to fork.
    pub depth: Depth,
    /// How far a crack grows at most [m]; beyond, it stops without meeting anything, as a creep crack does.
    pub reach: Option<f64>,
    /// Where fronts start that let cracks loose as they pass [m], at the speed of the cracks. They change when
    /// things are cut, not where: every growth that the pattern tells has the distance from the nearest one added.
    pub fronts: Vec<DVec2>,
    /// Every random draw comes from it.
    pub seed: u64,
}

/// A place where a crack starts.
#[derive(Debug, Clone, PartialEq)]
pub struct Nucleus {
    /// Where, in the pane's plane [m].
    pub position: DVec2,
    /// Directions of its arms, counter-clockwise from x [rad]: two opposite ones for the thesis's segment, four
    /// for an X, more for a star.
    pub arms: Vec<f64>,
    /// Growth of the first cracks after which it starts [m]; 0 at once.
    pub start: f64,
}

impl Nucleus {
    /// The thesis's micro-crack: a short segment that grows at both ends.
    pub fn segment(position: DVec2, angle: f64) -> Self {
        Self { position, arms: vec![angle, angle + PI], start: 0.0 }
    }

    /// An X (thesis 5.4.4).
    pub fn cross(position: DVec2, angle: f64) -> Self {
        Self::star(position, angle, 4)
    }

    /// A star of `arms` evenly spread arms.
    pub fn star(position: DVec2, angle: f64, arms: usize) -> Self {
        let spread = 2.0 * PI / arms as f64;
        Self { position, arms: (0..arms).map(|arm| angle + arm as f64 * spread).collect(), start: 0.0 }
    }
}

/// Which tip forks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Forking {
    /// The thesis's rule: one fork every a_c of growth, whatever is left of the tree.
    Literal(Order),
    /// No tip forks.
    Never,
    /// One fork every a_c while all tips of a tree are running, and more seldom in proportion as they die: the
    /// energy that drives forking goes with the region that has been cut loose. A tip forks only where both
    /// branches have room.
    Driven {
        /// How far both branches must be able to run [m].
        room: f64,
    },
}

/// In which order the tips of a tree fork.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Order {
    /// The one that has waited longest.
    #[default]
    FirstInFirstOut,
    /// Any of them, drawn at random.
    Random,
}

/// Random turns of a running crack (thesis 5.4.4).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wiggle {
    /// Probability of a turn at each step, 0 to 1.
    pub probability: f64,
    /// Full width of the range of turns [rad]: ± half of it.
    pub variance: f64,
    /// Distance between two places where a crack may turn [m].
    ///
    /// Also the step at which a [`Guide`] acts. It sets how rough edges are, and how many vertices pieces have.
    pub spacing: f64,
}

impl Wiggle {
    /// Straight cracks.
    pub const NONE: Self = Self { probability: 0.0, variance: 0.0, spacing: f64::INFINITY };
}

/// What draws running cracks to one side.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Guide {
    /// Nothing.
    #[default]
    None,
    /// Away from the nucleus that the crack comes from: branches bend until they run side by side, as long
    /// shards.
    Outward {
        /// Distance over which a crack has turned most of the way [m].
        length: f64,
    },
    /// A direction, whichever way along it is nearer.
    Direction {
        /// Counter-clockwise from x [rad].
        angle: f64,
        /// Distance over which a crack has turned most of the way [m].
        length: f64,
    },
    /// Across the greatest tension of a stress field.
    Stress {
        /// The field.
        field: StressField,
        /// Distance over which a crack has turned most of the way [m], where the field is at its strongest; longer
        /// in proportion where it is weaker.
        length: f64,
    },
}

/// Plane stress sampled on a regular grid.
#[derive(Debug, Clone, PartialEq)]
pub struct StressField {
    /// Position of the first sample [m].
    pub origin: DVec2,
    /// Distance between samples along x and y [m].
    pub spacing: DVec2,
    /// Samples along x.
    pub columns: usize,
    /// σ_xx, σ_yy and σ_xy [Pa], row after row from the lowest y.
    pub samples: Vec<[f64; 3]>,
}

/// Cracks that break the wedges between radial ones, as rings round the nucleus.
///
/// A look, not a computation: wedges bend outward and snap, which a plane model does not see. A ring starts only
/// where a crack stands across from it, no farther than the nucleus is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rings {
    /// Distance of the first ring from the nucleus, and between rings [m].
    pub spacing: f64,
    /// Each ring is this much wider apart than the one before: 1 keeps the distance.
    pub growth: f64,
    /// Share of wedges that a ring crosses, 0 to 1.
    pub share: f64,
}

/// How parameters change with every fork on the way from the nucleus (thesis 5.4.4), at most sixteen-fold in all.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Depth {
    /// Factor on the critical length at each fork.
    pub critical_length: f64,
    /// Factor on the fork angle at each fork.
    pub fork_angle: f64,
}

impl Default for Depth {
    fn default() -> Self {
        Self { critical_length: 1.0, fork_angle: 1.0 }
    }
}

impl Settings {
    /// The thesis's base algorithm from one segment: straight cracks, a set fork angle, first in first out.
    pub fn literal(position: DVec2, critical_length: f64, fork_angle: f64) -> Self {
        Self {
            nuclei: vec![Nucleus::segment(position, 0.0)],
            critical_length,
            forking: Forking::Literal(Order::FirstInFirstOut),
            fork_angle,
            fork_variance: 0.0,
            wiggle: Wiggle::NONE,
            guide: Guide::None,
            rings: None,
            depth: Depth::default(),
            reach: None,
            fronts: Vec::new(),
            seed: 1,
        }
    }

    /// Checks every number on its own; what concerns the pane is checked when the pattern grows.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] or [`Error::Malformed`] for the first value without a meaning.
    pub fn validate(&self) -> Result<()> {
        positive("critical length [m]", self.critical_length)?;
        within(
            "fork angle [rad]",
            self.fork_angle,
            1e-3,
            PI - 1e-3,
            "from 0.001 to 3.14 (0.06 to 179.9 degrees)",
        )?;
        within("fork variance [rad]", self.fork_variance, 0.0, PI, "an angle from 0 to 180 degrees")?;
        within("wiggle probability", self.wiggle.probability, 0.0, 1.0, "a number from 0 to 1")?;
        within("wiggle variance [rad]", self.wiggle.variance, 0.0, PI, "an angle from 0 to 180 degrees")?;
        if self.turns() {
            positive("wiggle spacing [m]", self.wiggle.spacing)?;
        }
        if let Forking::Driven { room } = self.forking {
            not_negative("room to fork [m]", room)?;
        }
        positive("depth factor of the critical length", self.depth.critical_length)?;
        positive("depth factor of the fork angle", self.depth.fork_angle)?;
        if let Some(reach) = self.reach {
            positive("reach of a crack [m]", reach)?;
        }
        if let Some(rings) = self.rings {
            positive("spacing of rings [m]", rings.spacing)?;
            within("growth of rings", rings.growth, 1.0, 100.0, "a number from 1 to 100")?;
            within("share of wedges that rings cross", rings.share, 0.0, 1.0, "a number from 0 to 1")?;
        }
        self.guide.validate()?;
        if self.nuclei.is_empty() {
            return Err(Error::Malformed("a crack pattern needs at least one place to start from".into()));
        }
        self.nuclei.iter().try_for_each(Nucleus::validate)
    }

    /// What the [`fronts`](Self::fronts) add to the growth at a point [m].
    pub fn delay(&self, point: DVec2) -> f64 {
        let nearest = self.fronts.iter().map(|front| front.distance(point)).fold(f64::INFINITY, f64::min);
        if nearest.is_finite() { nearest } else { 0.0 }
    }

    /// Whether running cracks may turn.
    pub fn turns(&self) -> bool {
        (self.wiggle.probability > 0.0 && self.wiggle.variance > 0.0) || self.guide != Guide::None
    }
}

impl Nucleus {
    fn validate(&self) -> Result<()> {
        finite("place of a crack's start [m]", self.position.x)?;
        finite("place of a crack's start [m]", self.position.y)?;
        not_negative("start of a crack [m]", self.start)?;
        if self.arms.is_empty() {
            return Err(Error::Malformed("a crack needs at least one arm to start with".into()));
        }
        let turned = |arm: f64| DVec2::new(libm::cos(arm), libm::sin(arm));
        let same = |a: f64, b: f64| turned(a).distance(turned(b)) < 1e-9;
        if self.arms.iter().enumerate().any(|(i, &a)| self.arms[i + 1..].iter().any(|&b| same(a, b))) {
            return Err(Error::Malformed("two arms of a crack point the same way; keep one of them".into()));
        }
        self.arms.iter().try_for_each(|&arm| finite("direction of a crack's arm [rad]", arm).map(drop))
    }
}

impl Guide {
    fn validate(&self) -> Result<()> {
        let length = match self {
            Self::None => return Ok(()),
            Self::Outward { length } | Self::Direction { length, .. } | Self::Stress { length, .. } => {
                *length
            }
        };
        positive("length over which a guide turns a crack [m]", length)?;
        match self {
            Self::Direction { angle, .. } => finite("direction of a guide [rad]", *angle).map(drop),
            Self::Stress { field, .. } => field.validate(),
            _ => Ok(()),
        }
    }
}

impl StressField {
    fn validate(&self) -> Result<()> {
        positive("spacing of a stress field [m]", self.spacing.x)?;
        positive("spacing of a stress field [m]", self.spacing.y)?;
        let whole = self.columns > 0 && self.samples.len().is_multiple_of(self.columns);
        if !whole || self.samples.is_empty() || self.samples.iter().flatten().any(|s| !s.is_finite()) {
            return Err(Error::Malformed("a stress field needs whole rows of finite samples".into()));
        }
        Ok(())
    }

    /// Direction across the greatest tension at a point [rad], and by how much the two principal stresses differ
    /// there [Pa]: where they are equal no direction is preferred. The nearest sample counts.
    pub fn crack_direction(&self, at: DVec2) -> (f64, f64) {
        let rows = self.samples.len() / self.columns;
        let nearest = |x: f64, count: usize| libm::rint(x).clamp(0.0, (count - 1) as f64) as usize;
        let place = (at - self.origin) / self.spacing;
        let index = nearest(place.y, rows) * self.columns + nearest(place.x, self.columns);
        let [xx, yy, xy] = self.samples[index];
        let tension = 0.5 * libm::atan2(2.0 * xy, xx - yy);
        (tension + 0.5 * PI, libm::hypot(xx - yy, 2.0 * xy))
    }

    /// The greatest difference of principal stresses anywhere [Pa].
    pub fn strongest(&self) -> f64 {
        self.samples.iter().map(|[xx, yy, xy]| libm::hypot(xx - yy, 2.0 * xy)).fold(0.0, f64::max)
    }
}

fn within(what: &'static str, value: f64, low: f64, high: f64, expected: &'static str) -> Result<()> {
    if value >= low && value <= high { Ok(()) } else { Err(Error::OutOfRange { what, value, expected }) }
}
