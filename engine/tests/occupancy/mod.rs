//! The thesis's own way of growing cracks (5.4.1, 5.4.2): tips creep over a grid of buckets and mark those they
//! pass; a tip that comes into a bucket marked by another one stops.
//!
//! Slow, and only as exact as the grid is fine; it is what the simulation of events is held against. Straight
//! cracks, first in first out, in the unit square.

use std::collections::VecDeque;

use brisance_engine::random;
use glam::DVec2;

/// What became of a tip.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fate {
    Forked,
    /// Stopped by the tip of this number.
    Stopped(usize),
    LeftThePane,
}

struct Tip {
    at: DVec2,
    start: DVec2,
    heading: DVec2,
    parent: usize,
    fate: Option<Fate>,
    draws: u64,
}

/// Fates of all tips, in the order in which they started.
pub fn fates(
    nucleus: DVec2,
    arms: &[f64],
    critical_length: f64,
    fork_angle: f64,
    variance: f64,
    seed: u64,
    buckets: usize,
) -> Vec<Fate> {
    let mut marks = vec![u16::MAX; buckets * buckets];
    let mut tips: Vec<Tip> = Vec::new();
    let mut waiting: VecDeque<usize> = VecDeque::new();
    let start = |at: DVec2, heading: DVec2, parent: usize| Tip {
        at,
        start: at,
        heading,
        parent,
        fate: None,
        draws: 0,
    };
    for &arm in arms {
        waiting.push_back(tips.len());
        tips.push(start(nucleus, DVec2::from_angle(arm), usize::MAX));
    }
    let steps = (critical_length * buckets as f64 * 2.0).ceil();
    let step = critical_length / steps;
    while tips.iter().any(|tip| tip.fate.is_none()) {
        for _ in 0..steps as usize {
            for number in 0..tips.len() {
                if tips[number].fate.is_none() {
                    creep(number, step, buckets, &mut tips, &mut marks);
                }
            }
        }
        while let Some(parent) = waiting.pop_front() {
            if tips[parent].fate.is_some() {
                continue;
            }
            tips[parent].fate = Some(Fate::Forked);
            let mut draw = || {
                tips[parent].draws += 1;
                random::unit(seed, parent as u64, tips[parent].draws)
            };
            let turns = [0.5, -0.5].map(|side| side * (fork_angle + variance * (draw() - 0.5)));
            let swap = draw() < 0.5;
            let mut children = [tips.len(), tips.len() + 1];
            for turn in turns {
                let (at, heading) = (tips[parent].at, tips[parent].heading);
                tips.push(start(at, heading.rotate(DVec2::from_angle(turn)), parent));
            }
            if swap {
                children.reverse();
            }
            waiting.extend(children);
            break;
        }
    }
    tips.into_iter().map(|tip| tip.fate.expect("every tip has ended")).collect()
}

fn creep(number: usize, step: f64, buckets: usize, tips: &mut [Tip], marks: &mut [u16]) {
    let from = tips[number].at;
    let to = from + tips[number].heading * step;
    tips[number].at = to;
    if to.min_element() <= 0.0 || to.max_element() >= 1.0 {
        tips[number].fate = Some(Fate::LeftThePane);
        return;
    }
    let bucket = |p: DVec2| {
        let cell = |x: f64| ((x * buckets as f64) as usize).min(buckets - 1);
        cell(p.y) * buckets + cell(p.x)
    };
    // Half a bucket a step: at most a corner is passed by, which the bucket beside it covers.
    let beside = [DVec2::new(to.x, from.y), DVec2::new(from.x, to.y), to];
    for place in beside.map(bucket) {
        let mark = marks[place] as usize;
        if mark != usize::from(u16::MAX) && mark != number && !close_kin(tips, number, mark, buckets) {
            tips[number].fate = Some(Fate::Stopped(mark));
            return;
        }
    }
    marks[bucket(to)] = number as u16;
}

/// Where a tip starts it shares buckets with its parent and its sibling: there they do not count.
fn close_kin(tips: &[Tip], number: usize, other: usize, buckets: usize) -> bool {
    let (one, two) = (&tips[number], &tips[other]);
    let related = one.parent == other || two.parent == number || one.start == two.start;
    let angle = one.heading.perp_dot(two.heading).abs().max(1e-3);
    let shared = 3.0 / buckets as f64 / angle;
    related && one.at.distance(if two.parent == number { two.start } else { one.start }) < shared
}
