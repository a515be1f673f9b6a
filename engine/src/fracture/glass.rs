//! Kinds of glass, and how finely a pane of each breaks.
//!
//! What is physics here and what is look:
//!
//! - **annealed**: the crack tree of the thesis. Cracks start where the pane fails, fork as energy allows, and run
//!   to the edge. Long shards that bend outward, and the rings that cross them, are a look: in a pane they come from
//!   bending, which a plane model does not see. What breaks finely also breaks from flaws all over it, each once
//!   the wave from the first crack has come; their number and arms are a look.
//! - **tempered**: a look. The stress locked into the pane breaks all of it into dice about as large as it is thick
//!   once a crack gets in; the dice come from half as many small three-armed cracks, and a front that runs out from
//!   the seed at the speed of the cracks says when each is cut.
//! - **laminated**: breaks as annealed does; the pieces stay on the interlayer. Whoever uses the pattern must hold
//!   them: [`Glass::holds`].

use core::f64::consts::PI;
use core::ops::ControlFlow;

use glam::DVec2;

use super::outline;
use super::pattern::{MOST_PIECES, Pattern};
use super::settings::{Depth, Forking, Guide, Nucleus, Order, Rings, Settings, Wiggle};
use crate::error::{Error, Result, positive};
use crate::geometry::{Polygon, bounds};
use crate::random;

/// Kinds of glass that an artist asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Glass {
    /// Float glass as it comes: long shards.
    #[default]
    Annealed,
    /// Safety glass: dice.
    Tempered,
    /// Two panes on an interlayer: cracks, but nothing falls.
    Laminated,
}

impl Glass {
    /// Whether pieces stay on an interlayer.
    pub fn holds(self) -> bool {
        self == Self::Laminated
    }
}

/// How finely a pane breaks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fineness {
    /// About this many pieces, within 10 %.
    Pieces(usize),
    /// The critical length a_c of the cracks [m].
    CriticalLength(f64),
}

/// How a crack starts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Shape {
    /// A short line that grows at both ends, as in the thesis.
    Segment,
    /// An X.
    Cross,
    /// A star of nine arms. It has no lens-shaped holes beside its middle, which a segment leaves.
    #[default]
    Star,
}

/// What an artist says of a pattern; [`Recipe::settings`] works out the rest.
#[derive(Debug, Clone, PartialEq)]
pub struct Recipe {
    /// Kind of glass.
    pub glass: Glass,
    /// How finely it breaks.
    pub fineness: Fineness,
    /// Where cracks start [m]; none: in the middle of the pane.
    pub seeds: Vec<DVec2>,
    /// In about how many places cracks start, seeds and flaws spread over the pane together; left out, in the
    /// seeds alone unless pieces would become needles.
    pub starts: Option<usize>,
    /// How they start.
    pub shape: Shape,
    /// The thesis's own rule of forking, and nothing that it does not have.
    pub literal: bool,
    /// Angle between the branches of a fork [rad].
    pub fork_angle: f64,
    /// Full width of its variation [rad].
    pub fork_variance: f64,
    /// Probability of a turn at each step of a crack; 0 gives straight cracks.
    pub wiggle_probability: f64,
    /// Full width of the turns [rad].
    pub wiggle_variance: f64,
    /// Step of a crack at which it may turn [m]; left out, a third of the mean piece's size.
    pub wiggle_spacing: Option<f64>,
    /// Share of wedges that rings cross.
    pub rings: f64,
    /// How far cracks grow at most [m].
    pub reach: Option<f64>,
    /// A direction that cracks bend to [rad], in place of outward.
    pub toward: Option<f64>,
    /// Every random draw comes from it.
    pub seed: u64,
}

impl Default for Recipe {
    /// The thesis's angles (Fig. 5.14) on annealed glass, in some hundred pieces.
    fn default() -> Self {
        Self {
            glass: Glass::Annealed,
            fineness: Fineness::Pieces(500),
            seeds: Vec::new(),
            starts: None,
            shape: Shape::Star,
            literal: false,
            fork_angle: 25.0_f64.to_radians(),
            fork_variance: 34.5_f64.to_radians(),
            wiggle_probability: 0.5,
            wiggle_variance: 20.0_f64.to_radians(),
            wiggle_spacing: None,
            rings: 0.6,
            reach: None,
            toward: None,
            seed: 1,
        }
    }
}

/// A pattern and what it was grown with.
#[derive(Debug)]
pub struct Grown {
    /// The pattern.
    pub pattern: Pattern,
    /// Its settings, with the critical length that gave the pieces asked for.
    pub settings: Settings,
}

type Observer<'a> = &'a mut dyn FnMut() -> ControlFlow<()>;

