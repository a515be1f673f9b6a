//! Mass properties and outlines against closed forms. Tolerances are rounding of sums over a few hundred terms.

use brisance_engine::geometry::{
    JOINT, MassProperties, Outline, PrincipalAxes, Silhouette, TriangleMesh, bounds,
};
use brisance_engine::loading::{box_panels, mesh_panels};
use glam::{DMat3, DQuat, DVec2, DVec3};
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

/// Corners of an upright rectangle in the plane z = 3.
fn rectangle(low: (f64, f64), high: (f64, f64)) -> Vec<DVec3> {
    [(low.0, low.1), (high.0, low.1), (high.0, high.1), (low.0, high.1)]
        .map(|(x, y)| DVec3::new(x, y, 3.0))
        .into()
}

fn outline(members: &[Vec<DVec3>], closed: impl Fn(DVec3) -> bool) -> Outline {
    Outline::new(members.iter().map(|points| &points[..]), DVec3::Z, closed)
}

#[test]
fn a_rectangle_has_its_width_and_clears_from_its_nearest_edge() {
    let points = rectangle((-2.0, 0.0), (2.0, 1.0));
    let free = Silhouette::new(&points, DVec3::Z, |_| false);
    assert!((free.least_width() - 1.0).abs() < 1e-12);
    let place = DVec3::new(0.0, 0.2, 0.0);
    assert!((outline(std::slice::from_ref(&points), |_| false).distance_to_edge(place) - 0.2).abs() < 1e-12);
    let standing = outline(&[points], |p| p.y <= 0.0);
    assert!((standing.distance_to_edge(place) - 0.8).abs() < 1e-12);
    assert_eq!(
        outline(&[rectangle((0.0, 0.0), (1.0, 0.0))], |_| true).distance_to_edge(place),
        f64::INFINITY
    );
}

/// A wall of 40 × 20 rectangles, with joints or without, is as one; a place left open is an edge.
#[test]
fn many_bricks_clear_from_the_edge_of_the_whole_and_of_its_holes() {
    for joint in [0.0, 0.5 * JOINT] {
        let brick = |i: i32, j: i32| {
            let (x, y) = (f64::from(i) * 0.3, f64::from(j) * 0.2);
            rectangle((x, y), (x + 0.3 - joint, y + 0.2 - joint))
        };
        let all = |hole: bool| -> Vec<Vec<DVec3>> {
            (0..40)
                .flat_map(|i| (0..20).map(move |j| (i, j)))
                .filter(|&(i, j)| !(hole && (18..22).contains(&i) && (8..12).contains(&j)))
                .map(|(i, j)| brick(i, j))
                .collect()
        };
        let whole = outline(&all(false), |p| p.y <= 0.0);
        // The hole is the window from (5.4, 1.6) to (6.6, 2.4).
        let pierced = outline(&all(true), |p| p.y <= 0.0);
        for (x, y) in [(6.0, 3.1), (3.0, 0.4), (6.9, 2.0), (0.35, 2.0), (5.2, 2.6)] {
            let place = DVec3::new(x, y, 0.0);
            let edge = x.min(12.0 - x).min(4.0 - y);
            let window =
                DVec2::new((5.4 - x).max(x - 6.6).max(0.0), (1.6 - y).max(y - 2.4).max(0.0)).length();
            assert!((whole.distance_to_edge(place) - edge).abs() <= joint + 1e-9, "({x}, {y})");
            let expected = edge.min(window);
            assert!((pierced.distance_to_edge(place) - expected).abs() <= 2.0 * joint + 1e-9, "({x}, {y})");
        }
    }
}

/// Seen aslant, where no two corners of neighbours project to the same bits, a whole wall still has no rim within.
#[test]
fn a_wall_seen_aslant_has_no_rim_inside() {
    let bricks: Vec<Vec<DVec3>> = (0..6)
        .flat_map(|row| (0..8).map(move |column| (row, column)))
        .map(|(row, column)| {
            let shift = if row % 2 == 0 { 0.0 } else { 0.16 };
            let low = DVec3::new(f64::from(column) * 0.32 + shift, f64::from(row) * 0.16, 0.0);
            (0..8)
                .map(|code| {
                    let far = |bit: i32| if code & bit == 0 { 0.0 } else { 1.0 };
                    low + DVec3::new(0.32 * far(1), 0.16 * far(2), 0.1 * far(4))
                })
                .collect()
        })
        .collect();
    for direction in [DVec3::new(0.0, 0.012, 1.0), DVec3::new(0.03, -0.02, 1.0), DVec3::new(0.2, 0.1, 1.0)] {
        let members = bricks.iter().map(|points: &Vec<DVec3>| &points[..]);
        let outline = Outline::new(members, direction.normalize(), |p| p.y < 0.01);
        // The middle of the wall's foot is 0.96 m below its top, and farther from its sides; the thickness of 0.1 m
        // shows by its slope.
        let place = DVec3::new(1.36, 0.0, 0.0);
        let distance = outline.distance_to_edge(place);
        assert!((distance - 0.96).abs() < 0.05, "{direction}: {distance}");
    }
}

/// Two wings that stand apart clear from the gap between them, which a convex outline would not see.
#[test]
fn a_gap_wider_than_a_joint_relieves() {
    let wings = |gap: f64| {
        outline(&[rectangle((-3.0, 0.0), (-gap / 2.0, 3.0)), rectangle((gap / 2.0, 0.0), (3.0, 3.0))], |p| {
            p.y <= 0.0
        })
    };
    let place = DVec3::new(0.5, 1.0, 0.0);
    assert!((wings(0.1).distance_to_edge(place) - 0.45).abs() < 1e-9);
    assert!((wings(0.01).distance_to_edge(place) - 2.0).abs() < 1e-9);
}

/// No points leave a box that any other swallows and none overlaps.
#[test]
fn no_points_have_bounds_that_hold_nothing() {
    assert_eq!(bounds(core::iter::empty::<DVec3>()), (DVec3::INFINITY, DVec3::NEG_INFINITY));
    let point = DVec2::new(2.0, -3.0);
    let (low, high) = bounds(core::iter::empty::<DVec2>());
    assert_eq!((low.min(point), high.max(point)), bounds([point]));
}

proptest! {
    /// Bounds are those of each coordinate sorted by itself, in the plane and in space.
    #[test]
    fn bounds_are_the_ends_of_every_coordinate(
        points in prop::collection::vec(prop::array::uniform3(-1e6f64..1e6), 1..20),
    ) {
        let (low, high) = bounds(points.iter().map(|&p| DVec3::from_array(p)));
        for axis in 0..3 {
            let mut sorted: Vec<f64> = points.iter().map(|p| p[axis]).collect();
            sorted.sort_by(f64::total_cmp);
            prop_assert_eq!((low[axis], high[axis]), (sorted[0], sorted[sorted.len() - 1]));
        }
        let flat = bounds(points.iter().map(|&p| DVec3::from_array(p).truncate()));
        prop_assert_eq!(flat, (low.truncate(), high.truncate()));
    }


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
