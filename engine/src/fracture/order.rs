//! Numbers for traces and vertices under which what is near in the pane is near in memory.
//!
//! Cracks grow all over the pane at once, so the numbers they get as they grow lie scattered. Fragments are walked from
//! neighbour to neighbour, and with a million of them every step would be a cache miss.

use glam::DVec2;

use super::growth::{Stop, Traces};
use super::run::NONE;
use super::settings::Settings;
use crate::geometry::bounds;

/// Bits of a place along each axis.
const BITS: u32 = 16;

/// Stops trace by trace and along each trace by place: the border first, then tree by tree, neighbours after each other.
pub(super) fn sorted_stops(traces: &Traces, settings: &Settings) -> Vec<Stop> {
    let ranks = ranks(traces, settings);
    let mut first = vec![0u32; ranks.len() + 1];
    for stop in &traces.stops {
        first[ranks[stop.trace as usize] as usize + 1] += 1;
    }
    for rank in 0..ranks.len() {
        first[rank + 1] += first[rank];
    }
    let mut place = first.clone();
    let mut sorted = vec![Stop { trace: 0, at: 0.0, vertex: 0 }; traces.stops.len()];
    for stop in &traces.stops {
        let slot = &mut place[ranks[stop.trace as usize] as usize];
        sorted[*slot as usize] = *stop;
        *slot += 1;
    }
    for pair in first.windows(2) {
        sorted[pair[0] as usize..pair[1] as usize]
            .sort_unstable_by(|a, b| a.at.total_cmp(&b.at).then(a.vertex.cmp(&b.vertex)));
    }
    sorted
}

/// Numbers vertices in the order in which stops come by them; the corners of the border keep theirs, and so the first.
pub(super) fn renumber(stops: &mut [Stop], vertices: &[DVec2], corners: usize) -> Vec<DVec2> {
    let mut number: Vec<u32> =
        (0..vertices.len() as u32).map(|v| if (v as usize) < corners { v } else { NONE }).collect();
    let mut ordered = Vec::with_capacity(vertices.len());
    ordered.extend_from_slice(&vertices[..corners]);
    for stop in stops {
        let number = &mut number[stop.vertex as usize];
        if *number == NONE {
            *number = ordered.len() as u32;
            ordered.push(vertices[stop.vertex as usize]);
        }
        stop.vertex = *number;
    }
    ordered
}

/// The place of each trace in that order.
fn ranks(traces: &Traces, settings: &Settings) -> Vec<u32> {
    let mut tips = vec![0u32; settings.nuclei.len()];
    for tip in &traces.tips[traces.borders..] {
        tips[tip.tree as usize] += 1;
    }
    let mut next = vec![0u32; tips.len()];
    let mut sum = traces.borders as u32;
    for tree in along_curve(settings) {
        next[tree as usize] = sum;
        sum += tips[tree as usize];
    }
    let mut ranks: Vec<u32> = (0..traces.borders as u32).collect();
    ranks.extend(traces.tips[traces.borders..].iter().map(|tip| {
        let rank = next[tip.tree as usize];
        next[tip.tree as usize] += 1;
        rank
    }));
    ranks
}

/// Nuclei along a Z-shaped curve through the pane (Morton 1966).
fn along_curve(settings: &Settings) -> Vec<u32> {
    let places = settings.nuclei.iter().map(|nucleus| nucleus.position);
    let (low, high) = bounds(places.clone());
    let steps = f64::from((1u32 << BITS) - 1) / (high - low).max_element().max(f64::MIN_POSITIVE);
    let mut keyed: Vec<(u32, u32)> = (0..)
        .zip(places)
        .map(|(tree, place)| {
            let at = (place - low) * steps;
            (spaced(at.x as u32) | spaced(at.y as u32) << 1, tree)
        })
        .collect();
    keyed.sort_unstable();
    keyed.into_iter().map(|(_, tree)| tree).collect()
}

/// Sixteen bits with a gap after each.
fn spaced(bits: u32) -> u32 {
    let bits = (bits | bits << 8) & 0x00FF_00FF;
    let bits = (bits | bits << 4) & 0x0F0F_0F0F;
    let bits = (bits | bits << 2) & 0x3333_3333;
    (bits | bits << 1) & 0x5555_5555
}
