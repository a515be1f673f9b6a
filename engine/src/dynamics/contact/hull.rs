//! Convex hulls for Box3D, from points that its builder is sure to cope with.
//!
//! The builder works in single precision with a tolerance of rounding, and does not come to an end on some sets of
//! points that nearly lie in a plane, such as a thin shard's. So points are first stretched to a cube, snapped to a grid
//! and thinned out; the hull is built there and then scaled back.

use boxddd::{Hull, Transform, Vec3};
use glam::DVec3;

/// Half the edge of the cube in which hulls are built, in Box3D's units of length. Box3D scales shapes by no less than
/// 0.01, so that bodies of a tenth of a millimetre come out right.
const CUBE: f64 = 0.01;
/// Grid steps along half the cube.
const GRID: f64 = 2048.0;
/// Most corners of a hull; Box3D holds 128 edges.
pub const MOST_POINTS: usize = 42;

/// A hull in the cube, and how it comes to its place: scaled, then moved.
pub struct PlacedHull {
    /// The hull in the cube.
    pub hull: Hull,
    /// Where the cube's middle lies [m].
    pub place: Transform,
    /// By how much each axis is scaled.
    pub scale: Vec3,
    /// Volume in its place [m³].
    pub volume: f64,
}

/// The hull of points [m]; `None` where they lie in a plane, or nearly.
pub fn hull_of(points: &[DVec3]) -> Option<PlacedHull> {
    let (low, high) = points
        .iter()
        .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), &p| (low.min(p), high.max(p)));
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    if !half.is_finite() || half.min_element() <= 1e-5 * half.max_element().max(1e-3) {
        return None;
    }
    let snapped: Vec<[i32; 3]> = {
        let on_grid = |p: &DVec3| ((*p - middle) / half * GRID).to_array().map(|c| libm::rint(c) as i32);
        let mut all: Vec<[i32; 3]> = points.iter().map(on_grid).collect();
        all.sort_unstable();
        all.dedup();
        all
    };
    let chosen = if snapped.len() > MOST_POINTS { outermost(&snapped) } else { snapped };
    let to_cube = |c: i32| (f64::from(c) * CUBE / GRID) as f32;
    let corners: Vec<Vec3> =
        chosen.iter().map(|p| Vec3::new(to_cube(p[0]), to_cube(p[1]), to_cube(p[2]))).collect();
    let hull = Hull::from_points(&corners, MOST_POINTS as i32).ok()?;
    let scale = half / CUBE;
    let volume = f64::from(hull.as_hull_data().volume) * scale.x * scale.y * scale.z;
    let place =
        Transform::new(Vec3::new(middle.x as f32, middle.y as f32, middle.z as f32), boxddd::Quat::IDENTITY);
    let scale = Vec3::new(scale.x as f32, scale.y as f32, scale.z as f32);
    Some(PlacedHull { hull, place, scale, volume })
}

/// The points farthest out along [`MOST_POINTS`] directions spread evenly (a Fibonacci lattice), each once.
fn outermost(points: &[[i32; 3]]) -> Vec<[i32; 3]> {
    const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;
    let mut chosen = Vec::with_capacity(MOST_POINTS);
    for k in 0..MOST_POINTS {
        let y = 1.0 - (2.0 * k as f64 + 1.0) / MOST_POINTS as f64;
        let radius = libm::sqrt(1.0 - y * y);
        let angle = GOLDEN_ANGLE * k as f64;
        let direction = [radius * libm::cos(angle), y, radius * libm::sin(angle)];
        let along = |p: &[i32; 3]| (0..3).map(|i| direction[i] * f64::from(p[i])).sum::<f64>();
        let farthest = points.iter().max_by(|a, b| along(a).total_cmp(&along(b))).expect("there are points");
        if !chosen.contains(farthest) {
            chosen.push(*farthest);
        }
    }
    chosen
}
