//! Pieces as solids: closed, facing outward, with the volume and inertia of their polygon.

mod fragments;

use std::collections::{HashMap, HashSet};

use brisance_engine::geometry::{MassProperties, PieceMesh, PieceMeshes, Polygon, Triangulator};
use fragments::{mapped, mosaic, shard, with_holes};
use glam::{DVec2, DVec3};
use proptest::prelude::*;

fn push(meshes: &mut PieceMeshes, piece: &Polygon, thickness: f64) {
    let mut triangles = Vec::new();
    Triangulator::default().triangulate(piece, &mut triangles).unwrap();
    meshes.push_prism(piece, &triangles, piece.moments().centroid, thickness);
}

fn solid(piece: &Polygon, thickness: f64) -> PieceMeshes {
    let mut meshes = PieceMeshes::default();
    push(&mut meshes, piece, thickness);
    meshes
}

/// Whether every directed edge is used once and so is its opposite: closed, and consistently oriented.
fn is_closed(mesh: &PieceMesh) -> bool {
    let mut edges = HashSet::new();
    let triangles = [mesh.front, mesh.back, mesh.broken].concat();
    let once =
        triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]).all(|edge| edges.insert(edge));
    once && edges.iter().all(|&(a, b)| edges.contains(&(b, a)))
}

fn normal(mesh: &PieceMesh, triangle: [u32; 3]) -> DVec3 {
    let [a, b, c] = triangle.map(|i| mesh.vertices[i as usize]);
    (b - a).cross(c - a)
}

fn check(piece: &Polygon, thickness: f64) -> Result<(), TestCaseError> {
    let meshes = solid(piece, thickness);
    let mesh = meshes.piece(0);
    prop_assert!(is_closed(&mesh));
    let moments = piece.moments();
    let exact = moments.prism(thickness, 2500.0);
    let summed = MassProperties::of_mesh(&mesh.to_mesh(), 2500.0).unwrap();
    // Positive only for a mesh that faces outward.
    prop_assert!((summed.mass / (2500.0 * moments.area * thickness) - 1.0).abs() < 1e-9);
    let reach = mesh.vertices.iter().map(|v| v.length()).fold(0.0, f64::max);
    prop_assert!(summed.centre.length() < 1e-9 * reach, "the origin is the centre of mass");
    let differences = (summed.inertia - exact.inertia).to_cols_array();
    prop_assert!(differences.iter().all(|d| d.abs() < 1e-9 * exact.mass * reach * reach));
    let corners = piece.points().len();
    prop_assert_eq!(mesh.vertices.len(), 2 * corners);
    prop_assert_eq!(mesh.broken.len(), 2 * corners);
    prop_assert_eq!(
        mesh.front.len() + mesh.back.len() + mesh.broken.len(),
        4 * (corners + piece.hole_count() - 1)
    );
    for &triangle in mesh.front {
        prop_assert!(triangle.iter().all(|&i| mesh.vertices[i as usize].z == thickness / 2.0));
        prop_assert!(normal(&mesh, triangle).z > 0.0);
    }
    for &triangle in mesh.back {
        prop_assert!(triangle.iter().all(|&i| mesh.vertices[i as usize].z == -thickness / 2.0));
        prop_assert!(normal(&mesh, triangle).z < 0.0);
    }
    for &triangle in mesh.broken {
        prop_assert_eq!(normal(&mesh, triangle).z, 0.0);
    }
    // Texture coordinates are the pane's own, to the bit, on both faces.
    prop_assert_eq!(&mesh.uv[..corners], piece.points());
    prop_assert_eq!(&mesh.uv[corners..], piece.points());
    for (vertex, uv) in mesh.vertices.iter().zip(mesh.uv) {
        prop_assert!((vertex.truncate() + moments.centroid).distance(*uv) < 1e-15 * (1.0 + uv.length()));
    }
    Ok(())
}

