//! The sphere around a charge, cut into pixels: an icosahedron whose faces are cut into small triangles.
//!
//! The thesis (4.2.1) surrounds the bomb with an icosahedron because its twenty faces are near to a sphere and
//! unfold into the plane (Fig. 4.3). It measures distances on that sheet, which cuts a body in two wherever it
//! spans faces that are apart on the sheet. Here a pixel knows its neighbours on the sphere itself, so the map has
//! no seam.
//!
//! Each face is cut into N² triangles by N − 1 lines parallel to each of its edges. A point of a face is given by
//! its shares `u`, `v`, `w` of the face's three corners, with `u + v + w = N`; the pixel at (`i`, `j`) is the
//! triangle `u ≥ i, v ≥ j, u + v ≤ i + j + 1`, or, `down`, the one across its long side.

use glam::{DMat3, DVec2, DVec3};

use crate::error::{Error, Result};

/// Faces of an icosahedron.
pub const FACES: usize = 20;

/// Angle between two neighbouring corners of the icosahedron [rad]: 63.43°.
pub const EDGE_ANGLE: f64 = 1.107_148_717_794_090_4;

/// Pixels along an edge in the thesis, whose blocking factors its attenuation is made for.
pub const THESIS_RESOLUTION: f64 = 32.0;

/// Height of the ring of five corners next to a pole, `1/√5`, and the radius of that ring.
const RING: (f64, f64) = (0.447_213_595_499_957_9, 0.894_427_190_999_915_9);

/// A sphere map of one resolution. It knows directions and pixels and no body.
#[derive(Debug, Clone)]
pub struct SphereMap {
    resolution: usize,
    faces: Vec<Face>,
    /// The pixel across each border edge: face, edge, place along the edge.
    borders: Vec<u32>,
}

#[derive(Debug, Clone)]
struct Face {
    corners: [DVec3; 3],
    /// Takes a direction to its shares of the three corners, up to a factor.
    shares: DMat3,
    middle: DVec3,
}

/// Where in its face a pixel is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PixelPlace {
    /// Number of the face, 0 to 19.
    pub face: usize,
    /// First share, rounded down.
    pub i: usize,
    /// Second share, rounded down.
    pub j: usize,
    /// Whether it is the second triangle of its rhombus.
    pub down: bool,
}

impl SphereMap {
    /// Resolutions that a map may have.
    pub const RESOLUTIONS: std::ops::RangeInclusive<usize> = 4..=512;

    /// A map with `resolution` pixels along an edge of the icosahedron.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a resolution outside [`RESOLUTIONS`](Self::RESOLUTIONS).
    pub fn new(resolution: usize) -> Result<Self> {
        Self::check_resolution(resolution)?;
        let corners = corners();
        let faces = FACE_CORNERS
            .iter()
            .map(|face| {
                let corners = face.map(|index| corners[index]);
                let [a, b, c] = corners;
                Face { corners, shares: DMat3::from_cols(a, b, c).inverse(), middle: (a + b + c).normalize() }
            })
            .collect();
        let mut map = Self { resolution, faces, borders: Vec::new() };
        map.borders = map.find_borders();
        Ok(map)
    }

    pub(super) fn check_resolution(resolution: usize) -> Result<()> {
        if Self::RESOLUTIONS.contains(&resolution) {
            return Ok(());
        }
        let expected = "a whole number from 4 to 512";
        Err(Error::OutOfRange { what: "occlusion resolution", value: resolution as f64, expected })
    }

    /// Pixels along an edge.
    pub fn resolution(&self) -> usize {
        self.resolution
    }

    /// Number of pixels on the whole sphere, 20 N².
    pub fn len(&self) -> usize {
        FACES * self.resolution * self.resolution
    }

    /// Never true: a map has pixels.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// The pixel that holds a direction (any length above 0).
    pub fn pixel(&self, direction: DVec3) -> usize {
        let best = |a: &usize, b: &usize| {
            self.faces[*a].middle.dot(direction).total_cmp(&self.faces[*b].middle.dot(direction))
        };
        let face = (0..FACES).max_by(best).expect("twenty faces");
        self.pixel_on(face, direction)
    }

    fn pixel_on(&self, face: usize, direction: DVec3) -> usize {
        let n = self.resolution as f64;
        let shares = self.faces[face].shares * direction;
        let scale = n / shares.element_sum();
        let last = self.resolution - 1;
        let (u, v) = ((shares.x * scale).max(0.0), (shares.y * scale).max(0.0));
        let i = (u as usize).min(last);
        let j = (v as usize).min(last - i);
        let down = u - i as f64 + v - j as f64 > 1.0 && i + j < last;
        self.index(PixelPlace { face, i, j, down })
    }

