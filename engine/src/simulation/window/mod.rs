//! Panes under the blast: whether each holds, where and when it fails, into what it breaks, and when the pieces come
//! free (thesis chapter 6, and the coupling that 6.7 names).
//!
//! Before the run, a pane is one body: it shelters, and is loaded, as a whole. [`response`] bends it; where the stress
//! reaches its strength, cracks start, and their pattern is grown as fine as the load asks for (2.45). Each fragment
//! becomes a body of its own that is held until it is free, as [`release`] says. From then on it is a body like any
//! other.

mod release;
mod response;
mod sheet;

use std::borrow::Cow;
use std::ops::ControlFlow;
use std::sync::Arc;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::shelter::Shelters;
use super::targets::{self, Outlines, Target};
use crate::blast::BlastField;
use crate::dynamics::{Bowing, Hold, Until};
use crate::error::{Error, Result};
use crate::fracture::{CrackClock, Fineness, Glass, Grown, Pieces, Recipe, outline};
use crate::geometry::{Polygon, Sample, bounds};
use crate::material::{self, mean_fragment_area};
use crate::random;
use crate::scene::{Body, Flat, Scene, Shape};
use crate::structure::Plate;
use crate::window::{Release, Window};
use response::{Load, Response};
pub(super) use sheet::Sheet;

/// Panels along the longer side of a whole pane.
const PANELS: usize = 8;

/// Weibull's exponent of glass: how much likelier a flaw gives way under a higher stress. Values from 5 to 9 are
/// reported for weathered panes.
const FLAW_EXPONENT: f64 = 7.0;
/// Stream of draws for where a pane fails.
const ORIGINS: u64 = 0x0_816A;

/// What became of a pane.
#[derive(Debug)]
pub struct Pane {
    /// Whether and when it broke.
    pub fate: Fate,
    /// Highest mean pressure on it from one charge [Pa].
    pub peak_pressure: f64,
    /// Greatest stress in it until it failed [Pa]; 0 for one that was in pieces before.
    pub peak_stress: f64,
    /// How it bends.
    pub plate: Arc<Plate>,
    /// How far it bent.
    pub bowing: Arc<Bowing>,
    /// Its cracks; of a pane that holds, none.
    pub grown: Grown,
    /// Its pieces as solids; a pane that holds is one piece.
    pub pieces: Pieces,
    /// What was approximated, in sentences.
    pub warnings: Vec<String>,
    /// When each piece may move and how it moves before.
    pub holds: Vec<Hold>,
}

/// Whether a pane broke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fate {
    /// The stress never reached its strength.
    Holds,
    /// It failed at a time [s], at a place in its frame [m].
    Fails {
        /// When [s].
        time: f64,
        /// Where in its own frame [m].
        place: DVec2,
    },
    /// It was in pieces before the blast came.
    InPieces,
}

/// All panes of a scene, broken or not, and the outlines that what stands together had before.
#[derive(Debug, Default)]
pub struct Panes {
    /// One a window, in order.
    pub panes: Vec<Pane>,
    outlines: Outlines,
}

/// The scene with every pane as one body after the others, as it stands before the blast.
pub fn standing(scene: &Scene) -> Cow<'_, Scene> {
    if scene.windows.is_empty() {
        return Cow::Borrowed(scene);
    }
    let mut standing = scene.clone();
    standing.bodies.extend(scene.windows.iter().map(whole));
    Cow::Owned(standing)
}

