//! Panes and measures of their patterns that several tests share.
#![allow(dead_code)]

use brisance_engine::fracture::{Fragment, Pattern};
use brisance_engine::geometry::Polygon;
use glam::DVec2;

pub fn square() -> Polygon {
    rectangle(1.0, 1.0)
}

pub fn rectangle(width: f64, height: f64) -> Polygon {
    Polygon::new(&[DVec2::ZERO, DVec2::new(width, 0.0), DVec2::new(width, height), DVec2::new(0.0, height)])
}

pub const MIDDLE: DVec2 = DVec2::splat(0.5);

pub fn areas(pattern: &Pattern) -> Vec<f64> {
    let mut polygon = Polygon::default();
    let area = |f: Fragment| {
        f.outline(&mut polygon);
        polygon.area()
    };
    pattern.fragments().map(area).collect()
}

/// Median over fragments of the root of the ratio of their principal second moments: length over width.
pub fn median_aspect(pattern: &Pattern) -> f64 {
    let mut polygon = Polygon::default();
    let mut ratios: Vec<f64> = pattern
        .fragments()
        .map(|fragment| {
            fragment.outline(&mut polygon);
            let [long, short] = polygon.moments().principal();
            (long / short).sqrt()
        })
        .collect();
    ratios.sort_by(f64::total_cmp);
    ratios[ratios.len() / 2]
}
