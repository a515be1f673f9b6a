//! From masks to shelter: which groups are in front of a body, how deep behind their rim it lies, how far behind
//! them, and how the wave comes round.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;

use super::mask::{FEW, Mask};
use super::raster::Hit;
use super::solid::{Solid, View};
use super::sphere_map::{EDGE_ANGLE, SphereMap, THESIS_RESOLUTION};
use super::{Per, Settings, Shelter};

/// A body is read at no more of its pixels than this, evenly spread.
const MOST_SAMPLES: usize = 4096;

/// Of what is in front on a pixel, this many are looked at, those closest to the body first. What lies before so many
/// hardly adds to the union, and without a bound the cost of a body would grow with the depth of the scene.
const MOST_IN_FRONT: usize = 64;

/// What lies nearer by less than this part of the distance is not in front, but beside.
const BESIDE: f64 = 1e-5;

/// Every group on every pixel, nearest first.
pub(super) struct Columns {
    /// Where each pixel's column starts in `entries`; one more than there are pixels.
    starts: Vec<u32>,
    entries: Vec<ColumnEntry>,
}

#[derive(Debug, Clone, Copy)]
struct ColumnEntry {
    group: u32,
    near: f32,
    far: f32,
    cover: f32,
}

impl Columns {
    pub fn new(map: &SphereMap, masks: &[Mask]) -> Self {
        let mut starts = vec![0_u32; map.len() + 1];
        for entry in masks.iter().flat_map(|mask| &mask.entries) {
            starts[entry.pixel as usize + 1] += 1;
        }
        for pixel in 0..map.len() {
            starts[pixel + 1] += starts[pixel];
        }
        let mut next = starts.clone();
        let none = ColumnEntry { group: 0, near: 0.0, far: 0.0, cover: 0.0 };
        let mut entries = vec![none; starts[map.len()] as usize];
        for (group, mask) in masks.iter().enumerate() {
            for entry in &mask.entries {
                let place = &mut next[entry.pixel as usize];
                let (near, far, cover) = (entry.near, entry.far, entry.cover);
                entries[*place as usize] = ColumnEntry { group: group as u32, near, far, cover };
                *place += 1;
            }
        }
        let columns = starts.windows(2).filter(|pair| pair[1] - pair[0] > 1);
        for pair in columns {
            entries[pair[0] as usize..pair[1] as usize]
                .sort_unstable_by(|a, b| a.near.total_cmp(&b.near).then(a.group.cmp(&b.group)));
        }
        Self { starts, entries }
    }

    fn at(&self, pixel: u32) -> &[ColumnEntry] {
        let pixel = pixel as usize;
        &self.entries[self.starts[pixel] as usize..self.starts[pixel + 1] as usize]
    }

    /// Share of the sphere, or of the half above a ground, in which something stands.
    pub fn enclosed(&self, map: &SphereMap, above: bool) -> f64 {
        let taken: f64 = (0..map.len())
            .filter(|&pixel| self.starts[pixel] < self.starts[pixel + 1])
            .filter(|&pixel| !above || map.centre(pixel).y > 0.0)
            .map(|pixel| {
                let open = self.at(pixel as u32).iter().map(|entry| 1.0 - f64::from(entry.cover));
                (1.0 - open.product::<f64>()) * map.solid_angle(pixel)
            })
            .sum();
        taken / if above { 2.0 * PI } else { 4.0 * PI }
    }
}

/// Reads the shelter of one body after another.
pub(super) struct Reader<'a> {
    pub map: &'a SphereMap,
    pub columns: &'a Columns,
    pub masks: &'a [Mask],
    /// All bodies, and those of each group that hide what is behind them.
    pub views: &'a [View<'a>],
    pub occluders: &'a [Vec<usize>],
    pub eye: DVec3,
    pub settings: &'a Settings,
}

/// What a thread works on; it is left clean between bodies.
pub(super) struct Desk {
    samples: Vec<Sample>,
    /// Groups in front of the body, and for each group the last round in which it was found there.
    listed: Vec<u32>,
    found: Vec<u32>,
    round: u32,
    /// A bit a pixel: the union of the listed groups.
    union: Vec<u64>,
    rims: Vec<RimPoint>,
}

/// A place at which a body's shelter is read.
#[derive(Debug, Clone, Copy)]
struct Sample {
    direction: DVec3,
    pixel: u32,
    distance: f64,
    weight: f64,
    /// Share that is hidden.
    cover: f64,
    /// Rear of the closest occluder [m].
    rear: f64,
    /// Distance value [thesis pixels], and the angle to the rim behind it [rad].
    value: f64,
    depth: f64,
}

#[derive(Debug, Clone, Copy)]
struct RimPoint {
    between: (u32, u32),
    share: f32,
    depth: f64,
    direction: DVec3,
}

