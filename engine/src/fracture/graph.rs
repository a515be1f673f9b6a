//! From traces to fragments: the faces of the planar graph that the cracks draw.
//!
//! Which vertex lies where on which trace is known from the growth, so nothing is intersected anew. Places nearer
//! than the resolution become one vertex, dangling ends are cut off, edges are put in order round each vertex by
//! exact predicates, and every face is walked with its area on the left. Stems are cut off too: where a crack curls
//! up and meets itself, the way there has the same face on both sides.

mod holes;

use core::cmp::Ordering;

use glam::DVec2;

use super::growth::{Stop, Traces};
use super::order;
use super::outline::turn;
use super::run::NONE;
use super::settings::Settings;

/// Faces as rings of vertices.
#[derive(Debug, Default)]
pub(super) struct Faces {
    pub vertices: Vec<DVec2>,
    /// Vertices of all rings, one after the other.
    pub rings: Vec<u32>,
    /// For each entry of `rings`, whether the side that starts there is a piece of the border.
    pub on_border: Vec<bool>,
    /// Where each ring ends.
    pub ring_ends: Vec<u32>,
    /// After how many rings each face ends; the first of a face is its outline, the others are holes.
    pub face_ends: Vec<u32>,
    /// Growth at which each face's outline closed [m].
    pub closed_at: Vec<f64>,
}

/// A straight side between neighbouring vertices of a trace, in the direction in which it was cut.
#[derive(Debug, Clone, Copy)]
struct Edge {
    from: u32,
    to: u32,
    /// Growth at which it was complete [m]; −∞ on the border.
    time: f64,
}

struct Graph {
    vertices: Vec<DVec2>,
    edges: Vec<Edge>,
    /// Edges before this one are the border's.
    borders: usize,
    /// Half-edges that leave each vertex: `leaving[first[v]..first[v + 1]]`, counter-clockwise. Half-edge 2e runs
    /// along edge e and 2e + 1 against it.
    leaving: Vec<u32>,
    first: Vec<u32>,
    /// The half-edge that follows on the outline of the face to the left.
    next: Vec<u32>,
}

/// How far what only touches is moved apart, as a share of its shortest side there.
const APART: f64 = 1e-6;

/// A closed walk along half-edges.
struct Loop {
    start: u32,
    length: u32,
    area: f64,
    outside: bool,
}

/// The faces that traces bound, in a fixed order.
pub(super) fn faces(traces: &Traces, settings: &Settings) -> Faces {
    let mut graph = Graph::new(traces, settings);
    let (loops, loop_of) = graph.part();
    let holes = graph.holes(&loops, &loop_of);
    let mut faces = Faces::default();
    for (index, walk) in loops.iter().enumerate() {
        if walk.outside || walk.area <= 0.0 {
            continue;
        }
        let mut closed = graph.append_ring(walk, &mut faces);
        let first = holes.partition_point(|&(face, _)| face < index as u32);
        for &(_, hole) in holes[first..].iter().take_while(|&&(face, _)| face == index as u32) {
            closed = closed.max(graph.append_ring(&loops[hole as usize], &mut faces));
        }
        faces.face_ends.push(faces.ring_ends.len() as u32);
        faces.closed_at.push(closed.max(0.0));
    }
    faces.vertices = graph.vertices;
    faces
}

impl Graph {
    fn new(traces: &Traces, settings: &Settings) -> Self {
        let mut stops = order::sorted_stops(traces, settings);
        let vertices = order::renumber(&mut stops, &traces.vertices, traces.borders);
        let merged = merge_close(&stops, vertices.len(), traces.resolution);
        let mut edges = Vec::with_capacity(stops.len());
        let mut borders = 0;
        for pair in stops.windows(2) {
            let (from, to) = (merged.root(pair[0].vertex), merged.root(pair[1].vertex));
            if pair[0].trace != pair[1].trace || from == to {
                continue;
            }
            let on_border = (pair[0].trace as usize) < traces.borders;
            borders += usize::from(on_border);
            let cut = || pair[1].at + settings.delay(vertices[to as usize]);
            edges.push(Edge { from, to, time: if on_border { f64::NEG_INFINITY } else { cut() } });
        }
        Self { vertices, edges, borders, leaving: Vec::new(), first: Vec::new(), next: Vec::new() }
    }

    /// Every walk round a face and for each half-edge the one it belongs to, once only such edges are left as part
    /// one face from another, and no walk comes by the same vertex twice: every face is then a simple polygon.
    fn part(&mut self) -> (Vec<Loop>, Vec<u32>) {
        let mut gone = self.dangling();
        loop {
            self.connect(&gone);
            let (loops, loop_of) = self.loops();
            let bridges = (0..self.edges.len()).filter(|&e| !gone[e] && loop_of[2 * e] == loop_of[2 * e + 1]);
            let bridges: Vec<usize> = bridges.collect();
            bridges.iter().for_each(|&edge| gone[edge] = true);
            if bridges.is_empty() && !self.split_pinches(&loop_of) {
                return (loops, loop_of);
            }
        }
    }