    /// Number of a pixel.
    pub fn index(&self, place: PixelPlace) -> usize {
        let n = self.resolution;
        let rest = n - place.i;
        place.face * n * n + (n * n - rest * rest) + 2 * place.j + usize::from(place.down)
    }

    /// Where a pixel is.
    pub fn place(&self, pixel: usize) -> PixelPlace {
        let size = self.resolution * self.resolution;
        let (face, local) = (pixel / size, pixel % size);
        // Strips of equal i hold 2(N − i) − 1 pixels, so N − i is the root of what is left, rounded up.
        let left = size - local;
        let mut rest = libm::sqrt(left as f64) as usize;
        rest += usize::from(rest * rest < left);
        let along = local - (size - rest * rest);
        PixelPlace { face, i: self.resolution - rest, j: along / 2, down: along % 2 == 1 }
    }

    /// Direction of a pixel's centre, a unit vector.
    pub fn centre(&self, pixel: usize) -> DVec3 {
        self.plane_centre(self.place(pixel)).normalize()
    }

    /// The pixel's centre on the face's plane, whose corners lie on the unit sphere.
    fn plane_centre(&self, place: PixelPlace) -> DVec3 {
        let third = if place.down { 2.0 / 3.0 } else { 1.0 / 3.0 };
        let (u, v) = (place.i as f64 + third, place.j as f64 + third);
        self.plane_point(place.face, u, v)
    }

    fn plane_point(&self, face: usize, u: f64, v: f64) -> DVec3 {
        let n = self.resolution as f64;
        let [a, b, c] = self.faces[face].corners;
        (a * u + b * v + c * (n - u - v)) / n
    }

    /// Solid angle of a pixel [sr], to second order in its size: pixels near a face's corners look smaller.
    pub fn solid_angle(&self, pixel: usize) -> f64 {
        let [a, b, c] = self.faces[0].corners;
        let area = 0.5 * (b - a).cross(c - a).length() / (self.resolution * self.resolution) as f64;
        let height = a.dot(self.faces[0].middle);
        let distance = self.plane_centre(self.place(pixel)).length();
        area * height / (distance * distance * distance)
    }

    /// The three pixels that share an edge with a pixel, on the sphere.
    pub fn neighbours(&self, pixel: usize) -> [usize; 3] {
        let place = self.place(pixel);
        let PixelPlace { face, i, j, .. } = place;
        if place.down {
            return [(i + 1, j), (i, j + 1), (i, j)]
                .map(|(i, j)| self.index(PixelPlace { face, i, j, down: false }));
        }
        let down = |i, j| self.index(PixelPlace { face, i, j, down: true });
        [
            if i > 0 { down(i - 1, j) } else { self.border(face, 0, j) },
            if j > 0 { down(i, j - 1) } else { self.border(face, 1, i) },
            if i + j + 1 < self.resolution { down(i, j) } else { self.border(face, 2, i) },
        ]
    }

    fn border(&self, face: usize, edge: usize, along: usize) -> usize {
        self.borders[(face * 3 + edge) * self.resolution + along] as usize
    }

    fn find_borders(&self) -> Vec<u32> {
        let n = self.resolution as f64;
        let mut borders = Vec::with_capacity(FACES * 3 * self.resolution);
        for face in 0..FACES {
            for edge in 0..3 {
                let across = self.face_across(face, edge);
                for along in 0..self.resolution {
                    let at = along as f64 + 0.5;
                    let (u, v) = [(0.0, at), (at, 0.0), (at, n - at)][edge];
                    // A thousandth of a pixel inward keeps rounding from choosing the wrong side.
                    let inward = self.faces[across].middle * (1e-3 / n);
                    borders.push(self.pixel_on(across, self.plane_point(face, u, v) + inward) as u32);
                }
            }
        }
        borders
    }

    /// The face that shares the edge opposite the corner `edge`.
    fn face_across(&self, face: usize, edge: usize) -> usize {
        let own = FACE_CORNERS[face];
        let shared = [own[(edge + 1) % 3], own[(edge + 2) % 3]];
        (0..FACES)
            .find(|&other| other != face && shared.iter().all(|corner| FACE_CORNERS[other].contains(corner)))
            .expect("every edge has two faces")
    }

    /// Direction of a face's middle, and the cosine of the angle from there to its corners.
    pub(super) fn cone(&self, face: usize) -> (DVec3, f64) {
        let face = &self.faces[face];
        (face.middle, face.middle.dot(face.corners[0]))
    }