impl Panes {
    /// Loads every pane of a scene and breaks those that fail. At most `most_pieces` pieces in all; `observer` is asked
    /// now and then and may stop the work.
    ///
    /// `shelters` are those of the scene with every pane standing. A pane that comes apart does not keep the blast from
    /// what is behind it: for that they are found anew.
    ///
    /// # Errors
    /// What [`Scene::validate`] and [`Recipe::grow`] refuse; more pieces than allowed; [`Error::Cancelled`].
    pub fn find(
        scene: &Scene,
        shelters: &mut Shelters,
        most_pieces: usize,
        observer: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Self> {
        if scene.windows.is_empty() {
            return Ok(Self::default());
        }
        scene.validate()?;
        let fields: Vec<BlastField> =
            scene.charges.iter().map(|charge| BlastField::new(charge, &scene.air)).collect::<Result<_>>()?;
        let standing = standing(scene);
        let mut found = Self { panes: Vec::new(), outlines: targets::outlines(&standing, &fields)? };
        let tried: Vec<Trial> = loop {
            let tried = scene
                .windows
                .par_iter()
                .enumerate()
                .map(|(number, window)| {
                    let index = scene.bodies.len() + number;
                    let target = targets::aim_one(&standing, &fields, shelters, &found.outlines, index)?;
                    targets::in_time(scene, core::slice::from_ref(&target))?;
                    Trial::of(window, target).map_err(|error| error.about(&format!("window {number}")))
                })
                .collect::<Result<Vec<_>>>()?;
            if observer().is_break() {
                return Err(Error::Cancelled);
            }
            if !shelters.let_through(scene, tried.iter().map(Trial::comes_apart))? {
                break tried;
            }
        };
        let mut left = most_pieces;
        for (number, (window, trial)) in scene.windows.iter().zip(tried).enumerate() {
            let pane = trial
                .breaking(window, left, observer)
                .map_err(|error| error.about(&format!("window {number}")))?;
            left = left.saturating_sub(pane.pieces.len());
            found.panes.push(pane);
        }
        Ok(found)
    }

    /// The scene with the pieces of its panes after its other bodies, and their shelter that of the panes there.
    pub(super) fn in_pieces(&self, scene: &Scene, shelters: Shelters) -> (Scene, Shelters) {
        let mut bodies = scene.bodies.clone();
        let mut places = Vec::new();
        for (number, (window, pane)) in scene.windows.iter().zip(&self.panes).enumerate() {
            let samples = samples(&window.outline);
            for (index, hold) in pane.holds.iter().enumerate() {
                let centre = pane.pieces.moments[index].centroid;
                places.push((scene.bodies.len() + number, nearest(&samples, centre)));
                bodies.push(piece(window, pane, index, hold));
            }
        }
        let count = scene.bodies.len();
        (Scene { bodies, windows: Vec::new(), ..scene.clone() }, shelters.with_pieces(count, places))
    }

    /// Of each pane, the number of its first piece in a scene with so many other bodies.
    pub(super) fn first_pieces(&self, bodies: usize) -> Vec<usize> {
        let mut next = bodies;
        let first = |pane: &Pane| {
            next += pane.holds.len();
            next - pane.holds.len()
        };
        self.panes.iter().map(first).collect()
    }

    pub(super) fn outlines(&self) -> Option<&Outlines> {
        (!self.panes.is_empty()).then_some(&self.outlines)
    }
}

/// A pane that has been loaded but not yet broken.
struct Trial {
    glass: Glass,
    target: Target,
    plate: Plate,
    response: Response,
    fate: Fate,
}

impl Trial {
    fn of(window: &Window, target: Target) -> Result<Self> {
        let plate = Plate::new(&window.outline, window.thickness, &window.material)?;
        let (fate, response) = if window.release == Release::AllAtOnce && window.may_break {
            (Fate::InPieces, Response::none())
        } else {
            let load = load(window, &target, &plate);
            let response = Response::until_failure(&plate, &load, window.strength, window.may_break);
            let fails = |time| Fate::Fails { time, place: origin(&plate, window) };
            (response.failure.map_or(Fate::Holds, fails), response)
        };
        Ok(Self { glass: window.recipe.glass, target, plate, response, fate })
    }

    /// Whether it leaves an opening.
    fn comes_apart(&self) -> bool {
        self.fate != Fate::Holds && !self.glass.holds()
    }