#[test]
fn a_square_pane_is_its_box() {
    let square = [(1.0, 1.0), (3.0, 1.0), (3.0, 2.0), (1.0, 2.0)].map(DVec2::from);
    let meshes = solid(&Polygon::new(&square), 0.5);
    let summed = MassProperties::of_mesh(&meshes.piece(0).to_mesh(), 10.0).unwrap();
    let expected = MassProperties::of_box(DVec3::new(2.0, 1.0, 0.5), 10.0);
    assert!((summed.mass - 10.0).abs() < 1e-13 && summed.centre.length() < 1e-15);
    assert!((summed.inertia - expected.inertia).to_cols_array().iter().all(|x| x.abs() < 1e-13));
    let moments = Polygon::new(&square).moments();
    let exact = moments.prism(0.5, 10.0);
    assert_eq!(exact.centre, DVec3::new(2.0, 1.5, 0.0));
    assert!((exact.inertia - expected.inertia).to_cols_array().iter().all(|x| x.abs() < 1e-13));
}

#[test]
fn the_pieces_of_a_pane_fill_it_and_meet_corner_to_corner() {
    let pieces = mosaic(500, 9);
    let mut meshes = PieceMeshes::default();
    for piece in &pieces {
        push(&mut meshes, piece, 0.004);
    }
    assert_eq!((meshes.len(), meshes.iter().count()), (501, 501));
    let volume: f64 = meshes.iter().map(|m| MassProperties::of_mesh(&m.to_mesh(), 1.0).unwrap().mass).sum();
    assert!((volume / 0.004 - 1.0).abs() < 1e-12);
    // The rims, in the pane's coordinates: each is met from the other side by exactly one neighbour, or is the border.
    let bits = |p: DVec2| (p.x.to_bits(), p.y.to_bits());
    let mut rims = HashMap::new();
    for mesh in meshes.iter() {
        let rim = mesh
            .broken
            .iter()
            .filter(|t| t.iter().filter(|&&i| mesh.vertices[i as usize].z > 0.0).count() == 2);
        for &[_, to, from] in rim {
            *rims.entry((bits(mesh.uv[from as usize]), bits(mesh.uv[to as usize]))).or_insert(0) += 1;
        }
    }
    assert!(rims.values().all(|&uses| uses == 1));
    let open = rims.keys().filter(|(from, to)| !rims.contains_key(&(*to, *from)));
    let on_border = |&(x, y): &(u64, u64)| [x, y].iter().any(|&c| c == 0 || c == 1f64.to_bits());
    let mut border = 0.0;
    for (from, to) in open {
        assert!(on_border(from) && on_border(to), "a rim inside the pane has no neighbour");
        let place = |p: &(u64, u64)| DVec2::new(f64::from_bits(p.0), f64::from_bits(p.1));
        border += place(from).distance(place(to));
    }
    assert!((border - 4.0).abs() < 1e-12, "the border is {border} m long");
}

#[test]
fn buffers_joined_in_order_are_one_buffer() {
    let pieces: Vec<Polygon> = mosaic(30, 2).into_iter().chain([with_holes(20, 3, 1)]).collect();
    let (mut whole, mut joined) = (PieceMeshes::default(), PieceMeshes::default());
    for chunk in pieces.chunks(7) {
        let mut part = PieceMeshes::default();
        for piece in chunk {
            push(&mut part, piece, 0.01);
            push(&mut whole, piece, 0.01);
        }
        joined.append(&part);
    }
    assert_eq!(joined, whole);
    joined.clear();
    assert!(joined.is_empty() && joined.bytes() == 0);
    joined.append(&whole);
    assert_eq!(joined, whole);
}

#[test]
fn a_piece_takes_less_than_a_quarter_of_4_kb() {
    let pieces = mosaic(1000, 1);
    let mut meshes = PieceMeshes::default();
    pieces.iter().for_each(|piece| push(&mut meshes, piece, 0.004));
    let a_piece = meshes.bytes() as f64 / pieces.len() as f64;
    assert!(a_piece < 1000.0, "{a_piece} bytes a piece");
}

proptest! {
    /// Straight-sided pieces with T-junctions, panes from a millimetre to 100 m and from 0.1 mm to 1 m thick.
    #[test]
    fn every_piece_of_a_mosaic_is_a_solid(seed in any::<u64>(), size in -3.0f64..2.0, thickness in -4.0f64..0.0) {
        let size = 10f64.powf(size);
        for piece in &mosaic(12, seed) {
            check(&mapped(piece, |p| p * size), 10f64.powf(thickness))?;
        }
    }

    /// Bent pieces and pieces with holes.
    #[test]
    fn every_shard_is_a_solid(seed in any::<u64>(), count in 12usize..250, holes in 0usize..5) {
        check(&if holes == 0 { shard(count, seed) } else { with_holes(count, holes, seed) }, 0.006)?;
    }
}
