//! What shelters behind what: the propagation model (thesis chapter 4).
//!
//! The charge is the eye. [`SphereMap`] is the sphere around it, cut into pixels; `raster` finds which pixels a
//! body covers, and how far away; `mask` joins what stands together into groups and finds their rims; `reading`
//! collects, for each body, the groups in front of it, and reads three numbers:
//!
//! - **b**, the blocking factor: the mean over the body's own pixels of a value that is 0 where nothing is in
//!   front and otherwise the distance from there to the rim of all that is in front, in the thesis's pixels, and a
//!   half (the count of Fig. 4.4 without its grid: see [`ring_values`]);
//! - **k**, the separation: the gap from the rear of the closest occluder to the front of the body, over the
//!   distance from the charge to there, over the hidden pixels together;
//! - the **detour**: how much longer the way round the rim is than the straight one.
//!
//! [`Attenuation`] makes of b and k the share of the load that comes through (4.1, Fig. 4.5).
//!
//! Guarantees: a body with nothing in front has a share of exactly 1; the same bits for any number of threads;
//! memory in proportion to the pixels that are covered. Turning the whole scene changes b and k by the error of
//! the pixels, which falls with the resolution.
//!
//! What it does not know: the ground hides nothing (it only closes the foot of what stands on it), a wave is not
//! weakened by what it goes round twice, and nothing is reflected.

mod attenuation;
mod mask;
mod raster;
mod reading;
mod rings;
mod solid;
mod sphere_map;

use glam::DVec3;
use rayon::prelude::*;

pub use attenuation::Attenuation;
pub use rings::ring_values;
pub use solid::{Form, Solid, SurfacePoint};
pub use sphere_map::{EDGE_ANGLE, PixelPlace, SphereMap, THESIS_RESOLUTION};

use crate::error::{Error, Result};
use mask::Mask;
use raster::{Hit, hits};
use reading::{Columns, Reader};
use solid::View;

/// How shelter is found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Whether bodies shelter one another.
    pub enabled: bool,
    /// Pixels along an edge of the icosahedron, 4 to 512.
    pub resolution: usize,
    /// Whether a body has one share of the load or each of its panels its own.
    pub per: Per,
    /// The attenuation's parameters.
    pub attenuation: Attenuation,
}

/// For what a share of the load is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Per {
    /// One for a body, as in the thesis.
    #[default]
    Body,
    /// One for each of its panels, read at the panel's centre.
    Panel,
}

impl Default for Settings {
    fn default() -> Self {
        Self { enabled: true, resolution: 32, per: Per::Body, attenuation: Attenuation::THESIS }
    }
}

impl Settings {
    /// Checks resolution and parameters.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for the first number that has no meaning.
    pub fn validate(&self) -> Result<()> {
        SphereMap::check_resolution(self.resolution)?;
        self.attenuation.validate()
    }
}

/// How one body, or one panel, is sheltered from one charge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shelter {
    /// Share of what the charge sees of it, were it alone, that something hides.
    pub hidden: f64,
    /// Blocking factor b, in the thesis's pixels.
    pub blocking: f64,
    /// Separation k; 0 where nothing is in front.
    pub separation: f64,
    /// Share f of the load that it receives.
    pub attenuation: f64,
    /// How much longer the wave's way is than the straight one [m].
    pub detour: f64,
}

impl Shelter {
    /// Nothing in front.
    pub const NONE: Self =
        Self { hidden: 0.0, blocking: 0.0, separation: 0.0, attenuation: 1.0, detour: 0.0 };
}

/// What one charge sees.
#[derive(Debug, Clone)]
pub struct Sheltered {
    /// One a body, in order.
    pub bodies: Vec<Shelter>,
    /// With [`Per::Panel`], or for a solid read [by point](Solid::by_point), one a surface point of each body, in order;
    /// else none.
    pub panels: Vec<Vec<Shelter>>,
    /// Share of the directions into the open, those not into the ground, in which a body stands.
    pub enclosed: f64,
}