    /// Takes apart what hangs together by a single vertex, as petals do at a nucleus: each gets a vertex of its own,
    /// a hair's breadth into it. Returns whether there was any.
    fn split_pinches(&mut self, loop_of: &[u32]) -> bool {
        let mut found = false;
        for vertex in 0..self.first.len() - 1 {
            let fan = &self.leaving[self.first[vertex] as usize..self.first[vertex + 1] as usize];
            if fan.len() < 4 {
                continue;
            }
            // Between each half-edge and the next lies the face of its walk: where one face lies twice, the
            // half-edges from one place to the other touch the rest in this vertex alone.
            let same = |&(i, j): &(usize, usize)| loop_of[fan[i] as usize] == loop_of[fan[j] as usize];
            let pairs = (0..fan.len()).flat_map(|i| (i + 1..fan.len()).map(move |j| (i, j)));
            let Some((i, j)) = pairs.into_iter().find(same) else { continue };
            let inner = fan[i + 1..=j].to_vec();
            let outer: Vec<u32> = fan[j + 1..].iter().chain(&fan[..=i]).copied().collect();
            let fixed = |group: &[u32]| group.iter().any(|&half| (half as usize / 2) < self.borders);
            let moved = match (fixed(&inner), fixed(&outer)) {
                (true, _) => outer,
                (_, true) => inner,
                _ if self.span(&inner) <= self.span(&outer) => inner,
                _ => outer,
            };
            self.move_apart(vertex as u32, &moved);
            found = true;
        }
        found
    }

    /// Angle from the first to the last of some half-edges of a fan, counter-clockwise [rad].
    fn span(&self, fan: &[u32]) -> f64 {
        let [first, last] = [fan[0], fan[fan.len() - 1]].map(|half| self.heading(half));
        let angle = libm::atan2(first.perp_dot(last), first.dot(last));
        if angle < 0.0 { angle + 2.0 * core::f64::consts::PI } else { angle }
    }

    fn heading(&self, half: u32) -> DVec2 {
        self.vertices[self.target(half) as usize] - self.vertices[self.origin(half) as usize]
    }

    /// Gives some half-edges of a vertex's fan a vertex of their own, moved into what they enclose.
    fn move_apart(&mut self, vertex: u32, fan: &[u32]) {
        let [first, last] = [fan[0], fan[fan.len() - 1]].map(|half| self.heading(half).normalize());
        let middle = (first + last).try_normalize().unwrap_or(first.perp());
        let middle = if self.span(fan) > core::f64::consts::PI { -middle } else { middle };
        let shortest = fan.iter().map(|&half| self.heading(half).length()).fold(f64::INFINITY, f64::min);
        let own = self.vertices.len() as u32;
        self.vertices.push(self.vertices[vertex as usize] + middle * (APART * shortest));
        for &half in fan {
            let edge = &mut self.edges[half as usize / 2];
            *(if half.is_multiple_of(2) { &mut edge.from } else { &mut edge.to }) = own;
        }
    }

    /// Puts the edges in order round each vertex, without those that are gone.
    fn connect(&mut self, gone: &[bool]) {
        self.list_leaving(gone);
        self.order_leaving();
        self.link();
    }

    fn origin(&self, half: u32) -> u32 {
        let edge = self.edges[half as usize / 2];
        if half.is_multiple_of(2) { edge.from } else { edge.to }
    }

    fn target(&self, half: u32) -> u32 {
        self.origin(half ^ 1)
    }

    /// Edges that do not part one face from another: chains that end at a vertex with no other edge.
    fn dangling(&self) -> Vec<bool> {
        // The exclusive or of a vertex's edges is the last one left when all others have gone.
        let mut degree = vec![0u32; self.vertices.len()];
        let mut mixed = vec![0u32; self.vertices.len()];
        for (index, edge) in self.edges.iter().enumerate() {
            for end in [edge.from, edge.to] {
                degree[end as usize] += 1;
                mixed[end as usize] ^= index as u32;
            }
        }
        let mut gone = vec![false; self.edges.len()];
        for start in 0..self.vertices.len() {
            let mut end = start;
            while degree[end] == 1 {
                let index = mixed[end];
                let edge = self.edges[index as usize];
                gone[index as usize] = true;
                degree[end] = 0;
                end = if edge.from as usize == end { edge.to } else { edge.from } as usize;
                degree[end] -= 1;
                mixed[end] ^= index;
            }
        }
        gone
    }