/// More pieces than this from one nucleus become needles: then cracks start at flaws all over the pane as well.
const MOST_PER_NUCLEUS: usize = 1500;
/// Pieces from each flaw then. With many more of them, flaws show as a field of flowers.
const PER_FLAW: usize = 15;
/// Fewest and most arms of a crack that starts at a flaw.
const FLAW_ARMS: (usize, usize) = (2, 5);
/// How far the first cracks have grown, over the distance to a flaw, when their stress wave reaches it: waves in
/// glass are some three times as fast as cracks.
const WAVE: f64 = 0.3;
/// How long a flaw may hold out from then on, in distances between flaws: the first to give way leave the larger
/// pieces.
const LONGEST_WAIT: f64 = 3.0;
/// A count of pieces this near to what was asked for is good enough.
const NEAR_ENOUGH: f64 = 0.05;
/// Patterns grown at most to find a count.
const ATTEMPTS: usize = 14;
const STAR_ARMS: usize = 9;
/// Up to so many pieces a star without forks gives the very count.
const FEW: usize = 20;
const DICE_ARMS: usize = 3;

impl Recipe {
    /// Grows the pattern. With [`Fineness::Pieces`] the critical length is searched for: the number of pieces rises
    /// as it falls, along nearly a power law.
    ///
    /// # Errors
    /// What [`Pattern::grow`] refuses; a count of pieces that is out of reach.
    pub fn grow(&self, outline: &Polygon) -> Result<Grown> {
        self.grow_observed(outline, &mut || ControlFlow::Continue(()))
    }

