//! Polygons made into solid pieces: closed meshes of prisms, many in one buffer.

use glam::{DVec2, DVec3};

use super::{Polygon, TriangleMesh};

/// The meshes of many pieces of a pane, one after another in flat arrays.
///
/// A piece is its polygon thickened symmetrically about z = 0: the front at `+thickness/2` faces +z, the back −z,
/// and the broken faces stand between them. Each corner of the polygon gives two vertices, shared by all the
/// triangles around it, so that every piece is closed: a piece of `n` corners and `h` holes has `2n` vertices and
/// `4(n + h − 1)` triangles. That is some 0.7 kB for the six corners of a common piece and 0.1 kB for each more.
///
/// A side of the polygon with another piece's corner in its middle has a vertex there and two broken faces, so
/// that neighbours meet corner to corner.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PieceMeshes {
    vertices: Vec<DVec3>,
    uv: Vec<DVec2>,
    triangles: Vec<[u32; 3]>,
    pieces: Vec<PieceEnd>,
}

/// Where a piece's share of the arrays ends, and how its triangles are divided.
#[derive(Debug, Clone, Copy, PartialEq)]
struct PieceEnd {
    vertices: u32,
    triangles: u32,
    /// Triangles of the front, and as many of the back.
    front: u32,
}

/// One piece of [`PieceMeshes`]. Triangles name the piece's own vertices, from 0, counter-clockwise seen from
/// outside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PieceMesh<'a> {
    /// Corners [m] in the piece's own frame: first those of the front in the order of the polygon's points, then
    /// those of the back.
    pub vertices: &'a [DVec3],
    /// Texture coordinates of each vertex: where it was in the pane [m]. Neighbours agree to the bit, front and
    /// back too, and a broken face carries the picture of its rim through the thickness.
    pub uv: &'a [DVec2],
    /// The face towards +z.
    pub front: &'a [[u32; 3]],
    /// The face towards −z.
    pub back: &'a [[u32; 3]],
    /// The broken faces all around: a group of their own, for a material of their own.
    pub broken: &'a [[u32; 3]],
}

impl PieceMeshes {
    /// Forgets every piece and keeps the memory.
    pub fn clear(&mut self) {
        self.vertices.clear();
        self.uv.clear();
        self.triangles.clear();
        self.pieces.clear();
    }

    /// How many pieces there are.
    pub fn len(&self) -> usize {
        self.pieces.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.pieces.is_empty()
    }

    /// Adds a piece: `polygon` with its `triangles` from [`Triangulator`](super::Triangulator), `thickness` [m]
    /// above 0.
    ///
    /// `origin` [m] is the point of the pane that becomes the piece's own origin: the centroid, for a body.
    ///
    /// # Panics
    /// When the pieces so far have more than 2³² vertices or triangles.
    pub fn push_prism(&mut self, polygon: &Polygon, triangles: &[[u32; 3]], origin: DVec2, thickness: f64) {
        let points = polygon.points();
        for z in [0.5 * thickness, -0.5 * thickness] {
            self.vertices.extend(points.iter().map(|&p| (p - origin).extend(z)));
            self.uv.extend_from_slice(points);
        }
        let back = points.len() as u32;
        self.triangles.extend_from_slice(triangles);
        self.triangles.extend(triangles.iter().map(|&[a, b, c]| [a, c, b].map(|i| i + back)));
        for ring in polygon.ring_ranges() {
            let mut from = ring.end as u32 - 1;
            for to in ring.start as u32..ring.end as u32 {
                self.triangles.push([from + back, to + back, to]);
                self.triangles.push([from + back, to, from]);
                from = to;
            }
        }
        let end = PieceEnd::at(self.vertices.len(), self.triangles.len());
        self.pieces.push(PieceEnd { front: triangles.len() as u32, ..end });
    }

    /// Adds all pieces of another buffer behind these: what was made in parallel comes together in order.
    ///
    /// # Panics
    /// When the two together have more than 2³² vertices or triangles.
    pub fn append(&mut self, other: &PieceMeshes) {
        let before = PieceEnd::at(self.vertices.len(), self.triangles.len());
        PieceEnd::at(
            self.vertices.len() + other.vertices.len(),
            self.triangles.len() + other.triangles.len(),
        );
        self.vertices.extend_from_slice(&other.vertices);
        self.uv.extend_from_slice(&other.uv);
        self.triangles.extend_from_slice(&other.triangles);
        self.pieces.extend(other.pieces.iter().map(|end| PieceEnd {
            vertices: end.vertices + before.vertices,
            triangles: end.triangles + before.triangles,
            front: end.front,
        }));
    }

    /// The piece of this number, in the order in which they were added.
    ///
    /// # Panics
    /// When there are not so many.
    pub fn piece(&self, index: usize) -> PieceMesh<'_> {
        let end = self.pieces[index];
        let start = if index == 0 { PieceEnd::at(0, 0) } else { self.pieces[index - 1] };
        let corners = start.vertices as usize..end.vertices as usize;
        let triangles = &self.triangles[start.triangles as usize..end.triangles as usize];
        let (front, rest) = triangles.split_at(end.front as usize);
        let (back, broken) = rest.split_at(end.front as usize);
        PieceMesh { vertices: &self.vertices[corners.clone()], uv: &self.uv[corners], front, back, broken }
    }

    /// Every piece in order.
    pub fn iter(&self) -> impl Iterator<Item = PieceMesh<'_>> {
        (0..self.len()).map(|index| self.piece(index))
    }

    /// What the arrays hold, in bytes, without spare room.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.vertices[..])
            + size_of_val(&self.uv[..])
            + size_of_val(&self.triangles[..])
            + size_of_val(&self.pieces[..])
    }
}

impl PieceEnd {
    fn at(vertices: usize, triangles: usize) -> Self {
        let end = |count: usize| u32::try_from(count).expect("fewer than 2³² vertices and triangles");
        Self { vertices: end(vertices), triangles: end(triangles), front: 0 }
    }
}

impl PieceMesh<'_> {
    /// The piece as a mesh of its own, front, back and broken faces in this order.
    pub fn to_mesh(&self) -> TriangleMesh {
        TriangleMesh {
            vertices: self.vertices.to_vec(),
            triangles: [self.front, self.back, self.broken].concat(),
        }
    }
}
