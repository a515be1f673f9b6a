//! Crack patterns against the thesis's own method, closed forms and counting rules.

mod occupancy;
mod panes;

use std::f64::consts::{FRAC_PI_2, PI};

use brisance_engine::fracture::{
    Crack, CrackClock, Depth, Fineness, Forking, Guide, Nucleus, Order, Pattern, Pieces, Recipe, Settings,
    Shape, Stopper, StressField, Wiggle,
};
use brisance_engine::geometry::Polygon;
use glam::DVec2;
use occupancy::Fate;
use panes::{MIDDLE, areas, median_aspect, rectangle, square};

fn literal(critical_length: f64, degrees: f64, variance: f64) -> Settings {
    Settings {
        fork_variance: variance.to_radians(),
        ..Settings::literal(MIDDLE, critical_length, degrees.to_radians())
    }
}

/// Cracks that do not fork, from one-armed nuclei.
fn arms(starts: &[(f64, f64, f64)]) -> Settings {
    let nuclei = starts.iter().map(|&(x, y, angle)| Nucleus {
        position: DVec2::new(x, y),
        arms: vec![angle],
        start: 0.0,
    });
    Settings { nuclei: nuclei.collect(), forking: Forking::Never, ..literal(1.0, 30.0, 0.0) }
}

fn grow(settings: &Settings) -> Pattern {
    Pattern::grow(&square(), settings).unwrap()
}

/// Fates of tips that cut one straight crack each.
fn fates(pattern: &Pattern) -> Vec<Fate> {
    pattern
        .cracks
        .iter()
        .map(|crack| match crack.stopped_by {
            None => Fate::Forked,
            Some(Stopper::Tip(tip)) => Fate::Stopped(tip as usize),
            Some(Stopper::Border(_)) => Fate::LeftThePane,
        })
        .collect()
}

/// The share of cases in which the thesis's method on `buckets`² gives every tip the same fate.
fn agreement(buckets: usize) -> f64 {
    let cases = [(25.0, 34.5), (35.0, 20.0), (40.0, 30.0), (60.0, 40.0), (50.0, 10.0)];
    let mut same = 0;
    let mut count = 0;
    for (degrees, variance) in cases {
        for seed in 1..=4 {
            // In no symmetry with the grid, and with no ties.
            let nucleus = DVec2::new(0.483, 0.527);
            let settings = Settings {
                nuclei: vec![Nucleus::segment(nucleus, 0.3)],
                seed,
                ..literal(1.0 / 17.3, degrees, variance)
            };
            let exact = fates(&grow(&settings));
            assert!(exact.len() > 20);
            let (angle, variance) = (settings.fork_angle, settings.fork_variance);
            let arms = &settings.nuclei[0].arms;
            let crept =
                occupancy::fates(nucleus, arms, settings.critical_length, angle, variance, seed, buckets);
            same += usize::from(exact == crept);
            count += 1;
        }
    }
    same as f64 / count as f64
}

#[test]
fn the_thesiss_occupancy_grid_gives_the_same_topology_when_it_is_fine() {
    // Two cracks that pass within a bucket of each other's ends look different on any grid; the finer, the rarer.
    let (coarse, fine) = (agreement(256), agreement(4096));
    assert!(fine >= 0.9, "{fine} of the patterns agree on a fine grid");
    assert!(coarse <= fine, "{coarse} agree on a coarse grid, {fine} on a fine one");
}

#[test]
fn an_x_cuts_a_square_into_quarters_that_close_when_its_arms_arrive() {
    let settings = Settings {
        nuclei: vec![Nucleus::cross(MIDDLE, 0.0)],
        forking: Forking::Never,
        ..literal(1.0, 30.0, 0.0)
    };
    let pattern = grow(&settings);
    assert_eq!(pattern.len(), 4);
    for (area, fragment) in areas(&pattern).into_iter().zip(pattern.fragments()) {
        assert!((area - 0.25).abs() < 1e-15);
        assert!((fragment.closed_at() - 0.5).abs() < 1e-15);
        assert_eq!(fragment.rings().map(<[u32]>::len).sum::<usize>(), 4);
        assert_eq!(fragment.on_border().flatten().filter(|&&border| border).count(), 2);
    }
}