impl Reader<'_> {
    pub fn desk(&self) -> Desk {
        Desk {
            samples: Vec::new(),
            listed: Vec::new(),
            found: vec![0; self.masks.len()],
            round: 0,
            union: vec![0; self.map.len().div_ceil(64)],
            rims: Vec::new(),
        }
    }

    /// Shelter of a body, and of its surface points where that is asked for.
    pub fn read(
        &self,
        desk: &mut Desk,
        solid: &Solid,
        view: &View,
        hits: &[Hit],
        group: u32,
    ) -> (Shelter, Vec<Shelter>) {
        self.sample_body(desk, solid, view, hits);
        let body = if self.look(desk, group, false) {
            self.measure(desk);
            self.shelter(desk, &desk.samples)
        } else {
            Shelter::NONE
        };
        if self.settings.per == Per::Body && !solid.by_point {
            return (body, Vec::new());
        }
        desk.samples.clear();
        desk.samples.extend(solid.points.iter().map(|point| self.sample_at(point.position - self.eye, 1.0)));
        if !self.look(desk, group, solid.by_point) {
            return (body, vec![Shelter::NONE; solid.points.len()]);
        }
        self.measure(desk);
        let panels = desk.samples.iter().map(|sample| self.shelter(desk, &[*sample])).collect();
        (body, panels)
    }

    /// The body's own pixels, or, where they are few, the points of its surface that face the charge.
    fn sample_body(&self, desk: &mut Desk, solid: &Solid, view: &View, hits: &[Hit]) {
        let samples = &mut desk.samples;
        samples.clear();
        let first_hits = hits.chunk_by(|a, b| a.pixel == b.pixel).map(|ray| ray[0]);
        let count = first_hits.clone().count();
        if count >= FEW {
            let step = count.div_ceil(MOST_SAMPLES);
            samples.extend(first_hits.step_by(step).map(|hit| Sample {
                direction: self.map.centre(hit.pixel as usize),
                pixel: hit.pixel,
                distance: f64::from(hit.near),
                weight: self.map.solid_angle(hit.pixel as usize),
                ..Sample::NONE
            }));
            return;
        }
        for point in &solid.points {
            let place = point.position - self.eye;
            let seen = -point.area.dot(place);
            if seen > 0.0 {
                let distance = place.length();
                samples.push(self.sample_at(place, seen / (distance * distance * distance)));
            }
        }
        if samples.is_empty() {
            samples.push(self.sample_at(view.middle, 1.0));
        }
    }

    fn sample_at(&self, place: DVec3, weight: f64) -> Sample {
        let distance = place.length();
        let direction = place.try_normalize().unwrap_or(DVec3::X);
        Sample { direction, pixel: self.map.pixel(direction) as u32, distance, weight, ..Sample::NONE }
    }

    /// Lists the groups in front of any sample, and how much of each sample they hide; whether there are any. A sample
    /// stands for its pixel, or, where it is `exact`, for its own ray: all of it is hidden or none.
    fn look(&self, desk: &mut Desk, own: u32, exact: bool) -> bool {
        desk.round += 1;
        desk.listed.clear();
        for sample in &mut desk.samples {
            let front = (sample.distance * (1.0 - BESIDE)) as f32;
            let mut open = 1.0;
            let column = self.columns.at(sample.pixel);
            let nearer = column.partition_point(|entry| entry.near < front);
            let closest =
                column[..nearer].iter().rev().filter(|entry| entry.group != own).take(MOST_IN_FRONT);
            for entry in closest {
                let direction = sample.direction;
                let met = |&body: &usize| self.views[body].is_met(direction);
                if exact && entry.cover < 1.0 && !self.occluders[entry.group as usize].iter().any(met) {
                    continue;
                }
                open *= if exact { 0.0 } else { 1.0 - f64::from(entry.cover) };
                sample.rear = sample.rear.max(f64::from(entry.far).min(sample.distance));
                let found = &mut desk.found[entry.group as usize];
                if *found != desk.round {
                    *found = desk.round;
                    desk.listed.push(entry.group);
                }
            }
            sample.cover = 1.0 - open;
        }
        !desk.listed.is_empty()
    }

    /// Draws the union of the listed groups, as far as they are nearer than the body, and measures each sample's
    /// distance to its rim.
    fn measure(&self, desk: &mut Desk) {
        let farthest = end_of_front(&desk.samples) as f32;
        let drawn = |group: &u32| {
            let mask = &self.masks[*group as usize];
            mask.entries.iter().filter(|entry| !mask.unmet && entry.near < farthest)
        };
        for entry in desk.listed.iter().flat_map(drawn) {
            desk.union[entry.pixel as usize / 64] |= 1 << (entry.pixel % 64);
        }
        self.collect_rims(desk, farthest);
        let pixels_a_radian = THESIS_RESOLUTION / EDGE_ANGLE;
        for sample in desk.samples.iter_mut().filter(|sample| sample.cover > 0.0) {
            let inside = desk.union[sample.pixel as usize / 64] & (1 << (sample.pixel % 64)) != 0;
            if inside {
                let nearest = desk
                    .rims
                    .iter()
                    .map(|rim| rim.direction.distance_squared(sample.direction))
                    .fold(4.0, f64::min);
                sample.depth = 2.0 * libm::asin((0.5 * libm::sqrt(nearest)).min(1.0));
            }
            sample.value = sample.cover * (sample.depth * pixels_a_radian + 0.5);
        }
        for entry in desk.listed.iter().flat_map(drawn) {
            desk.union[entry.pixel as usize / 64] = 0;
        }
    }

    /// The union's rim: where a listed group ends and no other goes on. Between two pixels the group that reaches
    /// farthest counts.
    fn collect_rims(&self, desk: &mut Desk, farthest: f32) {
        let (union, rims) = (&desk.union, &mut desk.rims);
        rims.clear();
        let is_drawn = |pixel: u32| union[pixel as usize / 64] & (1 << (pixel % 64)) != 0;
        for &group in &desk.listed {
            let own = self.masks[group as usize].rims.iter();
            rims.extend(own.filter(|rim| rim.near < farthest && !is_drawn(rim.beyond)).map(|rim| RimPoint {
                between: (rim.pixel, rim.beyond),
                share: rim.share,
                depth: f64::from(rim.depth),
                direction: rim.direction,
            }));
            rims.extend(self.cut_rims(group, farthest).filter(|rim| !is_drawn(rim.between.1)));
        }
        if desk.listed.len() > 1 {
            rims.sort_unstable_by(|a, b| a.between.cmp(&b.between).then(b.share.total_cmp(&a.share)));
            rims.dedup_by_key(|rim| rim.between);
        }
    }

    /// Where a group goes on, but only beyond `farthest`: to the body it ends there, half-way between two pixels.
    fn cut_rims(&self, group: u32, farthest: f32) -> impl Iterator<Item = RimPoint> {
        let (map, mask) = (self.map, &self.masks[group as usize]);
        let is_cut = mask.entries.iter().any(|entry| entry.near >= farthest);
        let near = mask.entries.iter().filter(move |entry| is_cut && entry.near < farthest);
        near.flat_map(move |entry| {
            let inside = map.centre(entry.pixel as usize);
            map.neighbours(entry.pixel as usize)
                .into_iter()
                .filter(move |&beyond| mask.nearest(beyond as u32).is_some_and(|depth| depth >= farthest))
                .map(move |beyond| RimPoint {
                    between: (entry.pixel, beyond as u32),
                    share: 0.5,
                    depth: f64::from(entry.near),
                    direction: (inside + map.centre(beyond)).normalize(),
                })
        })
    }

    /// Sums up samples.
    fn shelter(&self, desk: &Desk, samples: &[Sample]) -> Shelter {
        let sum = |of: fn(&Sample) -> f64| samples.iter().map(of).sum::<f64>();
        let weight = sum(|s| s.weight);
        let hidden = sum(|s| s.weight * s.cover);
        if hidden == 0.0 {
            return Shelter::NONE;
        }
        let blocking = sum(|s| s.weight * s.value) / weight;
        let separation =
            sum(|s| s.weight * s.cover * (s.distance - s.rear)) / sum(|s| s.weight * s.cover * s.distance);
        Shelter {
            hidden: hidden / weight,
            blocking,
            separation,
            attenuation: self.settings.attenuation.factor(blocking, separation),
            detour: detour(desk, samples),
        }
    }
}

