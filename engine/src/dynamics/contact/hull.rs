//! Convex hulls for Box3D, from points that its builder is sure to cope with.
//!
//! The builder works in single precision with a tolerance of rounding. It does not come to an end on some sets of points
//! that nearly lie in a plane. So points are stretched to a cube and snapped to a grid, where whole numbers tell exactly
//! whether four points lie in a plane; the grid is made coarser until no point lies off a face of the hull by so little
//! that rounding could hide it. The hull is built there and scaled back.
//!
//! The cube's edges are the axes of the body, or those of the points where these lie slantwise. In a slanting cube a thin
//! plate would have faces on both sides that meet at almost no angle, and then Box3D finds it apart from what it is in.

use boxddd::{Hull, Transform, Vec3};
use glam::{DMat3, DQuat, DVec3};

use super::{foundation, quaternion, single};
use crate::geometry::bounds;

/// Half the edge of the cube in which hulls are built, in Box3D's units of length. Box3D scales shapes by no less than
/// 0.01, so that bodies of a tenth of a millimetre come out right.
const CUBE: f64 = 0.01;
/// Grid steps along half the cube, the finest first. On the last one a point that does not lie in the plane of three
/// others is off it by 3e-5 of half the cube or more; the builder takes 6e-6 for nothing.
const GRIDS: [i32; 6] = [2048, 1024, 512, 256, 64, 16];
/// A point off a face by less than this could be taken for one in it [half the cube].
const DOUBT: f64 = 2e-5;
/// Points that reach less far from a plane are as good as flat [half the cube].
const FLAT: f64 = 0.02;
/// Points lie slantwise where a box along their own axes has less than this part of the volume of the one about them.
const SLANT: f64 = 0.5;
/// Most corners of a hull; Box3D holds 128 edges.
pub const MOST_POINTS: usize = 42;

/// Half the thickness below which a body counts as one of that thickness [m]; contacts miss what is much thinner.
pub const THINNEST: f64 = 2.5e-4;

/// A hull in the cube, and how it comes to its place: scaled, then turned and moved.
pub struct PlacedHull {
    /// The hull in the cube.
    pub hull: Hull,
    /// Where the cube's middle lies [m], and how the cube is turned.
    pub place: Transform,
    /// By how much each axis is scaled.
    pub scale: Vec3,
    /// Volume in its place [m³].
    pub volume: f64,
    /// Its corners in their places [m], and perhaps points within it; at most [`MOST_POINTS`].
    pub corners: Vec<DVec3>,
}

/// The hull of points [m]; `None` where they lie in a plane, or nearly, or are not numbers.
pub fn hull_of(points: &[DVec3]) -> Option<PlacedHull> {
    // `min` and `max` pass over what is not a number.
    if !points.iter().all(|p| p.is_finite()) {
        return None;
    }
    let axes = slant(points);
    let points = along(axes.unwrap_or(DMat3::IDENTITY), points);
    let (low, high) = bounds(points.iter().copied());
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    // Turned in single precision, what is thinner than some part of its extent is crumpled.
    let crumpled = THINNEST.max(1e-5 * low.abs().max(high.abs()).length());
    if half.min_element() < if axes.is_some() { crumpled } else { 0.04 * THINNEST } {
        return None;
    }
    let (chosen, grid) = GRIDS.into_iter().find_map(|grid| {
        let chosen = snapped(&points, middle, half, grid);
        (grid == GRIDS[GRIDS.len() - 1] || !in_doubt(&chosen, grid)).then_some((chosen, grid))
    })?;
    let to_cube = |c: i32| (f64::from(c) * CUBE / f64::from(grid)) as f32;
    let corners: Vec<Vec3> =
        chosen.iter().map(|p| Vec3::new(to_cube(p[0]), to_cube(p[1]), to_cube(p[2]))).collect();
    if is_flat(&chosen, grid) {
        return None;
    }
    // Box3D builds nothing before it is set up.
    foundation();
    let hull = Hull::from_points(&corners, MOST_POINTS as i32).ok()?;
    let scale = half / CUBE;
    let part = f64::from(hull.as_hull_data().volume) / (8.0 * CUBE * CUBE * CUBE);
    if part.is_nan() || part <= 0.0 {
        return None;
    }
    let volume = part * 8.0 * half.x * half.y * half.z;
    let turn = axes.map_or(DQuat::IDENTITY, |axes| DQuat::from_mat3(&axes));
    let in_place = |&[x, y, z]: &[i32; 3]| {
        turn * (middle + half * DVec3::new(x.into(), y.into(), z.into()) / f64::from(grid))
    };
    let places = chosen.iter().map(in_place).collect();
    let place = Transform::new(single(turn * middle), quaternion(turn));
    let scale = single(scale);
    // Single precision may leave nothing of what is small and far from the centre of mass.
    hull.clone_transformed(place, scale).ok()?;
    Some(PlacedHull { hull, place, scale, volume, corners: places })
}

/// The own axes of points [m] that lie slantwise.
fn slant(points: &[DVec3]) -> Option<DMat3> {
    let volume = |points: &[DVec3]| {
        let (low, high) = bounds(points.iter().copied());
        (high - low).element_product()
    };
    own_axes(points).filter(|&axes| volume(&along(axes, points)) < SLANT * volume(points))
}

/// Points as they are along some axes.
fn along(axes: DMat3, points: &[DVec3]) -> Vec<DVec3> {
    let inverse = axes.transpose();
    points.iter().map(|&p| inverse * p).collect()
}

