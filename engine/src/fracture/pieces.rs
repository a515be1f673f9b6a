//! Fragments as solid pieces: closed meshes, mass, inertia and the panels on which the blast acts.

use rayon::prelude::*;

use super::pattern::Pattern;
use crate::error::{Result, positive};
use crate::geometry::{
    MassProperties, PieceMeshes, PlaneMoments, Polygon, Sample, Triangulator, sample_panels,
};

/// All pieces of a pattern, in the order of its fragments.
#[derive(Debug, Default)]
pub struct Pieces {
    /// Closed meshes, each about its own centroid.
    pub meshes: PieceMeshes,
    /// Area, centroid in the pane and second moments of each face.
    pub moments: Vec<PlaneMoments>,
    /// Mass, centre of mass in the pane and inertia about it.
    pub masses: Vec<MassProperties>,
    samples: Vec<Sample>,
    sample_ends: Vec<u32>,
}

/// Pieces that are worked on at a time: enough to be worth a thread's while.
const CHUNK: usize = 256;
/// Chunks for each thread before they are put together.
const CHUNKS_EACH: usize = 4;

/// What working on a piece needs again and again.
#[derive(Default)]
struct Scratch {
    polygon: Polygon,
    triangulator: Triangulator,
    triangles: Vec<[u32; 3]>,
}

impl Pieces {
    /// Makes solid pieces of all fragments. `thickness` [m] and `density` [kg/m³] above 0. In parallel; the result
    /// is the same for any number of threads.
    ///
    /// # Errors
    /// [`Error::OutOfRange`](crate::Error::OutOfRange) for a thickness or density that is not above 0.
    pub fn of(pattern: &Pattern, thickness: f64, density: f64) -> Result<Self> {
        positive("thickness of the pane [m]", thickness)?;
        positive("density of the pane [kg/m³]", density)?;
        let starts: Vec<usize> = (0..pattern.len()).step_by(CHUNK).collect();
        let mut whole = Self::default();
        // A few parts at a time: they are still in the cache when they are put together, and use the same memory.
        for batch in starts.chunks(CHUNKS_EACH * rayon::current_num_threads()) {
            let parts: Vec<Self> = batch
                .into_par_iter()
                .map_init(Scratch::default, |scratch, &start| {
                    let mut part = Self::default();
                    for index in start..(start + CHUNK).min(pattern.len()) {
                        pattern.fragment(index).outline(&mut scratch.polygon);
                        part.push(scratch, thickness, density)?;
                    }
                    Ok(part)
                })
                .collect::<Result<_>>()?;
            parts.into_iter().for_each(|part| whole.append(part));
        }
        Ok(whole)
    }

    /// How many pieces there are.
    pub fn len(&self) -> usize {
        self.moments.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.moments.is_empty()
    }

    /// Panels of one piece's face: at least five, from its centroid.
    pub fn samples(&self, index: usize) -> &[Sample] {
        let start = if index == 0 { 0 } else { self.sample_ends[index - 1] as usize };
        &self.samples[start..self.sample_ends[index] as usize]
    }

    /// What the arrays hold, in bytes, without spare room.
    pub fn bytes(&self) -> usize {
        self.meshes.bytes()
            + size_of_val(&self.moments[..])
            + size_of_val(&self.masses[..])
            + size_of_val(&self.samples[..])
            + size_of_val(&self.sample_ends[..])
    }

    fn push(&mut self, scratch: &mut Scratch, thickness: f64, density: f64) -> Result<()> {
        let moments = scratch.polygon.moments();
        scratch.triangulator.triangulate(&scratch.polygon, &mut scratch.triangles)?;
        self.meshes.push_prism(&scratch.polygon, &scratch.triangles, moments.centroid, thickness);
        sample_panels(&scratch.polygon, &moments, &mut self.samples);
        self.sample_ends.push(self.samples.len() as u32);
        self.masses.push(moments.prism(thickness, density));
        self.moments.push(moments);
        Ok(())
    }

    fn append(&mut self, other: Self) {
        let before = self.samples.len() as u32;
        self.meshes.append(&other.meshes);
        self.moments.extend(other.moments);
        self.masses.extend(other.masses);
        self.samples.extend(other.samples);
        self.sample_ends.extend(other.sample_ends.iter().map(|end| end + before));
    }
}