impl Sample {
    const NONE: Self = Self {
        direction: DVec3::X,
        pixel: 0,
        distance: 0.0,
        weight: 0.0,
        cover: 0.0,
        rear: 0.0,
        value: 0.0,
        depth: 0.0,
    };
}

/// How far the side of a body that the charge sees reaches [m]: two standard deviations beyond its mean distance,
/// which a few rays that graze its flank do not change.
fn end_of_front(samples: &[Sample]) -> f64 {
    let mean_of = |value: &dyn Fn(&Sample) -> f64| {
        let (sum, weight) = samples.iter().fold((0.0, 0.0), |(sum, weight), sample| {
            (sum + sample.weight * value(sample), weight + sample.weight)
        });
        sum / weight
    };
    let mean = mean_of(&|sample| sample.distance);
    let variance = mean_of(&|sample| (sample.distance - mean) * (sample.distance - mean));
    mean + 2.0 * libm::sqrt(variance)
}

/// How much longer than straight the shortest way is that bends once, at the rim, to the sample next to it [m]. None
/// where part of a sample is open, and none can be told where the occluders have no rim.
fn detour(desk: &Desk, samples: &[Sample]) -> f64 {
    let fully = |sample: &Sample| sample.cover > 1.0 - 1e-9;
    if !samples.iter().all(fully) {
        return 0.0;
    }
    let Some(first) = samples.iter().min_by(|a, b| a.depth.total_cmp(&b.depth)) else { return 0.0 };
    let place = first.direction * first.distance;
    let way = desk
        .rims
        .iter()
        .map(|rim| rim.depth + place.distance(rim.direction * rim.depth))
        .fold(f64::INFINITY, f64::min);
    if way.is_finite() && first.depth < FRAC_PI_2 { (way - first.distance).max(0.0) } else { 0.0 }
}