/// The axes of points: from end to end of them, and across the plane through the ends and the point farthest from both.
/// `None` where they lie on a line.
fn own_axes(points: &[DVec3]) -> Option<DMat3> {
    let farthest =
        |far: &dyn Fn(DVec3) -> f64| points.iter().copied().max_by(|&a, &b| far(a).total_cmp(&far(b)));
    let &any = points.first()?;
    let a = farthest(&|p| p.distance_squared(any))?;
    let b = farthest(&|p| p.distance_squared(a))?;
    let x = (b - a).try_normalize()?;
    let c = farthest(&|p| (p - a).cross(x).length_squared())?;
    let z = x.cross(c - a).try_normalize()?;
    Some(DMat3::from_cols(x, z.cross(x), z))
}

/// Points on a grid, each once and at most [`MOST_POINTS`] of them.
fn snapped(points: &[DVec3], middle: DVec3, half: DVec3, grid: i32) -> Vec<[i32; 3]> {
    let on_grid =
        |p: &DVec3| ((*p - middle) / half * f64::from(grid)).to_array().map(|c| libm::rint(c) as i32);
    let mut all: Vec<[i32; 3]> = points.iter().map(on_grid).collect();
    all.sort_unstable();
    all.dedup();
    if all.len() > MOST_POINTS { outermost(&all) } else { all }
}

/// Twice the area of a triangle times the normal of its plane.
fn normal(a: [i32; 3], b: [i32; 3], c: [i32; 3]) -> [i64; 3] {
    let less = |p: [i32; 3]| [0, 1, 2].map(|k| i64::from(p[k] - a[k]));
    let (u, v) = (less(b), less(c));
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

/// How far a point lies off the plane through `from`, times the length of the normal. Exact.
fn off(normal: [i64; 3], from: [i32; 3], point: [i32; 3]) -> i64 {
    (0..3).map(|k| normal[k] * i64::from(point[k] - from[k])).sum()
}

/// Whether some point is so little off a face of the hull that rounding could hide it.
fn in_doubt(points: &[[i32; 3]], grid: i32) -> bool {
    let triples = (0..points.len())
        .flat_map(|i| (i + 1..points.len()).flat_map(move |j| (j + 1..points.len()).map(move |k| (i, j, k))));
    triples.into_iter().any(|(i, j, k)| {
        let normal = normal(points[i], points[j], points[k]);
        let length = libm::sqrt(normal.iter().map(|&c| c as f64 * c as f64).sum());
        let doubt = (DOUBT * f64::from(grid) * length) as i64;
        let (mut above, mut below, mut doubtful) = (false, false, false);
        for &point in points {
            let off = off(normal, points[i], point);
            above |= off > doubt;
            below |= off < -doubt;
            doubtful |= off != 0 && off.abs() <= doubt;
            if above && below {
                return false;
            }
        }
        doubtful
    })
}

/// Whether points in the cube lie in a plane or on a line, or nearly: how far they reach from the plane through the two
/// that are farthest apart and the one farthest from those.
fn is_flat(points: &[[i32; 3]], grid: i32) -> bool {
    let farthest =
        |far: &dyn Fn([i32; 3]) -> f64| points.iter().copied().max_by(|&a, &b| far(a).total_cmp(&far(b)));
    let length = |v: [i64; 3]| libm::sqrt(v.iter().map(|&c| c as f64 * c as f64).sum());
    let apart = |a: [i32; 3], b: [i32; 3]| length([0, 1, 2].map(|k| i64::from(a[k] - b[k])));
    let ends = points.first().and_then(|&any| {
        let a = farthest(&|p| apart(any, p))?;
        Some((a, farthest(&|p| apart(a, p))?))
    });
    let Some((a, b)) = ends else { return true };
    let Some(c) = farthest(&|p| length(normal(a, b, p))) else { return true };
    let normal = normal(a, b, c);
    let reach = points.iter().map(|&p| off(normal, a, p).unsigned_abs()).max().unwrap_or(0) as f64;
    reach <= FLAT * f64::from(grid) * length(normal)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::box_corners;

    /// The corners of a box with these half edges, turned.
    fn corners(half: DVec3, turn: DQuat) -> Vec<DVec3> {
        box_corners(-half, half).map(|corner| turn * corner).to_vec()
    }

    /// A thin plate has its own volume, not that of the box about it, however it lies; so has a needle.
    #[test]
    fn what_lies_slantwise_keeps_its_shape() {
        for half in [DVec3::new(0.3, 0.2, 0.003), DVec3::new(0.003, 0.4, 0.004), DVec3::new(0.1, 0.2, 0.15)] {
            for turn in [
                DQuat::IDENTITY,
                DQuat::from_rotation_x(0.7),
                DQuat::from_euler(glam::EulerRot::XYZ, 0.5, 1.0, 2.0),
            ] {
                let hull = hull_of(&corners(half, turn)).unwrap();
                let volume = 8.0 * half.element_product();
                // The coarsest grid has sixteen steps to half the extent.
                assert!((hull.volume / volume - 1.0).abs() < 0.13, "{half} {turn}: {} {volume}", hull.volume);
            }
        }
    }

    /// Half a millimetre a kilometre from the centre of mass is nothing in single precision.
    #[test]
    fn what_single_precision_cannot_hold_has_no_hull() {
        let far = DVec3::new(700.0, 600.0, 500.0);
        let turn = DQuat::from_rotation_x(0.7);
        let plate: Vec<DVec3> =
            corners(DVec3::new(0.3, 0.2, 3e-4), turn).into_iter().map(|p| p + far).collect();
        assert!(hull_of(&plate).is_none());
    }
}
