//! Mass properties and outlines against closed forms. Tolerances are rounding of sums over a few hundred terms.

use brisance_engine::geometry::{MassProperties, PrincipalAxes, Silhouette, TriangleMesh};
use brisance_engine::loading::{box_panels, mesh_panels};
use glam::{DMat3, DQuat, DVec3};
use proptest::prelude::*;

fn box_mesh(size: DVec3, placed: impl Fn(DVec3) -> DVec3) -> TriangleMesh {
    let corner = |i: usize| {
        let sign = |bit: usize| if i & bit == 0 { -0.5 } else { 0.5 };
        placed(size * DVec3::new(sign(1), sign(2), sign(4)))
    };
    let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = quads.iter().flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]).collect();
    TriangleMesh::new((0..8).map(corner).collect(), triangles).unwrap()
}

fn torus(major: f64, minor: f64, around: u32, across: u32) -> TriangleMesh {
    let turn = |i: u32, n: u32| std::f64::consts::TAU * f64::from(i) / f64::from(n);
    let vertices = (0..around * across)
        .map(|k| {
            let (a, b) = (turn(k / across, around), turn(k % across, across));
            let ring = major + minor * b.cos();
            DVec3::new(ring * a.cos(), minor * b.sin(), ring * a.sin())
        })
        .collect();
    let id = |i: u32, j: u32| (i % around) * across + j % across;
    let triangles = (0..around)
        .flat_map(|i| (0..across).map(move |j| (i, j)))
        .flat_map(|(i, j)| {
            [[id(i, j), id(i, j + 1), id(i + 1, j)], [id(i, j + 1), id(i + 1, j + 1), id(i + 1, j)]]
        })
        .collect();
    TriangleMesh::new(vertices, triangles).unwrap()
}

#[test]
fn a_torus_has_its_closed_form_volume_and_inertia() {
    let (major, minor) = (2.0_f64, 0.5_f64);
    let solid = MassProperties::of_mesh(&torus(major, minor, 400, 200), 1.0).unwrap();
    let volume = std::f64::consts::TAU * std::f64::consts::PI * major * minor * minor;
    // A polyhedron of n segments lies inside by about (2π/n)²/6: 2e-4 for 200.
    assert!((solid.mass / volume - 1.0).abs() < 5e-4);
    let axial = solid.mass * (major * major + 0.75 * minor * minor);
    let across = solid.mass * (0.5 * major * major + 0.625 * minor * minor);
    assert!((solid.inertia.y_axis.y / axial - 1.0).abs() < 5e-4);
    assert!((solid.inertia.x_axis.x / across - 1.0).abs() < 5e-4);
}

#[test]
fn a_flat_mesh_has_no_volume() {
    let flat = TriangleMesh::new(vec![DVec3::ZERO, DVec3::X, DVec3::Z], vec![[0, 1, 2], [0, 2, 1]]).unwrap();
    assert!(MassProperties::of_mesh(&flat, 1.0).is_err());
}

#[test]
fn off_diagonal_inertia_carries_the_sign_of_the_matrix() {
    // Two far corners of the xy plane hold the mass: ∫ρxy > 0, so I_xy = −∫ρxy < 0.
    let mesh = box_mesh(DVec3::new(4.0, 0.1, 0.1), |p| DQuat::from_rotation_z(0.7) * p);
    let inertia = MassProperties::of_mesh(&mesh, 1.0).unwrap().inertia;
    assert!(inertia.y_axis.x < 0.0);
}

#[test]
fn a_rectangle_has_its_width_and_clears_from_its_nearest_edge() {
    let points: Vec<DVec3> =
        [(-2.0, 0.0), (2.0, 0.0), (2.0, 1.0), (-2.0, 1.0)].map(|(x, y)| DVec3::new(x, y, 3.0)).into();
    let free = Silhouette::new(&points, DVec3::Z, |_| false);
    assert!((free.least_width() - 1.0).abs() < 1e-12);
    assert!((free.distance_to_edge(DVec3::new(0.0, 0.2, 0.0)) - 0.2).abs() < 1e-12);
    let standing = Silhouette::new(&points, DVec3::Z, |p| p.y <= 0.0);
    assert!((standing.distance_to_edge(DVec3::new(0.0, 0.2, 0.0)) - 0.8).abs() < 1e-12);
    assert_eq!(standing.distance_to_edge(DVec3::new(9.0, 0.2, 0.0)), 0.0);
}

proptest! {
    /// A box as a mesh, anywhere and turned, has the box's own mass, centre and moments.
    #[test]
    fn a_box_mesh_equals_the_box(
        size in prop::array::uniform3(0.05f64..3.0),
        place in prop::array::uniform3(-100.0f64..100.0),
        turn in prop::array::uniform3(-3.0f64..3.0),
    ) {
        let size = DVec3::from_array(size);
        let place = DVec3::from_array(place);
        let turn = DQuat::from_scaled_axis(DVec3::from_array(turn));
        let solid = MassProperties::of_mesh(&box_mesh(size, |p| place + turn * p), 700.0).unwrap();
        let expected = MassProperties::of_box(size, 700.0 * size.element_product());
        prop_assert!((solid.mass / expected.mass - 1.0).abs() < 1e-9);
        prop_assert!(solid.centre.distance(place) < 1e-9);
        let r = DMat3::from_quat(turn);
        let turned = r * expected.inertia * r.transpose();
        prop_assert!((solid.inertia - turned).to_cols_array().iter().all(|x| x.abs() < 1e-8 * expected.mass));
        let axes = PrincipalAxes::of(solid.inertia);
        let back = DMat3::from_quat(axes.object_from_principal);
        let again = back * DMat3::from_diagonal(axes.moments) * back.transpose();
        prop_assert!((again - solid.inertia).to_cols_array().iter().all(|x| x.abs() < 1e-9 * expected.mass));
    }

    /// Panels cover the box, and a uniform pressure on all of them pushes and turns nothing.
    #[test]
    fn panels_close(size in prop::array::uniform3(0.05f64..3.0)) {
        let size = DVec3::from_array(size);
        let panels = box_panels(size, [false; 6]);
        prop_assert_eq!(panels.len(), 24);
        let area: f64 = panels.iter().map(|p| p.area).sum();
        let expected = 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x);
        prop_assert!((area / expected - 1.0).abs() < 1e-12);
        let push: DVec3 = panels.iter().map(|p| p.normal * p.area).sum();
        let twist: DVec3 = panels.iter().map(|p| p.centre.cross(p.normal * p.area)).sum();
        prop_assert!(push.length() < 1e-12 && twist.length() < 1e-12);
    }
}

#[test]
fn merged_panels_of_a_fine_mesh_still_close() {
    let panels = mesh_panels(&torus(2.0, 0.5, 60, 30), DVec3::ZERO);
    assert!(panels.len() <= 768, "{} panels", panels.len());
    let push: DVec3 = panels.iter().map(|p| p.normal * p.area).sum();
    assert!(push.length() < 1e-9);
}