    /// Shares `u`, `v`, `w` of a face's corners in the point where a ray along `direction` meets the face's plane;
    /// `None` where it does not.
    pub(super) fn shares(&self, face: usize, direction: DVec3) -> Option<DVec3> {
        let shares = self.faces[face].shares * direction;
        let sum = shares.element_sum();
        (sum > 1e-9 * direction.length()).then(|| shares * (self.resolution as f64 / sum))
    }

    /// Every pixel of a face between bounds on its shares, with the centre's direction (not of unit length).
    pub(super) fn for_each_between(
        &self,
        face: usize,
        low: DVec3,
        high: DVec3,
        mut visit: impl FnMut(usize, DVec3),
    ) {
        let n = self.resolution;
        if low.max_element() > n as f64 || high.min_element() < 0.0 {
            return;
        }
        let floor = |x: f64| x.max(0.0) as usize;
        let last = floor(high.x).min(n - 1);
        for i in floor(low.x)..=last {
            // u + v lies in [i, i + 2) within the strip, so w bounds j as well.
            let most = high.y.min(n as f64 - i as f64 - low.z);
            let least = low.y.max(n as f64 - (i + 2) as f64 - high.z);
            if most < 0.0 {
                continue;
            }
            for j in floor(least)..=floor(most).min(n - 1 - i) {
                for down in [false, true] {
                    if down && i + j + 1 == n {
                        continue;
                    }
                    let place = PixelPlace { face, i, j, down };
                    visit(self.index(place), self.plane_centre(place));
                }
            }
        }
    }

    /// Corners of a pixel on the unfolded sheet of Fig. 4.3, counter-clockwise from outside, in edge lengths.
    ///
    /// The sheet is 5.5 wide and 3 rows high: five triangles point up, ten alternate, five point down.
    pub fn unfolded(&self, pixel: usize) -> [DVec2; 3] {
        let PixelPlace { face, i, j, down } = self.place(pixel);
        let (u, v) = (i as f64, j as f64);
        let corners = if down {
            [(u + 1.0, v + 1.0), (u, v + 1.0), (u + 1.0, v)]
        } else {
            [(u, v), (u + 1.0, v), (u, v + 1.0)]
        };
        let [a, b, c] = sheet(face);
        let n = self.resolution as f64;
        corners.map(|(u, v)| (a * u + b * v + c * (n - u - v)) / n)
    }
}

/// The top corner, the upper and the lower ring of five, and the bottom corner. The upper ring starts at −z.
fn corners() -> [DVec3; 12] {
    let (height, radius) = RING;
    let mut corners = [DVec3::Y; 12];
    for k in 0..5 {
        let turn = std::f64::consts::TAU / 10.0;
        let on_ring = |step: f64, y: f64| {
            let angle = step * turn;
            DVec3::new(radius * libm::sin(angle), y, -radius * libm::cos(angle))
        };
        corners[1 + k] = on_ring(2.0 * k as f64, height);
        corners[6 + k] = on_ring(2.0 * k as f64 + 1.0, -height);
    }
    corners[11] = DVec3::NEG_Y;
    corners
}

/// Corners of each face, counter-clockwise seen from outside: five around the top, ten in the middle that alternate,
/// five around the bottom.
const FACE_CORNERS: [[usize; 3]; FACES] = {
    let mut faces = [[0; 3]; FACES];
    let mut k = 0;
    while k < 5 {
        let next = (k + 1) % 5;
        faces[k] = [0, 1 + next, 1 + k];
        faces[5 + 2 * k] = [1 + k, 1 + next, 6 + k];
        faces[6 + 2 * k] = [1 + next, 6 + next, 6 + k];
        faces[15 + k] = [11, 6 + k, 6 + next];
        k += 1;
    }
    faces
};

/// Corners of a face on the unfolded sheet, in the order of [`FACE_CORNERS`].
fn sheet(face: usize) -> [DVec2; 3] {
    let height = 0.5 * libm::sqrt(3.0);
    let at = |x: f64, row: f64| DVec2::new(x, row * height);
    let column = match face {
        0..5 => face,
        5..15 => (face - 5) / 2,
        _ => face - 15,
    } as f64;
    // As the charge sees it: to the right is clockwise seen from above.
    match face {
        0..5 => [at(column + 0.5, 3.0), at(column + 1.0, 2.0), at(column, 2.0)],
        5..15 if face % 2 == 1 => [at(column, 2.0), at(column + 1.0, 2.0), at(column + 0.5, 1.0)],
        5..15 => [at(column + 1.0, 2.0), at(column + 1.5, 1.0), at(column + 0.5, 1.0)],
        _ => [at(column + 1.0, 0.0), at(column + 0.5, 1.0), at(column + 1.5, 1.0)],
    }
}