#[test]
fn of_two_cracks_that_cross_the_later_stops() {
    // They meet at (0.5, 0.5), the first after 0.2, the second after 0.3.
    let pattern = grow(&arms(&[(0.3, 0.5, 0.0), (0.5, 0.2, FRAC_PI_2)]));
    assert_eq!(fates(&pattern), [Fate::LeftThePane, Fate::Stopped(0)]);
    let stopped = pattern.cracks[1];
    assert!(stopped.ends[1].distance(MIDDLE) < 1e-15 && (stopped.growth[1] - 0.3).abs() < 1e-15);
    // Neither closes anything: both hang on the border by one end.
    assert_eq!(pattern.len(), 1);
}

#[test]
fn of_two_cracks_that_arrive_together_the_lower_number_passes() {
    let pattern = grow(&arms(&[(0.25, 0.5, 0.0), (0.5, 0.25, FRAC_PI_2)]));
    assert_eq!(fates(&pattern), [Fate::LeftThePane, Fate::Stopped(0)]);
}

#[test]
fn two_cracks_head_on_stop_each_other_half_way() {
    let pattern = grow(&arms(&[(0.2, 0.5, 0.0), (0.8, 0.5, PI)]));
    assert_eq!(fates(&pattern), [Fate::Stopped(1), Fate::Stopped(0)]);
    for crack in &pattern.cracks {
        assert!(crack.ends[1].distance(MIDDLE) < 1e-12, "{:?}", crack.ends);
    }
}

#[test]
fn a_crack_that_starts_later_stops_where_it_would_have_passed() {
    let mut settings = arms(&[(0.3, 0.5, 0.0), (0.5, 0.2, FRAC_PI_2)]);
    settings.nuclei[0].start = 0.2;
    let pattern = grow(&settings);
    // Tips are numbered as they start.
    assert_eq!(fates(&pattern), [Fate::LeftThePane, Fate::Stopped(0)]);
    let stopped = pattern.cracks[1];
    assert!(stopped.ends[1].distance(MIDDLE) < 1e-15 && (stopped.growth[1] - 0.4).abs() < 1e-15);
}

#[test]
fn unforked_stars_leave_as_many_pieces_as_euler_counts() {
    // Every tip ends on something and so closes one face, but the first of each nucleus only ties it to the rest.
    for (count, star) in [(1, 5), (7, 3), (40, 4), (200, 3)] {
        let nuclei = (0..count)
            .map(|i| {
                let draw = |key| brisance_engine::random::unit(3, i, key);
                Nucleus::star(DVec2::new(draw(0), draw(1)), draw(2), star)
            })
            .collect();
        let settings = Settings { nuclei, forking: Forking::Never, ..literal(1.0, 30.0, 0.0) };
        assert_eq!(grow(&settings).len() as u64, count * (star as u64 - 1) + 1);
    }
}

#[test]
fn one_tip_forks_every_critical_length_the_one_that_has_waited_longest_first() {
    let length = 1.0 / 64.0;
    let pattern = grow(&literal(length, 30.0, 10.0));
    let mut forks: Vec<Crack> = pattern.cracks.iter().copied().filter(|c| c.stopped_by.is_none()).collect();
    forks.sort_by(|a, b| a.growth[1].total_cmp(&b.growth[1]));
    for (index, fork) in forks.iter().enumerate() {
        assert!((fork.growth[1] - (index + 1) as f64 * length).abs() < 1e-12);
    }
    // No tip is overtaken by one that started later; the two of a fork come in either order.
    for pair in forks.windows(2) {
        assert!(pair[0].growth[0] <= pair[1].growth[0] + 1e-12);
    }
    let ends = pattern.cracks.iter().map(|c| c.growth[1]).fold(0.0, f64::max);
    assert!((forks.len() as f64 - ends / length).abs() <= 1.0, "{} forks in {ends} m", forks.len());
}