    fn list_leaving(&mut self, gone: &[bool]) {
        let mut first = vec![0u32; self.vertices.len() + 1];
        let halves = |edges: &[Edge]| (0..2 * edges.len() as u32).filter(|&h| !gone[h as usize / 2]);
        for half in halves(&self.edges) {
            first[self.origin(half) as usize + 1] += 1;
        }
        for vertex in 0..self.vertices.len() {
            first[vertex + 1] += first[vertex];
        }
        let mut place = first.clone();
        self.leaving = vec![0; *first.last().expect("one more than vertices") as usize];
        for half in halves(&self.edges) {
            let slot = &mut place[self.origin(half) as usize];
            self.leaving[*slot as usize] = half;
            *slot += 1;
        }
        self.first = first;
    }

    fn order_leaving(&mut self) {
        let mut leaving = core::mem::take(&mut self.leaving);
        for vertex in 0..self.vertices.len() {
            let fan = &mut leaving[self.first[vertex] as usize..self.first[vertex + 1] as usize];
            if fan.len() > 2 {
                let centre = self.vertices[vertex];
                fan.sort_by(|&a, &b| {
                    let ends = [a, b].map(|half| self.vertices[self.target(half) as usize]);
                    around(centre, ends[0], ends[1]).then(a.cmp(&b))
                });
            }
        }
        self.leaving = leaving;
    }

    /// The half-edge that follows is the next one clockwise from the way back: the same face stays on the left.
    fn link(&mut self) {
        self.next = vec![NONE; 2 * self.edges.len()];
        for vertex in 0..self.vertices.len() {
            let fan = &self.leaving[self.first[vertex] as usize..self.first[vertex + 1] as usize];
            for (i, &half) in fan.iter().enumerate() {
                let before = if i == 0 { fan.len() - 1 } else { i - 1 };
                self.next[(half ^ 1) as usize] = fan[before];
            }
        }
    }

    /// Every walk, and for each half-edge the one it belongs to.
    fn loops(&self) -> (Vec<Loop>, Vec<u32>) {
        let mut loop_of = vec![NONE; self.next.len()];
        let mut loops = Vec::new();
        for start in 0..self.next.len() as u32 {
            if loop_of[start as usize] != NONE || self.next[start as usize] == NONE {
                continue;
            }
            let base = self.vertices[self.origin(start) as usize];
            let mut walk = Loop { start, length: 0, area: 0.0, outside: false };
            let (mut half, mut here) = (start, base);
            loop {
                loop_of[half as usize] = loops.len() as u32;
                let there = self.vertices[self.target(half) as usize];
                walk.area += 0.5 * (here - base).perp_dot(there - base);
                walk.length += 1;
                walk.outside |= !half.is_multiple_of(2) && (half as usize / 2) < self.borders;
                here = there;
                half = self.next[half as usize];
                if half == start {
                    break;
                }
            }
            loops.push(walk);
        }
        (loops, loop_of)
    }

    fn walk(&self, walk: &Loop) -> impl Iterator<Item = u32> + '_ {
        let mut half = walk.start;
        (0..walk.length).map(move |_| {
            let now = half;
            half = self.next[half as usize];
            now
        })
    }

    /// Appends a walk as a ring; returns when it closed.
    fn append_ring(&self, walk: &Loop, faces: &mut Faces) -> f64 {
        let mut closed = f64::NEG_INFINITY;
        for half in self.walk(walk) {
            let edge = half as usize / 2;
            faces.rings.push(self.origin(half));
            faces.on_border.push(edge < self.borders);
            closed = closed.max(self.edges[edge].time);
        }
        faces.ring_ends.push(faces.rings.len() as u32);
        closed
    }
}

/// Order of two points counter-clockwise round a centre, from the direction +x. Exact.
fn around(centre: DVec2, a: DVec2, b: DVec2) -> Ordering {
    let lower = |p: DVec2| p.y < centre.y || (p.y == centre.y && p.x < centre.x);
    lower(a).cmp(&lower(b)).then_with(|| 0.0.partial_cmp(&turn(centre, a, b)).expect("vertices are finite"))
}

/// Sets of vertices that are one.
struct Merged {
    parent: Vec<u32>,
}

impl Merged {
    fn root(&self, mut vertex: u32) -> u32 {
        while self.parent[vertex as usize] != vertex {
            vertex = self.parent[vertex as usize];
        }
        vertex
    }
}

/// Makes neighbours on a trace one that are nearer than the resolution; the lower number stays, so that corners of
/// the pane keep their places.
fn merge_close(stops: &[Stop], vertices: usize, resolution: f64) -> Merged {
    let mut merged = Merged { parent: (0..vertices as u32).collect() };
    for pair in stops.windows(2) {
        if pair[0].trace == pair[1].trace && pair[1].at - pair[0].at < resolution {
            let (a, b) = (merged.root(pair[0].vertex), merged.root(pair[1].vertex));
            merged.parent[a.max(b) as usize] = a.min(b);
        }
    }
    merged
}
