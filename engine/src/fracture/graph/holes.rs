//! Which walk is a hole in which face: cracks, or holes of the pane, that nothing connects to the rest.

use glam::DVec2;

use super::{Graph, Loop};
use crate::fracture::outline::turn;
use crate::fracture::run::NONE;

/// Half-edges that run downwards, in level strips, to find who is beside a point.
struct Strips {
    low: f64,
    inverse_height: f64,
    /// Half-edges of each strip: `halves[first[s]..first[s + 1]]`, in the order of their numbers.
    first: Vec<u32>,
    halves: Vec<u32>,
}

impl Graph {
    /// Holes as pairs of a face and the walk, sorted by face.
    pub(super) fn holes(&self, loops: &[Loop], loop_of: &[u32]) -> Vec<(u32, u32)> {
        let mut islands: Vec<(u32, DVec2)> = (loops.iter().enumerate())
            .filter(|(_, walk)| !walk.outside && walk.area <= 0.0)
            .map(|(index, walk)| (index as u32, self.leftmost(walk)))
            .collect();
        if islands.is_empty() {
            return Vec::new();
        }
        islands.sort_by(|(_, a), (_, b)| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        let strips = self.strips(loop_of);
        let mut face_of = vec![NONE; loops.len()];
        let mut holes: Vec<(u32, u32)> = Vec::with_capacity(islands.len());
        for (island, point) in islands {
            let Some(beside) = self.left_of(point, island, loop_of, &strips) else { continue };
            // What is left of an island is a face, or an island in the same face, which has been placed already.
            let face = if face_of[beside as usize] == NONE { beside } else { face_of[beside as usize] };
            face_of[island as usize] = face;
            holes.push((face, island));
        }
        holes.sort_unstable();
        holes
    }

    fn leftmost(&self, walk: &Loop) -> DVec2 {
        self.walk(walk)
            .map(|half| self.vertices[self.origin(half) as usize])
            .min_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)))
            .expect("a walk has vertices")
    }

    /// The ends of a half-edge, if it belongs to a walk and runs downwards.
    fn downward(&self, half: u32, loop_of: &[u32]) -> Option<[DVec2; 2]> {
        if loop_of[half as usize] == NONE {
            return None;
        }
        let ends = [self.origin(half), self.target(half)].map(|vertex| self.vertices[vertex as usize]);
        (ends[0].y > ends[1].y).then_some(ends)
    }

    /// As many strips as a square of as many squares as there are edges would have rows.
    fn strips(&self, loop_of: &[u32]) -> Strips {
        let heights = self.vertices.iter().map(|vertex| vertex.y);
        let low = heights.clone().fold(f64::INFINITY, f64::min);
        let high = heights.fold(f64::NEG_INFINITY, f64::max);
        let count = libm::sqrt(self.edges.len() as f64).ceil();
        let mut strips = Strips {
            low,
            inverse_height: count / (high - low),
            first: vec![0; count as usize + 2],
            halves: Vec::new(),
        };
        let spans = |strips: &Strips, half: u32| {
            self.downward(half, loop_of).map(|[from, to]| strips.strip(to.y)..=strips.strip(from.y))
        };
        for half in 0..loop_of.len() as u32 {
            spans(&strips, half).into_iter().flatten().for_each(|strip| strips.first[strip + 1] += 1);
        }
        for strip in 1..strips.first.len() {
            strips.first[strip] += strips.first[strip - 1];
        }
        let mut place = strips.first.clone();
        strips.halves = vec![0; place[place.len() - 1] as usize];
        for half in 0..loop_of.len() as u32 {
            for strip in spans(&strips, half).into_iter().flatten() {
                strips.halves[place[strip] as usize] = half;
                place[strip] += 1;
            }
        }
        strips
    }

    /// The walk whose inside is met first on the way to the left from a point.
    fn left_of(&self, point: DVec2, island: u32, loop_of: &[u32], strips: &Strips) -> Option<u32> {
        let mut nearest: Option<(f64, [DVec2; 2], u32)> = None;
        for &half in strips.beside(point) {
            let walk = loop_of[half as usize];
            let Some([from, to]) = self.downward(half, loop_of).filter(|_| walk != island) else { continue };
            // Downward half-edges have their inside to the right of them.
            if from.y > point.y && to.y <= point.y && turn(from, to, point) > 0.0 {
                let level = (from.y - point.y) / (from.y - to.y);
                let x = if to.y == point.y { to.x } else { from.x + (to.x - from.x) * level };
                // Of two that end in one vertex at this very height, the one farther right above it is nearer.
                let nearer = nearest.is_none_or(|(best, [tail, head], _)| {
                    x > best || (x == best && turn(tail, head, from) > 0.0)
                });
                if nearer {
                    nearest = Some((x, [from, to], walk));
                }
            }
        }
        nearest.map(|(_, _, walk)| walk)
    }
}

impl Strips {
    fn strip(&self, y: f64) -> usize {
        (((y - self.low) * self.inverse_height) as usize).min(self.first.len() - 2)
    }

    fn beside(&self, point: DVec2) -> &[u32] {
        let strip = self.strip(point.y);
        &self.halves[self.first[strip] as usize..self.first[strip + 1] as usize]
    }
}