#[test]
fn branches_leave_at_half_the_fork_angle_to_either_side() {
    let pattern = grow(&literal(1.0 / 40.0, 25.0, 0.0));
    let mut sides = [0, 0];
    for crack in pattern.cracks.iter().filter(|c| c.ends[0] != c.ends[1]) {
        let Some(parent) = crack.parent else { continue };
        let heading = |c: &Crack| c.ends[1] - c.ends[0];
        let turn = heading(&pattern.cracks[parent as usize]).angle_to(heading(crack)).to_degrees();
        assert!((turn.abs() - 12.5).abs() < 1e-6, "{turn} {crack:?} {:?}", pattern.cracks[parent as usize]);
        sides[usize::from(turn > 0.0)] += 1;
    }
    assert!(sides[0] > 10 && sides[1] > 10);
}

/// Growth at a point of a crack: it runs at one speed.
fn growth_at(pattern: &Pattern, point: DVec2) -> f64 {
    let on_crack = |crack: &&Crack| {
        let along = crack.ends[1] - crack.ends[0];
        let share = (point - crack.ends[0]).dot(along) / along.length_squared();
        share > -1e-9
            && share < 1.0 + 1e-9
            && along.perp_dot(point - crack.ends[0]).abs() < 1e-9 * along.length()
    };
    let crack = pattern.cracks.iter().find(on_crack).expect("a side lies on a crack");
    crack.growth[0] + crack.ends[0].distance(point)
}

#[test]
fn a_fragment_closes_when_the_last_point_of_its_outline_is_cut() {
    let settings = Settings {
        wiggle: Wiggle { probability: 0.5, variance: 0.4, spacing: 0.03 },
        ..literal(1.0 / 60.0, 30.0, 20.0)
    };
    let pattern = grow(&settings);
    assert!(pattern.len() > 20);
    for fragment in pattern.fragments() {
        let mut last = 0.0_f64;
        for (ring, border) in fragment.rings().zip(fragment.on_border()) {
            for (i, &vertex) in ring.iter().enumerate() {
                let ends = [vertex, ring[(i + 1) % ring.len()]].map(|v| pattern.vertices()[v as usize]);
                if !border[i] {
                    // Both ends lie on the side's own crack, which is found from the middle.
                    let middle = growth_at(&pattern, 0.5 * (ends[0] + ends[1]));
                    last = last.max(middle + 0.5 * ends[0].distance(ends[1]));
                }
            }
        }
        assert!((fragment.closed_at() - last).abs() < 1e-9, "{} {last}", fragment.closed_at());
    }
}

#[test]
fn creep_cracks_that_close_nothing_leave_the_pane_whole() {
    let settings = Settings { reach: Some(0.3), ..literal(0.2, 15.0, 10.0) };
    let pattern = grow(&settings);
    assert!(pattern.cracks.len() > 2 && pattern.cracks.iter().all(|c| c.growth[1] <= 0.3 + 1e-12));
    assert_eq!(areas(&pattern), [1.0]);
    assert_eq!(pattern.fragment(0).closed_at(), 0.0);
}

#[test]
fn a_hole_that_no_crack_reaches_stays_a_hole_of_its_fragment() {
    let mut pane = square();
    pane.push_ring([(0.7, 0.7), (0.7, 0.8), (0.8, 0.8), (0.8, 0.7)].map(DVec2::from));
    let settings = arms(&[(0.5, 0.5, FRAC_PI_2), (0.5, 0.5 - 1e-3, -FRAC_PI_2)]);
    let pattern = Pattern::grow(&pane, &settings).unwrap();
    assert_eq!(pattern.len(), 1, "the two cracks do not join");
    assert_eq!(pattern.fragment(0).rings().count(), 2);
    assert!((areas(&pattern)[0] - 0.99).abs() < 1e-15);
    let through = Settings { nuclei: vec![Nucleus::segment(MIDDLE, FRAC_PI_2)], ..settings };
    let pattern = Pattern::grow(&pane, &through).unwrap();
    let mut rings: Vec<usize> = pattern.fragments().map(|f| f.rings().count()).collect();
    rings.sort_unstable();
    assert_eq!(rings, [1, 2]);
}