    fn breaking(
        self,
        window: &Window,
        most_pieces: usize,
        observer: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Pane> {
        let Self { glass, target, plate, response, fate } = self;
        let load = load(window, &target, &plate);
        let peak_pressure = target.queue.highest(across(&target)) / window.outline.area();
        let mut warnings = Vec::new();
        let recipe = recipe(window, fate, peak_pressure, &mut warnings);
        let planned = match recipe.fineness {
            Fineness::Pieces(count) => count as f64,
            Fineness::CriticalLength(length) if recipe.is_dice() => window.outline.area() / (length * length),
            Fineness::CriticalLength(_) => 0.0,
        };
        check_count(planned, most_pieces)?;
        let grown = recipe.grow_observed(&window.outline, observer)?;
        check_count(grown.pattern.len() as f64, most_pieces)?;
        let pieces = Pieces::of(&grown.pattern, window.thickness, window.material.density)?;
        let cracks =
            release::Cracks { clock: clock(window, &grown), pattern: &grown.pattern, pieces: &pieces };
        let peak_stress = response.peak * plate.strongest();
        let (bowing, holds) = match fate {
            Fate::Fails { .. } => release::holds(window, &plate, &load, response, &cracks),
            Fate::InPieces if !glass.holds() => {
                (response.bowing, vec![Hold::until_the_front(); pieces.len()])
            }
            _ => (response.bowing, vec![Hold::still(Until::Forever); pieces.len()]),
        };
        let plate = Arc::new(plate);
        Ok(Pane { fate, peak_pressure, peak_stress, plate, bowing, grown, pieces, warnings, holds })
    }
}

fn load<'a>(window: &Window, target: &'a Target, plate: &Plate) -> Load<'a> {
    Load::new(&target.queue, across(target), plate, &samples(&window.outline))
}

/// A pane's own +z in the axes of its loads.
fn across(target: &Target) -> DVec3 {
    target.object_from_principal.conjugate() * DVec3::Z
}

impl Pane {
    /// How many of its pieces stay where they are, in the rebate or on an interlayer.
    pub fn staying(&self) -> usize {
        self.holds.iter().filter(|hold| hold.until == Until::Forever).count()
    }
}

/// How a window breaks: as finely as the load asks for, from where it failed, or not at all.
fn recipe(window: &Window, fate: Fate, peak_pressure: f64, warnings: &mut Vec<String>) -> Recipe {
    let mut recipe = window.recipe.clone();
    match fate {
        Fate::Holds => {
            recipe.fineness = Fineness::Pieces(1);
            return recipe;
        }
        Fate::Fails { place, .. } if recipe.seeds.is_empty() => recipe.seeds.push(place),
        _ => {}
    }
    if window.by_load {
        recipe.fineness = Fineness::Pieces(pieces_of(window, peak_pressure, warnings));
    }
    recipe
}

fn check_count(count: f64, most: usize) -> Result<()> {
    if count <= most as f64 {
        return Ok(());
    }
    Err(Error::Malformed(format!(
        "would break into about {count:.0} pieces, more than memory holds for so many frames; give it fewer pieces or \
         record fewer frames"
    )))
}

/// How the cracks of a window keep time; dice are cut by a front at full speed.
fn clock(window: &Window, grown: &Grown) -> CrackClock {
    CrackClock {
        terminal_speed: window.material.terminal_crack_speed(),
        critical_length: if window.recipe.is_dice() { 0.0 } else { grown.settings.critical_length },
    }
}

/// How many pieces the load breaks a window into, by (2.45).
fn pieces_of(window: &Window, peak_pressure: f64, warnings: &mut Vec<String>) -> usize {
    let mean = mean_fragment_area(peak_pressure).expect("a pressure is at least 0");
    if !material::FRAGMENT_PRESSURES.contains(&peak_pressure) && peak_pressure > 0.0 {
        warnings.push(format!(
            "the peak pressure on it is {peak_pressure:.3e} Pa; fragments were measured from 690 Pa to 689 kPa, and \
             the formula for their size (2.45) is used beyond"
        ));
    }
    if mean.is_floor() {
        warnings.push(format!(
            "at {peak_pressure:.3e} Pa the formula for the size of fragments (2.45) falls below a square millimetre, \
             which is used instead"
        ));
    }
    ((window.outline.area() / mean.area) as usize).max(2)
}

