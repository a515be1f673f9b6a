//! Plane pieces in convex parts, as collision detection wants them.

use std::collections::BTreeMap;

use glam::DVec2;

use super::Polygon;

/// The convex hull of points, counter-clockwise, without points in the middle of a side (Andrew 1979).
pub fn convex_hull(points: impl IntoIterator<Item = DVec2>) -> Vec<DVec2> {
    let mut sorted: Vec<DVec2> = points.into_iter().collect();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    sorted.dedup();
    if sorted.len() < 3 {
        return sorted;
    }
    let mut hull: Vec<DVec2> = Vec::with_capacity(sorted.len() + 1);
    let mut chain = |points: &mut dyn Iterator<Item = DVec2>| {
        let start = hull.len();
        for point in points {
            while hull.len() >= start + 2 {
                let [a, b] = [hull[hull.len() - 2], hull[hull.len() - 1]];
                if (b - a).perp_dot(point - b) > 0.0 {
                    break;
                }
                hull.pop();
            }
            hull.push(point);
        }
        hull.pop();
    };
    chain(&mut sorted.iter().copied());
    chain(&mut sorted.iter().rev().copied());
    hull
}

/// A convex ring with fewer corners: those that stand out least are left out, as long as they stand out by less than
/// `tolerance` [m]. What is left lies inside what was given.
pub fn simplified(mut ring: Vec<DVec2>, tolerance: f64) -> Vec<DVec2> {
    while ring.len() > 3 {
        let count = ring.len();
        let height = |i: usize| {
            let (before, after) = (ring[(i + count - 1) % count], ring[(i + 1) % count]);
            let base = after - before;
            base.perp_dot(ring[i] - before).abs() / base.length().max(f64::MIN_POSITIVE)
        };
        let least = (0..count).min_by(|&a, &b| height(a).total_cmp(&height(b))).expect("it has corners");
        if height(least) >= tolerance {
            break;
        }
        ring.remove(least);
    }
    ring
}

/// Convex parts that cover a polygon and reach beyond it by at most `tolerance` [m], each counter-clockwise.
///
/// `triangles` are those of [`Triangulator`](super::Triangulator). Neighbouring parts grow together, those first that
/// leave the shallowest pocket between their common hull and the polygon, as long as no pocket is deeper than the
/// tolerance (Hertel and Mehlhorn 1983, with a tolerance). A polygon whose own pockets are that shallow is one part. A
/// pocket's depth is that of its deepest corner below the hull.
pub fn convex_parts(polygon: &Polygon, triangles: &[[u32; 3]], tolerance: f64) -> Vec<Vec<DVec2>> {
    let points = polygon.points();
    let whole: Vec<u32> = (0..points.len() as u32).collect();
    if pocket(points, &whole) <= tolerance {
        return vec![convex_hull(points.iter().copied())];
    }
    let mut parts: Vec<Option<Vec<u32>>> = triangles.iter().map(|t| Some(t.to_vec())).collect();
    let mut borders = borders(triangles);
    let mut costs: BTreeMap<(usize, usize), f64> = borders
        .iter()
        .enumerate()
        .flat_map(|(a, beside)| beside.iter().filter(move |&&b| a < b).map(move |&b| (a, b)))
        .map(|(a, b)| ((a, b), joined(points, &parts, a, b).1))
        .collect();
    loop {
        let cheapest = costs.iter().min_by(|a, b| a.1.total_cmp(b.1)).map(|(&pair, &cost)| (pair, cost));
        let Some(((a, b), _)) = cheapest.filter(|&(_, cost)| cost <= tolerance) else { break };
        parts[a] = Some(joined(points, &parts, a, b).0);
        parts[b] = None;
        costs.retain(|&(x, y), _| x != a && y != a && x != b && y != b);
        let beside_b = std::mem::take(&mut borders[b]);
        for other in beside_b {
            borders[other].retain(|&x| x != b);
            if other != a && !borders[a].contains(&other) {
                borders[a].push(other);
                borders[other].push(a);
            }
        }
        for &other in &borders[a] {
            let pair = (a.min(other), a.max(other));
            costs.insert(pair, joined(points, &parts, pair.0, pair.1).1);
        }
    }
    parts.into_iter().flatten().map(|part| convex_hull(part.iter().map(|&i| points[i as usize]))).collect()
}

/// For each triangle those beside it.
fn borders(triangles: &[[u32; 3]]) -> Vec<Vec<usize>> {
    let mut first: BTreeMap<(u32, u32), usize> = BTreeMap::new();
    let mut borders = vec![Vec::new(); triangles.len()];
    for (index, triangle) in triangles.iter().enumerate() {
        for k in 0..3 {
            let (from, to) = (triangle[k], triangle[(k + 1) % 3]);
            if let Some(other) = first.insert((from.min(to), from.max(to)), index) {
                borders[index].push(other);
                borders[other].push(index);
            }
        }
    }
    borders
}

/// The corners of two parts together, and the depth of the deepest pocket of their hull [m].
fn joined(points: &[DVec2], parts: &[Option<Vec<u32>>], a: usize, b: usize) -> (Vec<u32>, f64) {
    let mut corners: Vec<u32> = [a, b].into_iter().flat_map(|i| parts[i].iter().flatten()).copied().collect();
    corners.sort_unstable();
    corners.dedup();
    let depth = pocket(points, &corners);
    (corners, depth)
}

/// How deep the deepest of these corners lies within the hull of all of them [m].
fn pocket(points: &[DVec2], corners: &[u32]) -> f64 {
    let hull = convex_hull(corners.iter().map(|&i| points[i as usize]));
    let depth = |point: DVec2| {
        let side = |i: usize| {
            let (from, along) = (hull[i], hull[(i + 1) % hull.len()] - hull[i]);
            along.perp_dot(point - from) / along.length()
        };
        (0..hull.len()).map(side).fold(f64::INFINITY, f64::min)
    };
    corners.iter().map(|&i| depth(points[i as usize])).fold(0.0, f64::max)
}