#[test]
fn cracks_that_close_inside_a_fragment_make_a_hole_in_it() {
    // Four cracks that chase each other round close a square that hangs on nothing.
    let settings = arms(&[(0.3, 0.4, 0.0), (0.6, 0.3, FRAC_PI_2), (0.7, 0.6, PI), (0.4, 0.7, -FRAC_PI_2)]);
    let mut settings = Settings { reach: Some(0.32), ..settings };
    settings.seed = 2;
    let pattern = grow(&settings);
    let mut sizes = areas(&pattern);
    sizes.sort_by(f64::total_cmp);
    assert_eq!(sizes.len(), 2);
    assert!((sizes[0] - 0.04).abs() < 1e-12 && (sizes[1] - 0.96).abs() < 1e-12, "{sizes:?}");
    assert_eq!(pattern.fragments().map(|f| f.rings().count()).max(), Some(2));
}

/// Four cracks that chase each other round a square of side 0.2, which hangs on nothing.
fn pinwheel(at: DVec2) -> Vec<Nucleus> {
    [(0.0, 0.1, 0.0), (0.3, 0.0, FRAC_PI_2), (0.4, 0.3, PI), (0.1, 0.4, -FRAC_PI_2)]
        .map(|(x, y, angle)| Nucleus { position: at + DVec2::new(x, y), arms: vec![angle], start: 0.0 })
        .to_vec()
}

#[test]
fn a_crack_from_one_hole_to_another_parts_nothing() {
    // Two squares, and later a crack from between them that ends on both.
    let between = Nucleus { position: DVec2::new(0.5, 0.37), arms: vec![0.0, PI], start: 0.31 };
    let nuclei = [pinwheel(DVec2::new(0.05, 0.15)), pinwheel(DVec2::new(0.55, 0.15)), vec![between]].concat();
    let settings = Settings { nuclei, reach: Some(0.32), ..arms(&[]) };
    let pattern = grow(&settings);
    let mut sizes = areas(&pattern);
    sizes.sort_by(f64::total_cmp);
    assert_eq!(sizes.len(), 3);
    assert!((sizes[0] - 0.04).abs() < 1e-12 && (sizes[2] - 0.92).abs() < 1e-12, "{sizes:?}");
    assert_eq!(pattern.fragments().map(|f| f.rings().count()).max(), Some(3));
    assert!(Pieces::of(&pattern, 1e-3, 2500.0).is_ok());
}

#[test]
fn petals_that_meet_in_their_nucleus_come_apart_as_simple_pieces() {
    // Branches of neighbouring arms meet, but nothing reaches the border.
    let nuclei = vec![Nucleus::star(MIDDLE, 0.1, 6)];
    let settings = Settings { nuclei, reach: Some(0.35), ..literal(0.02, 60.0, 0.0) };
    let pattern = grow(&settings);
    assert!(pattern.len() > 3, "{}", pattern.len());
    assert!((areas(&pattern).iter().sum::<f64>() - 1.0).abs() < 1e-12);
    let solids = Pieces::of(&pattern, 1e-3, 2500.0).unwrap();
    assert_eq!(solids.len(), pattern.len());
}

#[test]
fn a_hole_level_with_a_corner_of_cracks_lies_in_the_fragment_around_it() {
    // The hole's left corner is at the height of the nucleus and of everything that ends in it.
    let mut pane = square();
    let (at, half) = (DVec2::new(0.75, 0.5), 0.04);
    let corners = [(-half, 0.0), (0.0, half), (half, 0.0), (0.0, -half)];
    pane.push_ring(corners.map(|(x, y)| at + DVec2::new(x, y)));
    for turn in 0..40 {
        let arms = [1.7, 1.0, 3.5, 5.5].map(|arm| arm + 0.01 * f64::from(turn));
        let nuclei = vec![Nucleus { position: DVec2::new(0.3, 0.5), arms: arms.to_vec(), start: 0.0 }];
        let settings = Settings { nuclei, forking: Forking::Never, ..literal(1.0, 30.0, 0.0) };
        let pattern = Pattern::grow(&pane, &settings).unwrap();
        assert!(Pieces::of(&pattern, 1e-3, 2500.0).is_ok(), "turn {turn}");
    }
}

