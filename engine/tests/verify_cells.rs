//! Meshes in convex hulls, against volumes and distances that are found in another way.

use brisance_engine::dynamics::contact::CollisionShape;
use brisance_engine::geometry::{MassProperties, TriangleMesh};
use glam::{DQuat, DVec2, DVec3};

/// Most by which hulls may be larger than the mesh together, where there are fewer than sixteen.
const ENOUGH: f64 = 1.05;

/// A prism over a ring in the plane z = 0, with the triangles that fill the ring.
fn prism(ring: &[(f64, f64)], fill: &[[u32; 3]], height: f64) -> TriangleMesh {
    let n = ring.len() as u32;
    let vertices =
        [0.0, height].iter().flat_map(|&z| ring.iter().map(move |&(x, y)| DVec3::new(x, y, z))).collect();
    let mut triangles: Vec<[u32; 3]> =
        fill.iter().flat_map(|&[a, b, c]| [[a, c, b], [n + a, n + b, n + c]]).collect();
    triangles.extend((0..n).flat_map(|k| [[k, (k + 1) % n, n + k], [(k + 1) % n, n + (k + 1) % n, n + k]]));
    TriangleMesh::new(vertices, triangles).unwrap()
}

/// An L, a U, a cross-like star and a half ring, with their volumes.
fn meshes() -> Vec<(&'static str, TriangleMesh, f64)> {
    let l = [(0.0, 0.0), (1.0, 0.0), (1.0, 0.3), (0.3, 0.3), (0.3, 1.0), (0.0, 1.0)];
    let l_fill = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]];
    let u = [
        (0.0, 0.0),
        (1.0, 0.0),
        (1.0, 1.0),
        (0.75, 1.0),
        (0.75, 0.25),
        (0.25, 0.25),
        (0.25, 1.0),
        (0.0, 1.0),
    ];
    let u_fill = [[0, 1, 5], [1, 4, 5], [1, 2, 4], [2, 3, 4], [0, 5, 6], [0, 6, 7]];
    // Six points on a circle, six between them half as far out; the middle makes the fan.
    let mut star = vec![(0.0, 0.0)];
    star.extend((0..12).map(|k| {
        let p = DVec2::from_angle(std::f64::consts::TAU * f64::from(k) / 12.0)
            * if k % 2 == 0 { 1.0 } else { 0.5 };
        (p.x, p.y)
    }));
    let star_volume = 12.0 * 0.5 * 1.0 * 0.5 * (std::f64::consts::TAU / 12.0).sin() * 0.4;
    let steps = 16_u32;
    let arc = |radius: f64, k: u32| {
        let p = DVec2::from_angle(std::f64::consts::PI * f64::from(k) / f64::from(steps)) * radius;
        (p.x, p.y)
    };
    let mut ring: Vec<(f64, f64)> = (0..=steps).map(|k| arc(1.0, k)).collect();
    ring.extend((0..=steps).rev().map(|k| arc(0.6, k)));
    let inner = |k: u32| 2 * steps + 1 - k;
    let ring_fill: Vec<[u32; 3]> =
        (0..steps).flat_map(|k| [[k, k + 1, inner(k)], [k + 1, inner(k + 1), inner(k)]]).collect();
    let slice = 0.5 * (std::f64::consts::PI / f64::from(steps)).sin() * f64::from(steps);
    vec![
        ("L", prism(&l, &l_fill, 0.4), 0.51 * 0.4),
        ("U", prism(&u, &u_fill, 0.2), 0.625 * 0.2),
        ("star", star_mesh(&star[1..], 0.4), star_volume),
        ("half ring", prism(&ring, &ring_fill, 0.3), slice * (1.0 - 0.36) * 0.3),
    ]
}

/// A prism over a star-shaped ring about the origin, filled from there.
fn star_mesh(ring: &[(f64, f64)], height: f64) -> TriangleMesh {
    let n = ring.len() as u32;
    let layer =
        |z: f64| std::iter::once(DVec3::Z * z).chain(ring.iter().map(move |&(x, y)| DVec3::new(x, y, z)));
    let vertices: Vec<DVec3> = layer(0.0).chain(layer(height)).collect();
    let top = n + 1;
    let triangles = (0..n).flat_map(|k| {
        let (a, b) = (1 + k, 1 + (k + 1) % n);
        [[0, b, a], [top, top + a, top + b], [a, b, top + a], [b, top + b, top + a]]
    });
    TriangleMesh::new(vertices, triangles.collect()).unwrap()
}

