//! Sample panels: their areas are the piece, their middle is its centroid, and they lie on both sides of it.

mod fragments;

use brisance_engine::geometry::{PlaneMoments, Polygon, Sample, sample_panels};
use fragments::{Draw, mapped, mosaic, shard, star, with_holes};
use glam::DVec2;
use proptest::prelude::*;

fn samples_of(piece: &Polygon) -> (PlaneMoments, Vec<Sample>) {
    let (moments, mut samples) = (piece.moments(), Vec::new());
    sample_panels(piece, &moments, &mut samples);
    (moments, samples)
}

fn next_up(x: f64) -> f64 {
    f64::from_bits(x.to_bits() + 1)
}

fn check(piece: &Polygon) -> Result<(), TestCaseError> {
    let (moments, samples) = samples_of(piece);
    prop_assert!((5..=6).contains(&samples.len()), "{} panels", samples.len());
    let area: f64 = samples.iter().map(|s| s.area).sum();
    let ulp = next_up(moments.area) - moments.area;
    prop_assert!((area - moments.area).abs() <= ulp, "{area} is not {}", moments.area);
    prop_assert!(samples.iter().all(|s| s.area > 0.9e-3 * moments.area));
    let reach = piece.points().iter().map(|p| p.distance(moments.centroid)).fold(0.0, f64::max);
    let torque: DVec2 = samples.iter().map(|s| s.centre * s.area).sum();
    prop_assert!(torque.length() < 4e-15 * moments.area * reach, "{torque} of {}", moments.area * reach);
    // Within the piece's reach, on both sides of the long axis and towards both ends.
    prop_assert!(samples.iter().all(|s| s.centre.length() < reach));
    let axis = moments.long_axis();
    for direction in [axis, axis.perp()] {
        let extent = samples
            .iter()
            .map(|s| direction.dot(s.centre))
            .fold([0.0f64; 2], |[low, high], x| [low.min(x), high.max(x)]);
        let radius = (samples.iter().map(|s| s.area * direction.dot(s.centre).powi(2)).sum::<f64>()
            / moments.area)
            .sqrt();
        prop_assert!(extent[0] < -0.1 * radius && extent[1] > 0.1 * radius);
    }
    Ok(())
}

#[test]
fn a_rectangle_is_cut_into_six_equal_ones() {
    let turn = DVec2::from_angle(0.5);
    let plate = [(-3.0, -1.0), (3.0, -1.0), (3.0, 1.0), (-3.0, 1.0)].map(DVec2::from);
    let (_, samples) = samples_of(&Polygon::new(&plate.map(|p| DVec2::splat(7.0) + turn.rotate(p))));
    assert_eq!(samples.len(), 6);
    let mut expected = vec![];
    for y in [-0.5, 0.5] {
        expected.extend([-2.0, 0.0, 2.0].map(|x| turn.rotate(DVec2::new(x, y))));
    }
    for (sample, centre) in samples.iter().zip(expected) {
        assert!((sample.area - 2.0).abs() < 1e-13 && sample.centre.distance(centre) < 1e-13, "{sample:?}");
    }
}

#[test]
fn panels_are_the_parts_of_the_face_in_each_cell() {
    // A grid of points, each counted for the cell it is in, has each panel's area and middle.
    let stars = (0..6).map(|seed| Polygon::new(&star(9, DVec2::ZERO, 1.0, &mut Draw(seed))));
    let pieces =
        stars.chain((0..6).map(|seed| shard(30, seed))).chain((0..6).map(|seed| with_holes(16, 3, seed)));
    let mut compared = 0;
    for piece in pieces {
        let (moments, samples) = samples_of(&piece);
        let cells = cells_by_counting(&piece, &moments, 400);
        // With next to nothing in a cell the panels are others: that is not what is tested here.
        if cells.iter().any(|cell| cell.0 < 0.02 * moments.area) {
            continue;
        }
        compared += 1;
        assert_eq!(samples.len(), 6);
        let reach = piece.points().iter().map(|p| p.distance(moments.centroid)).fold(0.0, f64::max);
        for (cell, sample) in cells.iter().zip(&samples) {
            // The points nearest to the outline of a cell err: one in a hundred, of a grid of 400.
            assert!((cell.0 - sample.area).abs() < 5e-3 * moments.area, "{cell:?} {sample:?}");
            assert!((cell.1 / cell.0).distance(sample.centre) < 0.01 * reach, "{cell:?} {sample:?}");
        }
    }
    assert!(compared >= 9, "only {compared} pieces have something in every cell");
}

/// Area and first moment of the part of a piece in each cell, from the points of a grid that lie in it.
fn cells_by_counting(piece: &Polygon, moments: &PlaneMoments, count: usize) -> [(f64, DVec2); 6] {
    let axis = moments.long_axis();
    let middle = (moments.principal()[0] / moments.area / 3.0).sqrt();
    let low = piece.points().iter().copied().reduce(DVec2::min).unwrap();
    let step = (piece.points().iter().copied().reduce(DVec2::max).unwrap() - low) / count as f64;
    let mut cells = [(0.0, DVec2::ZERO); 6];
    for k in 0..count * count {
        let p = low + step * (DVec2::new((k % count) as f64, (k / count) as f64) + 0.5);
        let crossed = piece.sides().filter(|(a, b)| {
            (a.x > p.x) != (b.x > p.x) && p.y < a.y + (b.y - a.y) * (p.x - a.x) / (b.x - a.x)
        });
        if crossed.count() % 2 == 1 {
            let r = p - moments.centroid;
            let column = usize::from(axis.dot(r) > -middle) + usize::from(axis.dot(r) > middle);
            let cell = &mut cells[column + if axis.perp_dot(r) > 0.0 { 3 } else { 0 }];
            *cell = (cell.0 + step.x * step.y, cell.1 + r * (step.x * step.y));
        }
    }
    cells
}

#[test]
fn a_bow_with_empty_cells_still_has_five() {
    // A thin arc: its ends lie on one side of the long axis, its middle on the other.
    let arc = |radius: f64, i: i32| radius * DVec2::from_angle(0.6 + 1.9 * f64::from(i) / 40.0);
    let bow: Vec<DVec2> = (0..=40).map(|i| arc(1.0, i)).chain((0..=40).rev().map(|i| arc(0.98, i))).collect();
    check(&Polygon::new(&bow)).unwrap();
    // A cross: nothing is empty, but the cells differ. An L: one corner is.
    let l = [(0.0, 0.0), (10.0, 0.0), (10.0, 0.1), (0.1, 0.1), (0.1, 10.0), (0.0, 10.0)].map(DVec2::from);
    check(&Polygon::new(&l)).unwrap();
}

proptest! {
    #[test]
    fn panels_of_any_fragment_balance(
        seed in any::<u64>(),
        kind in 0..3,
        count in 6usize..300,
        scale in -4.0f64..2.0,
        place in prop::array::uniform2(-100.0f64..100.0),
    ) {
        let piece = match kind {
            0 => shard(count, seed),
            1 => Polygon::new(&star(count, DVec2::ZERO, 1.0, &mut Draw(seed))),
            _ => with_holes(count.max(12), 1 + (seed % 5) as usize, seed),
        };
        let scale = 10f64.powf(scale);
        check(&mapped(&piece, |p| DVec2::from_array(place) + p * scale))?;
    }

    #[test]
    fn panels_of_a_mosaic_balance(seed in any::<u64>(), cuts in 1usize..60) {
        for piece in &mosaic(cuts, seed) {
            check(piece)?;
        }
    }
}
