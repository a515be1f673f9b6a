//! What a body is to collision detection: a box, or convex hulls.
//!
//! - A box is itself.
//! - A flat piece is cut into convex parts that reach beyond its outline by at most [`POCKET`]; then the sides of every
//!   part are moved inward by [`MARGIN`], so that neighbours that touch when they are freed do not push each other.
//! - A mesh is cut by planes into cells, where that brings the hulls of what is in them nearer to its volume.

use glam::{DMat3, DQuat, DVec2, DVec3};

use super::cells::mesh_hulls;
use super::hull::THINNEST;
use crate::geometry::{Polygon, TriangleMesh, Triangulator, bounds, convex_parts, simplified};

/// Deepest pocket of a flat piece that its collision shape may fill: this part of its smaller half extent, and at
/// least [`SHALLOW`] [m].
pub const POCKET: f64 = 0.05;
/// See [`POCKET`] [m].
pub const SHALLOW: f64 = 5e-4;
/// Corners of a part's outline that stand out by less than this are left out [m].
const BLUNT: f64 = 1e-4;
/// By so much the sides of a flat piece's parts lie within it [m].
pub const MARGIN: f64 = 1.5e-4;
/// By so much at most their corners do [m].
const TIP: f64 = 5e-4;
/// Most corners of a part's outline.
const MOST_CORNERS: usize = 20;
/// A part narrower than this is left out where there are others [m].
const SLIVER: f64 = 2e-4;

/// A body's shape for collision detection, in its principal axes about its centre of mass.
#[derive(Debug, Clone, PartialEq)]
pub enum CollisionShape {
    /// A box with these half edges [m].
    Box(DVec3),
    /// The convex hulls of these points [m].
    Hulls(Vec<Vec<DVec3>>),
}

impl CollisionShape {
    /// The corner with the lowest and the one with the highest coordinates [m]; the origin twice where there are none.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        match self {
            Self::Box(half) => (-*half, *half),
            Self::Hulls(hulls) if hulls.iter().all(Vec::is_empty) => (DVec3::ZERO, DVec3::ZERO),
            Self::Hulls(hulls) => bounds(hulls.iter().flatten().copied()),
        }
    }

    /// Distance of its farthest corner from the centre of mass [m]; infinite or not a number where a corner is.
    pub fn reach(&self) -> f64 {
        let farthest = |so_far: f64, p: &DVec3| if p.length() <= so_far { so_far } else { p.length() };
        match self {
            Self::Box(half) => half.length(),
            Self::Hulls(hulls) => hulls.iter().flatten().fold(0.0, farthest),
        }
    }

    /// The points of its convex parts [m]; none of a box, and of what is so thin that it counts as one.
    pub fn parts(&self) -> &[Vec<DVec3>] {
        let (low, high) = self.bounds();
        let thin = 0.5 * (high - low).min_element() < THINNEST;
        match self {
            Self::Hulls(hulls) if !thin => hulls,
            _ => &[],
        }
    }

    /// Middle and half edges of the box that it is where it has no parts [m].
    pub fn slab(&self) -> (DVec3, DVec3) {
        let (low, high) = self.bounds();
        (0.5 * (low + high), (0.5 * (high - low)).max(DVec3::splat(THINNEST)))
    }

    /// A box with edges `size` [m] in the body's own frame.
    pub fn of_box(size: DVec3, object_from_principal: DQuat) -> Self {
        Self::Box((object_from_principal.conjugate() * size).abs() * 0.5)
    }

    /// A flat piece: its outline [m] about the centre of mass in its own plane z = 0, and its thickness [m].
    ///
    /// An outline that cannot be cut into triangles, which a pane's pieces never have, counts as its hull.
    pub fn of_flat(outline: &Polygon, thickness: f64, object_from_principal: DQuat) -> Self {
        let into_principal = DMat3::from_quat(object_from_principal.conjugate());
        let solid = |ring: Vec<DVec2>| -> Vec<DVec3> {
            let faces = [0.5 * thickness, -0.5 * thickness];
            faces.iter().flat_map(|&z| ring.iter().map(move |p| into_principal * p.extend(z))).collect()
        };
        Self::Hulls(flat_parts(outline).into_iter().map(solid).collect())
    }

    /// A closed mesh of this volume [m³], with its centre of mass [m] in its own frame.
    pub fn of_mesh(mesh: &TriangleMesh, volume: f64, centre: DVec3, object_from_principal: DQuat) -> Self {
        let into_principal = object_from_principal.conjugate();
        let mut hulls = mesh_hulls(mesh, volume);
        hulls.iter_mut().flatten().for_each(|p| *p = into_principal * (*p - centre));
        Self::Hulls(hulls)
    }
}

/// The outlines of a flat piece's parts.
fn flat_parts(outline: &Polygon) -> Vec<Vec<DVec2>> {
    let (low, high) = bounds(outline.points().iter().copied());
    let tolerance = SHALLOW.max(POCKET * 0.5 * (high - low).min_element());
    let mut triangles = Vec::new();
    let parts = match Triangulator::default().triangulate(outline, &mut triangles) {
        Ok(()) => convex_parts(outline, &triangles, tolerance),
        Err(_) => convex_parts(outline, &[], f64::INFINITY),
    };
    let mut parts: Vec<Vec<DVec2>> =
        parts.into_iter().flat_map(|ring| halved(simplified(ring, BLUNT))).collect();
    let widest = parts.iter().map(|ring| width(ring)).fold(0.0, f64::max);
    parts.retain(|ring| width(ring) >= SLIVER.min(widest));
    parts.into_iter().map(shrunk).collect()
}

/// The smallest distance between two parallels that enclose a convex ring [m].
fn width(ring: &[DVec2]) -> f64 {
    let across = |i: usize| {
        let (from, along) = (ring[i], ring[(i + 1) % ring.len()] - ring[i]);
        ring.iter().map(|&p| along.perp_dot(p - from)).fold(0.0, f64::max) / along.length()
    };
    (0..ring.len()).map(across).fold(f64::INFINITY, f64::min)
}

/// A convex ring cut across until no part has more than [`MOST_CORNERS`] corners.
fn halved(ring: Vec<DVec2>) -> Vec<Vec<DVec2>> {
    if ring.len() <= MOST_CORNERS {
        return vec![ring];
    }
    let middle = ring.len() / 2;
    let (one, other) = (ring[..=middle].to_vec(), [&ring[middle..], &ring[..1]].concat());
    [one, other].into_iter().flat_map(halved).collect()
}

/// A convex ring with its sides moved inward by [`MARGIN`], or by an eighth of its width where that is less. No corner
/// moves by more than [`TIP`], so that points stay nearly as long as they are.
fn shrunk(ring: Vec<DVec2>) -> Vec<DVec2> {
    let margin = MARGIN.min(width(&ring) / 8.0);
    let count = ring.len();
    let moved = |i: usize| {
        let [before, at, after] = [ring[(i + count - 1) % count], ring[i], ring[(i + 1) % count]];
        let (into, out) = ((at - before).normalize(), (after - at).normalize());
        // Along both normals by the margin: the corner of the ring inside.
        let shift = (into.perp() + out.perp()) * (margin / (1.0 + into.dot(out)).max(1e-9));
        at + shift.clamp_length_max(TIP)
    };
    (0..count).map(moved).collect()
}