/// Where a pane fails: drawn by the risk that a flaw there gives way first, the stress to the power of
/// [`FLAW_EXPONENT`] (Weibull 1939).
fn origin(plate: &Plate, window: &Window) -> DVec2 {
    let risk = |stress: f64| libm::pow(stress / plate.strongest(), FLAW_EXPONENT);
    let draw = |key| random::unit(window.recipe.seed ^ ORIGINS, 0, key);
    let total: f64 = plate.stresses().map(|(_, stress)| risk(stress)).sum();
    let mut left = draw(0) * total;
    let chosen = plate.stresses().find(|&(_, stress)| {
        left -= risk(stress);
        left <= 0.0
    });
    let (node, _) = chosen.unwrap_or_else(|| plate.stresses().last().expect("a pane has nodes"));
    // Anywhere in the node's cell, unless that is outside the pane.
    let place = node + plate.spacing() * (DVec2::new(draw(1), draw(2)) - 0.5);
    let room = 0.25 * plate.spacing().min_element();
    let inside =
        |at: DVec2| outline::contains(&window.outline, at) && outline::clearance(&window.outline, at) > room;
    if inside(place) { place } else { node }
}

/// A window as one body.
fn whole(window: &Window) -> Body {
    let moments = window.outline.moments();
    let mass = moments.prism(window.thickness, window.material.density);
    let mut outline = Polygon::default();
    for ring in window.outline.rings() {
        outline.push_ring(ring.iter().map(|&p| p - moments.centroid));
    }
    let samples = samples(&window.outline)
        .into_iter()
        .map(|s| Sample { centre: s.centre - moments.centroid, ..s })
        .collect();
    Body {
        anchored: true,
        ..body(
            window,
            moments.centroid,
            mass.mass,
            Flat { outline, thickness: window.thickness, samples, inertia: mass.inertia * (1.0 / mass.mass) },
        )
    }
}

/// A fragment as a body.
fn piece(window: &Window, pane: &Pane, index: usize, hold: &Hold) -> Body {
    let (mass, centre) = (pane.pieces.masses[index], pane.pieces.moments[index].centroid);
    let mut cut = Polygon::default();
    pane.grown.pattern.fragment(index).outline(&mut cut);
    let mut outline = Polygon::default();
    for ring in cut.rings() {
        outline.push_ring(ring.iter().map(|&p| p - centre));
    }
    Body {
        hold: Some(hold.clone()),
        ..body(
            window,
            centre,
            mass.mass,
            Flat {
                outline,
                thickness: window.thickness,
                samples: pane.pieces.samples(index).to_vec(),
                inertia: mass.inertia * (1.0 / mass.mass),
            },
        )
    }
}

fn body(window: &Window, centre: DVec2, mass: f64, flat: Flat) -> Body {
    Body {
        shape: Shape::Flat(Arc::new(flat)),
        position: window.position + window.orientation * centre.extend(0.0),
        orientation: window.orientation,
        mass,
        assembly: window.assembly,
        anchored: false,
        occludes: window.occludes,
        can_rotate: window.can_rotate,
        friction: window.friction,
        drag_coefficient: window.drag_coefficient,
        lift_coefficient: window.lift_coefficient,
        surround: window.facade,
        hold: None,
    }
}

/// Panels of a whole pane in its own frame: the cells of a grid whose middle lies in it, with equal parts of its area.
fn samples(outline: &Polygon) -> Vec<Sample> {
    let (low, high) = bounds(outline.points().iter().copied());
    let size = high - low;
    let cell = size.max_element() / PANELS as f64;
    let count = (size / cell).round().max(DVec2::splat(2.0));
    let mut samples: Vec<Sample> = (0..count.y as usize)
        .flat_map(|row| (0..count.x as usize).map(move |column| DVec2::new(column as f64, row as f64)))
        .map(|place| low + (place + 0.5) / count * size)
        .filter(|&middle| outline::contains(outline, middle))
        .map(|centre| Sample { centre, area: 0.0 })
        .collect();
    if samples.is_empty() {
        samples.push(Sample { centre: outline.moments().centroid, area: 0.0 });
    }
    let area = outline.area() / samples.len() as f64;
    samples.iter_mut().for_each(|sample| sample.area = area);
    samples
}

/// Number of the sample nearest to a place.
fn nearest(samples: &[Sample], place: DVec2) -> usize {
    let far = |i: &usize| samples[*i].centre.distance_squared(place);
    (0..samples.len()).min_by(|a, b| far(a).total_cmp(&far(b))).expect("a pane has panels")
}