#[test]
fn cracks_that_come_together_four_at_a_time_share_one_corner() {
    for count in [2, 3, 7] {
        for turned in [0.0, 0.25 * PI] {
            let step = 1.0 / f64::from(count);
            let nuclei = (0..count * count)
                .map(|i| DVec2::new(f64::from(i % count) + 0.5, f64::from(i / count) + 0.5) * step)
                .map(|at| Nucleus::cross(at, turned))
                .collect();
            let settings = Settings { nuclei, forking: Forking::Never, ..literal(1.0, 30.0, 0.0) };
            let pattern = grow(&settings);
            // Squares of the lattice, cut by the border.
            let cells = if turned == 0.0 { (count + 1) * (count + 1) } else { 2 * count * (count + 1) };
            assert_eq!(pattern.len() as i32, cells, "{count} {turned}");
            assert!(Pieces::of(&pattern, 1e-3, 2500.0).is_ok());
        }
    }
}

#[test]
fn no_tip_stops_itself_where_it_turns_at_the_edge_of_a_cell() {
    let settings = Settings {
        wiggle: Wiggle { probability: 0.9, variance: 0.3, spacing: 0.25 },
        ..literal(0.3, 40.0, 20.0)
    };
    for seed in 0..40 {
        let pattern = grow(&Settings { seed, ..settings.clone() });
        let own = |c: &&Crack| matches!(c.stopped_by, Some(Stopper::Tip(tip)) if tip == c.tip);
        assert_eq!(pattern.cracks.iter().filter(own).count(), 0, "seed {seed}");
    }
}

#[test]
fn a_smaller_fork_angle_gives_longer_shards() {
    // Figs 5.10 and 5.11, and beyond.
    let aspect = |degrees| median_aspect(&grow(&literal(1.0 / 1024.0, degrees, 0.0)));
    let [narrow, wide, wider] = [25.0, 35.0, 60.0].map(aspect);
    assert!(narrow > 1.15 * wide && wide > 1.15 * wider, "{narrow} {wide} {wider}");
}

#[test]
fn energy_keeps_forking_from_piling_up_in_a_corner() {
    // The literal rule goes on forking at the same rate when only a few tips are left: the smallest tenth of its
    // pieces is far smaller, against the mean, than where forking follows what is left of the tree.
    let tenth = |forking| {
        let settings = Settings {
            forking,
            wiggle: Wiggle { probability: 0.5, variance: 20_f64.to_radians(), spacing: 0.01 },
            ..literal(1.0 / 1024.0, 25.0, 34.5)
        };
        let mut sizes = areas(&grow(&settings));
        sizes.sort_by(f64::total_cmp);
        sizes[sizes.len() / 10] * sizes.len() as f64
    };
    let (literal, driven) =
        (tenth(Forking::Literal(Order::FirstInFirstOut)), tenth(Forking::Driven { room: 0.03 }));
    assert!(driven > 2.0 * literal, "{driven} {literal}");
}

#[test]
fn forks_that_come_faster_with_depth_make_the_outer_pieces_smaller() {
    let count = |factor| {
        let depth = Depth { critical_length: factor, ..Depth::default() };
        grow(&Settings { depth, ..literal(1.0 / 200.0, 30.0, 20.0) }).len()
    };
    assert!(count(0.9) > count(1.0) + 20 && count(1.0) > count(1.2) + 20);
}

#[test]
fn a_guide_turns_cracks_its_own_way() {
    let towards = |guide| {
        let settings =
            Settings { guide, wiggle: Wiggle { spacing: 0.01, ..Wiggle::NONE }, ..arms(&[(0.1, 0.5, 1.2)]) };
        let pattern = grow(&settings);
        let last = pattern.cracks.last().unwrap();
        (last.ends[1] - last.ends[0]).to_angle()
    };
    // The angle left falls as exp(−s/length): after at least 0.5 m with length 0.05 m it is below 1e-4.
    assert!((towards(Guide::Direction { angle: 0.25, length: 0.05 }) - 0.25).abs() < 1e-3);
    // Pulled along y everywhere, cracks run along x.
    let field = StressField {
        origin: DVec2::ZERO,
        spacing: DVec2::ONE,
        columns: 2,
        samples: vec![[0.0, 1e6, 0.0]; 4],
    };
    assert!(towards(Guide::Stress { field, length: 0.05 }).abs() < 1e-3);
    // Drawn outward, the median of the outer cracks is off by less than half as much as left alone.
    let off = |guide| {
        let settings = Settings {
            guide,
            wiggle: Wiggle { spacing: 0.01, ..Wiggle::NONE },
            ..literal(1.0 / 60.0, 40.0, 0.0)
        };
        let pattern = grow(&settings);
        let outer = pattern.cracks.iter().filter(|c| c.ends[0].distance(MIDDLE) > 0.3);
        let mut angles: Vec<f64> =
            outer.map(|c| (c.ends[1] - c.ends[0]).angle_to(c.ends[0] - MIDDLE).abs()).collect();
        angles.sort_by(f64::total_cmp);
        angles[angles.len() / 2]
    };
    let (drawn, alone) = (off(Guide::Outward { length: 0.05 }), off(Guide::None));
    assert!(drawn < 0.5 * alone, "{drawn} {alone}");
}