/// Finds how each of `solids` is sheltered from a charge at `eye` by the others. `ground` is the height of a level
/// plane below everything, if there is one.
///
/// # Errors
/// [`Error::OutOfRange`] for settings out of range; [`Error::Malformed`] where the charge lies in or on a solid that
/// occludes.
pub fn shelter(solids: &[Solid], eye: DVec3, ground: Option<f64>, settings: &Settings) -> Result<Sheltered> {
    settings.validate()?;
    let open = |solid: &Solid| match settings.per {
        Per::Body if !solid.by_point => Vec::new(),
        _ => vec![Shelter::NONE; solid.points.len()],
    };
    let views: Vec<View> = solids.par_iter().map(|solid| View::new(&solid.form, eye)).collect();
    refuse_inside(solids, &views)?;
    if !can_matter(solids, &views) {
        return Ok(Sheltered {
            bodies: vec![Shelter::NONE; solids.len()],
            panels: solids.iter().map(open).collect(),
            enclosed: 0.0,
        });
    }
    let map = SphereMap::new(settings.resolution)?;
    let seen: Vec<Vec<Hit>> = views.par_iter().map(|view| hits(&map, view)).collect();
    let groups = Groups::new(solids);
    let masks = groups.masks(&map, &views, &seen, ground.map_or(f64::NEG_INFINITY, |height| height - eye.y));
    let columns = Columns::new(&map, &masks);
    let enclosed = columns.enclosed(&map, ground.is_some_and(|height| eye.y >= height));
    let reader = Reader {
        map: &map,
        columns: &columns,
        masks: &masks,
        views: &views,
        occluders: &groups.occluders,
        eye,
        settings,
    };
    let read: Vec<(Shelter, Vec<Shelter>)> = (0..solids.len())
        .into_par_iter()
        .map_init(
            || reader.desk(),
            |desk, body| reader.read(desk, &solids[body], &views[body], &seen[body], groups.of[body]),
        )
        .collect();
    let (bodies, panels) = read.into_iter().unzip();
    Ok(Sheltered { bodies, panels, enclosed })
}

/// The nearest body on each pixel and its distance [m]: what a charge at `eye` sees.
///
/// # Errors
/// As [`shelter`].
pub fn first_seen(solids: &[Solid], eye: DVec3, resolution: usize) -> Result<Vec<Option<(usize, f64)>>> {
    let map = SphereMap::new(resolution)?;
    let views: Vec<View> = solids.par_iter().map(|solid| View::new(&solid.form, eye)).collect();
    refuse_inside(solids, &views)?;
    let mut first: Vec<Option<(usize, f64)>> = vec![None; map.len()];
    for (body, view) in views.iter().enumerate() {
        for hit in hits(&map, view) {
            let place = &mut first[hit.pixel as usize];
            if place.is_none_or(|(_, distance)| f64::from(hit.near) < distance) {
                *place = Some((body, f64::from(hit.near)));
            }
        }
    }
    Ok(first)
}

/// Bodies by the group they stand in.
struct Groups {
    /// Number of each body's group.
    of: Vec<u32>,
    /// Bodies of each group that hide what is behind them.
    occluders: Vec<Vec<usize>>,
}

impl Groups {
    fn new(solids: &[Solid]) -> Self {
        let mut names: Vec<u32> = solids.iter().map(|solid| solid.group).collect();
        names.sort_unstable();
        names.dedup();
        let of: Vec<u32> = solids
            .iter()
            .map(|solid| names.binary_search(&solid.group).expect("every group has a name") as u32)
            .collect();
        let mut occluders = vec![Vec::new(); names.len()];
        for body in (0..solids.len()).filter(|&body| solids[body].occludes) {
            occluders[of[body] as usize].push(body);
        }
        Self { of, occluders }
    }

    fn masks(&self, map: &SphereMap, views: &[View], seen: &[Vec<Hit>], ground: f64) -> Vec<Mask> {
        self.occluders
            .par_iter()
            .map(|members| {
                if members.is_empty() {
                    return Mask::default();
                }
                let own: Vec<&View> = members.iter().map(|&body| &views[body]).collect();
                let hits: Vec<&[Hit]> = members.iter().map(|&body| &seen[body][..]).collect();
                Mask::new(map, &own, &hits, ground)
            })
            .collect()
    }
}

/// Whether anything could be hidden, or the charge enclosed: not where all bodies stand together around nothing.
fn can_matter(solids: &[Solid], views: &[View]) -> bool {
    let Some(first) = solids.first() else { return false };
    let around = |view: &View| view.middle.length() <= view.radius;
    solids.iter().any(|solid| solid.group != first.group) && solids.iter().any(|solid| solid.occludes)
        || solids.iter().zip(views).any(|(solid, view)| solid.occludes && around(view))
}

fn refuse_inside(solids: &[Solid], views: &[View]) -> Result<()> {
    let holding = solids.iter().zip(views).position(|(solid, view)| solid.occludes && view.holds_eye());
    holding.map_or(Ok(()), |body| {
        Err(Error::Malformed(format!(
            "a charge lies in or on body {body}, which would shelter everything from it: move one of them, or let \
             the body not occlude"
        )))
    })
}
