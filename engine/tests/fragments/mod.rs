//! Fragments to test and measure on: mosaics of a pane with T-junctions, bent shards with hundreds of corners,
//! slivers, and pieces with holes.

#![allow(dead_code, reason = "each test and benchmark uses the parts it needs")]

use brisance_engine::geometry::Polygon;
use glam::DVec2;

/// A small generator of uniform numbers (SplitMix64), so that a benchmark and a test see the same fragments.
pub struct Draw(pub u64);

impl Draw {
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    pub fn below(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }
}

/// The unit square cut `cuts` times: each cut is a straight line across one piece, and ends on the pieces beside
/// it as a T-junction, a vertex of theirs in the middle of a side. Neighbours share every vertex bit for bit.
pub fn mosaic(cuts: usize, seed: u64) -> Vec<Polygon> {
    let mut draw = Draw(seed);
    let corner = DVec2::new;
    let mut pieces = vec![vec![corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)]];
    while pieces.len() <= cuts {
        let chosen = largest_of(&pieces, &mut draw);
        cut(&mut pieces, chosen, &mut draw);
    }
    pieces.iter().map(|p| Polygon::new(p)).collect()
}

/// The largest of a few pieces drawn at random: sizes stay within a wide but bounded range.
fn largest_of(pieces: &[Vec<DVec2>], draw: &mut Draw) -> usize {
    let drawn = [(); 3].map(|()| draw.below(pieces.len()));
    drawn.into_iter().max_by(|&a, &b| outline_area(&pieces[a]).total_cmp(&outline_area(&pieces[b]))).unwrap()
}

fn outline_area(ring: &[DVec2]) -> f64 {
    Polygon::new(ring).area()
}

/// Cuts one piece from a point of one side to a point of another, and tells the neighbours of both sides.
fn cut(pieces: &mut Vec<Vec<DVec2>>, chosen: usize, draw: &mut Draw) {
    let ring = pieces[chosen].clone();
    let count = ring.len();
    let first = draw.below(count);
    let second = (first + 1 + draw.below(count - 1)) % count;
    let (first, second) = (first.min(second), first.max(second));
    let [a, b] =
        [first, second].map(|side| ring[side].lerp(ring[(side + 1) % count], draw.between(0.3, 0.7)));
    let one: Vec<DVec2> =
        ring[..=first].iter().copied().chain([a, b]).chain(ring[second + 1..].iter().copied()).collect();
    let other: Vec<DVec2> = [b, a].into_iter().chain(ring[first + 1..=second].iter().copied()).collect();
    // A cut along a straight side (its ends on both halves of it) would leave a piece without area.
    if outline_area(&one) < 1e-9 || outline_area(&other) < 1e-9 {
        return;
    }
    pieces[chosen] = one;
    pieces.push(other);
    for (side, point) in [(first, a), (second, b)] {
        let (from, to) = (ring[side], ring[(side + 1) % count]);
        for neighbour in pieces.iter_mut() {
            let around = neighbour.len();
            if let Some(i) = (0..around).find(|&i| neighbour[i] == to && neighbour[(i + 1) % around] == from)
            {
                neighbour.insert(i + 1, point);
                break;
            }
        }
    }
}

/// A long shard that bends, with about `count` corners, rough edges on both sides and two pointed ends: what the
/// thesis's wiggling cracks leave (Fig. 5.14, 6.1). Its spine is a parabola, so that it cannot cross itself.
pub fn shard(count: usize, seed: u64) -> Polygon {
    let mut draw = Draw(seed);
    let bend = draw.between(-0.8, 0.8);
    let half = count / 2;
    let at = |t: f64, side: f64| DVec2::new(t, bend * t * t + side * 0.1 * (1.0 - t * t));
    let mut along = |side: f64| -> Vec<DVec2> {
        (1..half)
            .map(|i| {
                let t = -1.0 + 2.0 * i as f64 / half as f64;
                at(t, side * draw.between(0.4, 1.0))
            })
            .collect()
    };
    let (below, above) = (along(-1.0), along(1.0));
    let turn = DVec2::from_angle(draw.between(0.0, 6.3));
    let ring = [at(-1.0, 0.0)].into_iter().chain(below).chain([at(1.0, 0.0)]).chain(above.into_iter().rev());
    Polygon::new(&ring.map(|p| turn.rotate(p)).collect::<Vec<_>>())
}

/// A star-shaped ring of `count` corners, at least 4, with radii of 0.3 to 1 times `radius`.
pub fn star(count: usize, centre: DVec2, radius: f64, draw: &mut Draw) -> Vec<DVec2> {
    (0..count)
        .map(|i| {
            let angle = std::f64::consts::TAU * (i as f64 + draw.between(0.0, 0.9)) / count as f64;
            centre + DVec2::from_angle(angle) * radius * draw.between(0.3, 1.0)
        })
        .collect()
}

/// A star-shaped piece of at least 12 corners with holes, in a ring that the outline cannot reach.
pub fn with_holes(count: usize, holes: usize, seed: u64) -> Polygon {
    let mut draw = Draw(seed);
    let mut polygon = Polygon::new(&star(count, DVec2::ZERO, 1.0, &mut draw));
    for i in 0..holes {
        let place = DVec2::from_angle(std::f64::consts::TAU * i as f64 / holes as f64) * 0.13;
        let size = 0.13 * (std::f64::consts::PI / holes.max(3) as f64).sin() * 0.85;
        let corners = 4 + draw.below(6);
        let mut ring = star(corners, place, size, &mut draw);
        ring.reverse();
        polygon.push_ring(ring);
    }
    polygon
}

/// The same polygon with every point moved.
pub fn mapped(polygon: &Polygon, place: impl Fn(DVec2) -> DVec2) -> Polygon {
    let mut moved = Polygon::default();
    for ring in polygon.rings() {
        moved.push_ring(ring.iter().map(|&p| place(p)));
    }
    moved
}