#[test]
fn the_clock_is_the_integral_of_the_speed() {
    let clock = CrackClock { terminal_speed: 1500.0, critical_length: 0.004 };
    // Trapezoids of 1 µm: the integrand's curvature near the start leaves 1e-6 of the sum.
    let (mut sum, step) = (0.0, 1e-6);
    for i in 0..500_000 {
        let at = f64::from(i) * step;
        sum += 0.5 * step * (1.0 / clock.speed(at) + 1.0 / clock.speed(at + step));
    }
    assert!((clock.time(0.5) / sum - 1.0).abs() < 1e-6, "{} {sum}", clock.time(0.5));
    assert!((clock.speed(1e3) - 1500.0).abs() < 0.1, "far out it is the terminal speed");
    let steady = CrackClock { critical_length: 0.0, ..clock };
    assert_eq!(steady.time(3.0), 3.0 / 1500.0);
}

#[test]
fn bad_settings_are_refused_in_a_sentence() {
    let refused = |settings: Settings| Pattern::grow(&square(), &settings).unwrap_err().to_string();
    let base = literal(0.01, 25.0, 0.0);
    let with = |change: fn(&mut Settings)| {
        let mut settings = base.clone();
        change(&mut settings);
        refused(settings)
    };
    assert!(with(|s| s.critical_length = 0.0).contains("critical length [m] is 0"));
    assert!(with(|s| s.critical_length = -1.0).contains("greater than 0"));
    assert!(with(|s| s.critical_length = 3.0).contains("longer side of the pane"));
    assert!(with(|s| s.critical_length = 1e-12).contains("pieces"));
    assert!(with(|s| s.fork_angle = PI).contains("fork angle"));
    assert!(with(|s| s.wiggle.probability = 1.5).contains("wiggle probability"));
    assert!(with(|s| s.nuclei[0].position = DVec2::new(2.0, 0.5)).contains("outside the pane"));
    assert!(with(|s| s.nuclei.clear()).contains("at least one place"));
    assert!(with(|s| s.nuclei[0].arms = vec![0.0, 2.0, 2.0 * PI]).contains("point the same way"));
    let fine = Wiggle { probability: 0.5, variance: 0.3, spacing: 1e-6 };
    assert!(refused(Settings { wiggle: fine, ..base.clone() }).contains("wiggle spacing"));
    let thread = rectangle(1e7, 1.0);
    assert!(Pattern::grow(&thread, &base).unwrap_err().to_string().contains("too narrow"));
    let starts = Recipe { starts: Some(1 << 50), ..Recipe::default() };
    assert!(starts.grow(&square()).unwrap_err().to_string().contains("places"));
    let border = Recipe { seeds: vec![DVec2::new(0.0, 0.5)], ..Recipe::default() };
    assert!(border.grow(&square()).unwrap_err().to_string().contains("border"));
    let crossed = Polygon::new(&[(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 0.6)].map(DVec2::from));
    assert!(Pattern::grow(&crossed, &base).is_err());
    let bow = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (1.0, -1.0), (0.0, 2.0)].map(DVec2::from);
    assert!(
        Pattern::grow(&Polygon::new(&bow), &base).unwrap_err().to_string().contains("crosses or touches")
    );
    let shape = Recipe { shape: Shape::Cross, fineness: Fineness::Pieces(0), ..Recipe::default() };
    assert!(shape.grow(&square()).unwrap_err().to_string().contains("number of pieces"));
}
