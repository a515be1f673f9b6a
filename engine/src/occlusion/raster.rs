//! Which pixels a body covers, and how far away.
//!
//! A pixel is covered when the ray from the charge through its centre meets the body. This is exact where a ray
//! is, two bodies that stand side by side never share a pixel's ray, and the number of rays is right on the
//! average for bodies of any size. What to do about a body that no ray meets is said in [`mask`](super::mask).

use glam::DVec3;

use super::solid::{Form, View};
use super::sphere_map::{FACES, SphereMap};

/// The ray through a pixel's centre passes through a body from `near` to `far` [m].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Hit {
    pub pixel: u32,
    pub near: f32,
    pub far: f32,
}

/// All hits of a body, by pixel and then by distance. A body that is not convex may be met more than once by a ray.
pub(super) fn hits(map: &SphereMap, view: &View) -> Vec<Hit> {
    let mut found = Vec::new();
    for face in (0..FACES).filter(|&face| may_touch(map, face, view)) {
        match view.form {
            Form::Box { .. } => through_box(map, face, view, &mut found),
            Form::Mesh(mesh) => through_mesh(map, face, &view.vertices, &mesh.triangles, &mut found),
        }
    }
    found.sort_unstable_by(|a, b| a.pixel.cmp(&b.pixel).then(a.near.total_cmp(&b.near)));
    found
}

/// Whether the sphere around a body may be seen within a face's circle.
fn may_touch(map: &SphereMap, face: usize, view: &View) -> bool {
    let distance = view.middle.length();
    if distance <= view.radius {
        return true;
    }
    let (axis, cosine) = map.cone(face);
    let sine = view.radius / distance;
    // cos(a + b) of the face's and the body's half-angles, both below a right angle.
    let reach = cosine * libm::sqrt(1.0 - sine * sine) - libm::sqrt(1.0 - cosine * cosine) * sine;
    axis.dot(view.middle) >= distance * reach
}

/// Bounds on a face's shares within which all points are seen: the whole face where some lie behind it, `None`
/// where all do.
fn bounds(map: &SphereMap, face: usize, points: &[DVec3]) -> Option<(DVec3, DVec3)> {
    let mut low = DVec3::INFINITY;
    let mut high = DVec3::NEG_INFINITY;
    let mut behind = 0;
    for &point in points {
        match map.shares(face, point) {
            Some(shares) => {
                low = low.min(shares);
                high = high.max(shares);
            }
            None => behind += 1,
        }
    }
    if behind == points.len() {
        None
    } else if behind > 0 {
        Some((DVec3::ZERO, DVec3::splat(map.resolution() as f64)))
    } else {
        Some((low, high))
    }
}

fn through_box(map: &SphereMap, face: usize, view: &View, found: &mut Vec<Hit>) {
    let Some((low, high)) = bounds(map, face, &view.vertices) else { return };
    map.for_each_between(face, low, high, |pixel, direction| {
        if let Some((near, far)) = view.through_box(direction) {
            let length = direction.length();
            let (near, far) = ((near * length) as f32, (far * length) as f32);
            found.push(Hit { pixel: pixel as u32, near, far });
        }
    });
}

/// One crossing of a ray through the surface of a mesh.
struct Crossing {
    pixel: u32,
    distance: f64,
    enters: bool,
}

fn through_mesh(
    map: &SphereMap,
    face: usize,
    vertices: &[DVec3],
    triangles: &[[u32; 3]],
    found: &mut Vec<Hit>,
) {
    let mut crossings = Vec::new();
    for triangle in triangles {
        let corners = triangle.map(|v| vertices[v as usize]);
        let Some((low, high)) = bounds(map, face, &corners) else { continue };
        let [a, b, c] = corners;
        let edges = [b.cross(c), c.cross(a), a.cross(b)];
        let volume = a.dot(edges[0]);
        if volume == 0.0 {
            continue;
        }
        map.for_each_between(face, low, high, |pixel, direction| {
            let sides = edges.map(|edge| edge.dot(direction) * volume.signum());
            let sum: f64 = sides.iter().sum();
            if sum > 0.0 && sides.iter().all(|&side| side >= 0.0) {
                let distance = volume.abs() / sum * direction.length();
                crossings.push(Crossing { pixel: pixel as u32, distance, enters: volume < 0.0 });
            }
        });
    }
    crossings.sort_unstable_by(|a, b| {
        a.pixel.cmp(&b.pixel).then(a.distance.total_cmp(&b.distance)).then(b.enters.cmp(&a.enters))
    });
    for ray in crossings.chunk_by(|a, b| a.pixel == b.pixel) {
        pair(ray, found);
    }
}

/// Pairs the crossings of one ray, in order, into stretches inside the body. A ray through an edge crosses both
/// triangles there at once, which counts once.
fn pair(ray: &[Crossing], found: &mut Vec<Hit>) {
    let mut depth = 0_i32;
    let mut near = 0.0;
    let mut last: Option<&Crossing> = None;
    for crossing in ray {
        let again = last.is_some_and(|l| {
            l.enters == crossing.enters && crossing.distance - l.distance <= 1e-9 * crossing.distance
        });
        last = Some(crossing);
        if again {
            continue;
        }
        if crossing.enters {
            if depth == 0 {
                near = crossing.distance;
            }
            depth += 1;
        } else if depth > 0 {
            depth -= 1;
            if depth == 0 {
                found.push(Hit { pixel: crossing.pixel, near: near as f32, far: crossing.distance as f32 });
            }
        } else {
            // The ray was inside from the start: the charge lies in the body.
            found.push(Hit { pixel: crossing.pixel, near: 0.0, far: crossing.distance as f32 });
        }
    }
    if depth > 0 {
        let end = ray[ray.len() - 1].distance;
        found.push(Hit { pixel: ray[0].pixel, near: near as f32, far: end as f32 });
    }
}