    /// The same for work that may take long: `observer` is asked every few milliseconds, and may break it off.
    ///
    /// # Errors
    /// Those of [`grow`](Self::grow), and [`Error::Cancelled`].
    pub fn grow_observed(
        &self,
        outline: &Polygon,
        observer: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Grown> {
        outline::check(outline)?;
        match self.fineness {
            Fineness::CriticalLength(length) => self.grow_with(outline, length, 0, observer),
            Fineness::Pieces(0) => {
                Err(Error::OutOfRange { what: "number of pieces", value: 0.0, expected: "at least 1" })
            }
            Fineness::Pieces(1) => self.unbroken(outline),
            Fineness::Pieces(count) if count <= FEW && !self.literal && self.seeds.len() <= 1 => {
                self.few(outline, count)
            }
            Fineness::Pieces(count) => self.search(outline, count, observer),
        }
    }

    /// Settings for a critical length; `pieces`, where it is known, decides how many flaws crack as well: see
    /// [`starts_for`](Self::starts_for).
    ///
    /// # Errors
    /// A critical length that is not greater than 0.
    pub fn settings(&self, outline: &Polygon, critical_length: f64, pieces: usize) -> Result<Settings> {
        positive("critical length [m]", critical_length)?;
        let seeds = if self.seeds.is_empty() { vec![middle(outline)] } else { self.seeds.clone() };
        let dice = self.is_dice();
        for &seed in &seeds {
            let enough = 1e-6 * longer_side(outline);
            if !outline::contains(outline, seed) || outline::clearance(outline, seed) < enough {
                return Err(Error::Malformed(format!(
                    "a crack starts at ({}, {}), which is outside the pane or on its border; give a point inside it",
                    seed.x, seed.y
                )));
            }
        }
        let wanted = if dice {
            outline.area() / (2.0 * critical_length * critical_length)
        } else {
            self.starts_for(pieces) as f64
        };
        if wanted > MOST_PIECES {
            return Err(Error::Malformed(format!(
                "cracks would start in {wanted:.0} places; at most {MOST_PIECES:.0} are possible"
            )));
        }
        let nuclei = self.nuclei(outline, &seeds, wanted, dice);
        let grain = if dice { critical_length } else { grain(outline, &nuclei, critical_length) };
        let spacing = self.wiggle_spacing.unwrap_or(grain / 3.0);
        let wiggle = Wiggle {
            probability: if dice { 0.0 } else { self.wiggle_probability },
            variance: self.wiggle_variance,
            spacing,
        };
        Ok(Settings {
            nuclei,
            critical_length,
            forking: match (self.literal, dice) {
                (true, _) => Forking::Literal(Order::FirstInFirstOut),
                (false, true) => Forking::Never,
                (false, false) => Forking::Driven { room: 0.8 * grain },
            },
            fork_angle: self.fork_angle,
            fork_variance: self.fork_variance,
            wiggle,
            guide: match self.toward {
                Some(angle) => Guide::Direction { angle, length: 4.0 * grain },
                None if self.literal || dice || self.wiggle_probability == 0.0 => Guide::None,
                None => Guide::Outward { length: 4.0 * grain },
            },
            rings: (self.rings > 0.0 && !self.literal && !dice).then_some(Rings {
                spacing: 1.2 * grain,
                growth: 1.5,
                share: self.rings,
            }),
            depth: Depth::default(),
            reach: self.reach,
            fronts: if dice { seeds } else { Vec::new() },
            seed: self.seed,
        })
    }

    /// Whether the pane breaks into dice all over, as tempered glass does.
    pub fn is_dice(&self) -> bool {
        self.glass == Glass::Tempered && !self.literal
    }

    /// In how many places cracks start for a count of pieces; 0 where the seeds are enough.
    pub fn starts_for(&self, pieces: usize) -> usize {
        let needles = pieces > MOST_PER_NUCLEUS * self.seeds.len().max(1);
        self.starts.unwrap_or(if needles { pieces / PER_FLAW } else { 0 })
    }

    fn grow_with(
        &self,
        outline: &Polygon,
        critical_length: f64,
        pieces: usize,
        observer: Observer,
    ) -> Result<Grown> {
        let settings = self.settings(outline, critical_length, pieces)?;
        Ok(Grown { pattern: Pattern::grow_observed(outline, &settings, observer)?, settings })
    }

    /// A pane that does not break.
    fn unbroken(&self, outline: &Polygon) -> Result<Grown> {
        let mut settings = self.settings(outline, libm::sqrt(outline.area()), 1)?;
        settings.reach = Some(1e-3 * settings.critical_length);
        settings.forking = Forking::Never;
        settings.rings = None;
        Ok(Grown { pattern: Pattern::grow(outline, &settings)?, settings })
    }

    /// A star whose arms run to the border: as many pieces as arms.
    fn few(&self, outline: &Polygon, count: usize) -> Result<Grown> {
        let shape = if count == 2 { Shape::Segment } else { Shape::Star };
        let recipe = Self { glass: Glass::Annealed, ..self.clone() };
        let mut settings = recipe.settings(outline, longer_side(outline), 1)?;
        settings.nuclei = vec![self.nucleus(settings.nuclei[0].position, shape, count, 0)];
        settings.forking = Forking::Never;
        settings.rings = None;
        settings.wiggle.spacing = self.wiggle_spacing.unwrap_or(0.05 * longer_side(outline));
        Ok(Grown { pattern: Pattern::grow(outline, &settings)?, settings })
    }

    fn search(&self, outline: &Polygon, count: usize, observer: Observer) -> Result<Grown> {
        let wanted = libm::log(count as f64);
        let side = longer_side(outline);
        let flaws = self.starts_for(count).max(self.seeds.len()).max(1) as f64;
        let share = libm::sqrt(outline.area() / flaws);
        let mut length = if self.is_dice() {
            libm::sqrt(outline.area() / count as f64)
        } else {
            (share * flaws / count as f64).min(side)
        };
        let (mut low, mut high) = (f64::NEG_INFINITY, libm::log(side));
        let mut best: Option<(f64, Grown)> = None;
        for _attempt in 0..ATTEMPTS {
            let grown = self.grow_with(outline, length, count, observer)?;
            let off = libm::log(grown.pattern.len() as f64) - wanted;
            let here = libm::log(length);
            if best.as_ref().is_none_or(|(least, _)| off.abs() < *least) {
                best = Some((off.abs(), grown));
            }
            if off.abs() < NEAR_ENOUGH || here == high && off > 0.0 {
                break;
            }
            // Too many pieces ask for a longer length.
            if off > 0.0 {
                low = here
            } else {
                high = here
            }
            // The count of dice goes with the square of their size, that of branches about with the length itself.
            let guess = here + if self.is_dice() { 0.5 * off } else { off };
            let inside = guess > low && guess < high;
            length = libm::exp(if inside {
                guess
            } else if low.is_finite() {
                0.5 * (low + high)
            } else {
                here + off.min(-0.7)
            });
        }
        let (off, grown) = best.expect("at least one attempt");
        if off > libm::log(1.1) {
            return Err(Error::Malformed(format!(
                "{count} pieces cannot be had with these cracks; the nearest is {}, so ask for that many or change \
                 the shape or number of the starts",
                grown.pattern.len()
            )));
        }
        Ok(grown)
    }

    /// Seeds, and with flaws spread over the pane some `wanted` nuclei in all.
    fn nuclei(&self, outline: &Polygon, seeds: &[DVec2], wanted: f64, dice: bool) -> Vec<Nucleus> {
        let (arms, shape) = if dice { (DICE_ARMS, Shape::Star) } else { (STAR_ARMS, self.shape) };
        let mut nuclei: Vec<Nucleus> =
            seeds.iter().enumerate().map(|(i, &at)| self.nucleus(at, shape, arms, i as u64)).collect();
        if self.literal || wanted <= seeds.len() as f64 {
            return nuclei;
        }
        let near = 1e-6 * longer_side(outline);
        let apart = libm::sqrt(outline.area() / wanted);
        for (index, at) in spread(outline, wanted, self.seed).into_iter().enumerate() {
            let away = seeds.iter().map(|seed| seed.distance(at)).fold(f64::INFINITY, f64::min);
            let index = (seeds.len() + index) as u64;
            if away > near {
                nuclei.push(if dice {
                    self.nucleus(at, Shape::Star, DICE_ARMS, index)
                } else {
                    self.flaw(at, index, away, apart)
                });
            }
        }
        nuclei
    }

    /// A crack that starts at a flaw `away` from the nearest seed, flaws being some way `apart` [m].
    fn flaw(&self, at: DVec2, index: u64, away: f64, apart: f64) -> Nucleus {
        let (fewest, most) = FLAW_ARMS;
        let draw = |key: u64| random::unit(self.seed ^ FLAWS, index, FLAW_KEYS + key);
        let arms = fewest + (draw(0) * (most - fewest + 1) as f64) as usize;
        let start = WAVE * away + LONGEST_WAIT * apart * draw(1);
        Nucleus { start, ..self.nucleus(at, Shape::Star, arms, index) }
    }

    fn nucleus(&self, at: DVec2, shape: Shape, arms: usize, index: u64) -> Nucleus {
        if self.literal {
            return match shape {
                Shape::Segment => Nucleus::segment(at, 0.0),
                Shape::Cross => Nucleus::cross(at, 0.25 * PI),
                Shape::Star => Nucleus::star(at, 0.0, arms),
            };
        }
        let draw = |key: u64| random::unit(self.seed ^ STARTS, index, key);
        let angle = 2.0 * PI * draw(0);
        let mut nucleus = match shape {
            Shape::Segment => return Nucleus::segment(at, angle),
            Shape::Cross => return Nucleus::cross(at, angle),
            Shape::Star => Nucleus::star(at, angle, arms),
        };
        // Arms are never quite even.
        let play = 0.5 * 2.0 * PI / arms as f64;
        for (key, arm) in (1..).zip(&mut nucleus.arms) {
            *arm += play * (draw(key) - 0.5);
        }
        nucleus
    }
}

/// Streams of draws for starts, apart from those of the cracks.
const STARTS: u64 = 0x5_7A27;
const FLAWS: u64 = 0xF_1A35;
/// First of the draws that say how a flaw gives way; those before it say where it lies.
const FLAW_KEYS: u64 = 2;

/// Some `count` points inside an outline, evenly spread and yet in no order: one at random in each cell of a grid.
fn spread(outline: &Polygon, count: f64, seed: u64) -> Vec<DVec2> {
    let (low, high) = bounds(outline.points().iter().copied());
    let cell = libm::sqrt(outline.area() / count);
    let size = ((high - low) / cell).ceil();
    let (columns, rows) = (size.x as u64, size.y as u64);
    let mut points = Vec::with_capacity(count as usize + 16);
    for row in 0..rows {
        for column in 0..columns {
            let draw = |key| 0.08 + 0.84 * random::unit(seed ^ FLAWS, row * columns + column, key);
            // Odd rows are shifted, so that no lines show.
            let shift = 0.5 * (row % 2) as f64;
            let at = low + cell * DVec2::new(column as f64 + draw(0) + shift - 0.25, row as f64 + draw(1));
            if outline::contains(outline, at) {
                points.push(at);
            }
        }
    }
    points
}

/// Size of the mean piece [m], where each nucleus leaves about as many pieces as it has arms and forks.
fn grain(outline: &Polygon, nuclei: &[Nucleus], critical_length: f64) -> f64 {
    let count = nuclei.len() as f64;
    let arms = nuclei.iter().map(|nucleus| nucleus.arms.len()).sum::<usize>() as f64;
    let share = libm::sqrt(outline.area() / count);
    libm::sqrt(outline.area() / (arms + count * share / critical_length))
}

fn longer_side(outline: &Polygon) -> f64 {
    let (low, high) = bounds(outline.points().iter().copied());
    (high - low).max_element()
}

/// The centroid, or where that is outside the pane the inner point of a coarse grid farthest from the border.
fn middle(outline: &Polygon) -> DVec2 {
    let centroid = outline.moments().centroid;
    if outline::contains(outline, centroid) {
        return centroid;
    }
    let (low, high) = bounds(outline.points().iter().copied());
    let grid = (1..32)
        .flat_map(|row| (1..32).map(move |column| DVec2::new(f64::from(column), f64::from(row)) / 32.0));
    grid.map(|share| low + (high - low) * share)
        .filter(|&at| outline::contains(outline, at))
        .max_by(|&a, &b| outline::clearance(outline, a).total_cmp(&outline::clearance(outline, b)))
        .unwrap_or(centroid)
}