/// The planes of a convex hull, each through three of its points with all others on one side: every triple is tried.
fn planes(points: &[DVec3]) -> Vec<(DVec3, f64)> {
    let mut found: Vec<(DVec3, f64)> = Vec::new();
    for i in 0..points.len() {
        for j in i + 1..points.len() {
            for k in j + 1..points.len() {
                let normal = (points[j] - points[i]).cross(points[k] - points[i]);
                if normal.length() < 1e-12 {
                    continue;
                }
                for normal in [normal.normalize(), -normal.normalize()] {
                    let offset = normal.dot(points[i]);
                    let outer = points.iter().all(|p| normal.dot(*p) <= offset + 1e-9);
                    let known =
                        |&(n, o): &(DVec3, f64)| n.distance(normal) < 1e-7 && (o - offset).abs() < 1e-7;
                    if outer && !found.iter().any(known) {
                        found.push((normal, offset));
                    }
                }
            }
        }
    }
    found
}

fn corners_once(points: &[DVec3]) -> Vec<DVec3> {
    let mut once: Vec<DVec3> = Vec::new();
    for &p in points {
        if !once.iter().any(|q| q.distance(p) < 1e-9) {
            once.push(p);
        }
    }
    once
}

/// Points of a lattice through the bounds of a mesh, moved off its faces.
fn lattice(mesh: &TriangleMesh) -> Vec<DVec3> {
    let low = mesh.vertices.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let high = mesh.vertices.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
    let n = 30;
    let at = |i: usize, axis: usize| low[axis] + (high[axis] - low[axis]) * (i as f64 + 0.4137) / n as f64;
    (0..n * n * n).map(|c| DVec3::new(at(c % n, 0), at(c / n % n, 1), at(c / n / n, 2))).collect()
}

/// Hulls cover the mesh, and together they are hardly larger: by 5 %, beside what a lattice of 30 a side cannot tell.
#[test]
fn hulls_cover_a_mesh_and_hardly_more() {
    for (name, mesh, volume) in meshes() {
        let solid = MassProperties::of_mesh(&mesh, 1.0).unwrap();
        assert!((solid.mass - volume).abs() < 1e-9, "{name}: {} instead of {volume} m³", solid.mass);
        let shape = CollisionShape::of_mesh(&mesh, solid.mass, DVec3::ZERO, DQuat::IDENTITY);
        let CollisionShape::Hulls(hulls) = shape else { panic!("a mesh has hulls") };
        let hulls: Vec<Vec<(DVec3, f64)>> =
            hulls.iter().map(|points| planes(&corners_once(points))).collect();
        let holds = |hull: &[(DVec3, f64)], p: DVec3| hull.iter().all(|&(n, o)| n.dot(p) <= o + 1e-9);
        let points = lattice(&mesh);
        let (mut own, mut covered, mut double) = (0, 0, 0);
        for &p in &points {
            let inside = mesh.encloses(p);
            let count = hulls.iter().filter(|hull| holds(hull, p)).count();
            assert!(!inside || count > 0, "{name}: {p} of the mesh is in no hull");
            own += usize::from(inside);
            covered += usize::from(count > 0);
            double += count.saturating_sub(1);
        }
        let larger = covered as f64 / own as f64;
        println!("{name}: {} hulls, {larger:.3} of the volume, {double} points twice", hulls.len());
        assert!(hulls.len() <= 16);
        assert!(larger < ENOUGH + 0.02 || hulls.len() == 16, "{name}: {larger}");
        // Cells lie beside each other.
        assert!(double as f64 <= 0.01 * own as f64, "{name}: {double} points are in two hulls");
    }
}

/// Hulls together have the mesh's own bounds.
#[test]
fn no_hull_leaves_the_bounds() {
    for (name, mesh, volume) in meshes() {
        let shape = CollisionShape::of_mesh(&mesh, volume, DVec3::ZERO, DQuat::IDENTITY);
        let bounds = |points: &mut dyn Iterator<Item = DVec3>| {
            points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)))
        };
        let CollisionShape::Hulls(hulls) = &shape else { panic!("a mesh has hulls") };
        let of_hulls = bounds(&mut hulls.iter().flatten().copied());
        let of_mesh = bounds(&mut mesh.vertices.iter().copied());
        assert!(of_hulls.0.distance(of_mesh.0) < 1e-12 && of_hulls.1.distance(of_mesh.1) < 1e-12, "{name}");
    }
}

/// A convex mesh is its own hull, and a box that is turned into it keeps its volume.
#[test]
fn a_convex_mesh_is_one_hull() {
    let ring = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    let mesh = prism(&ring, &[[0, 1, 2], [0, 2, 3]], 0.5);
    let turn = DQuat::from_rotation_x(0.7);
    let shape = CollisionShape::of_mesh(&mesh, 0.5, DVec3::new(0.5, 0.5, 0.25), turn);
    let CollisionShape::Hulls(hulls) = &shape else { panic!("a mesh has hulls") };
    assert_eq!(hulls.len(), 1);
    let reach = DVec3::new(0.5, 0.5, 0.25).length();
    assert!((shape.reach() - reach).abs() < 1e-12);
    assert_eq!(planes(&corners_once(&hulls[0])).len(), 6);
}
