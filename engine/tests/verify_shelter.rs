//! Shelter against closed forms and printed values (thesis chapter 4).

mod shelter;

use brisance_engine::occlusion::{
    Attenuation, EDGE_ANGLE, Form, Per, Settings, Shelter, Solid, SphereMap, ring_values, shelter,
};
use glam::{DQuat, DVec3};
use proptest::prelude::*;
use shelter::{block, shelters, turned};

const PIXEL: f64 = EDGE_ANGLE / 32.0;

/// Figure 4.4 as it is printed.
const FIGURE_4_4: [&str; 17] = [
    "00000000000000000000",
    "00000000110000000000",
    "00000001221000000000",
    "00000012332110000000",
    "00000012343221000000",
    "00000123454332110000",
    "00000123455443221000",
    "00001234566554332100",
    "00001234567654321000",
    "00012345666543210000",
    "00123344556543210000",
    "00112233445432100000",
    "00001122334432100000",
    "00000011223321000000",
    "00000000112221000000",
    "00000000001110000000",
    "00000000000000000000",
];

#[test]
fn figure_4_4_is_counted_cell_by_cell() {
    let printed: Vec<u32> =
        FIGURE_4_4.iter().flat_map(|row| row.bytes().map(|digit| u32::from(digit - b'0'))).collect();
    let shape: Vec<bool> = printed.iter().map(|&value| value > 0).collect();
    assert_eq!(ring_values(&shape, 20), printed);
}

#[test]
fn rings_count_from_the_edge_of_the_sheet_and_nothing_counts_nothing() {
    assert_eq!(ring_values(&[true; 9], 3), [1, 1, 1, 1, 2, 1, 1, 1, 1]);
    assert!(ring_values(&[], 0).is_empty());
    assert_eq!(ring_values(&[false; 4], 2), [0; 4]);
}

/// (4.1) as it is printed, x³ − 2x^1.5 + 1, at values worked out by hand.
#[test]
fn equation_4_1() {
    let f = |b, k| Attenuation::THESIS.factor(b, k);
    for (b, k, expected) in
        [(0.0, 0.0, 1.0), (0.25, 0.0, 0.765_625), (1.0, 0.0, 0.0), (3.0, 0.0, 0.0), (2.0, 1.0, 0.765_625)]
    {
        assert!((f(b, k) - expected).abs() < 1e-12, "f({b}, {k}) = {}", f(b, k));
    }
    for b in [0.1, 0.7, 2.5, 4.0] {
        for k in [0.0, 0.3, 0.9] {
            let x: f64 = b / (1.0 + 7.0 * k);
            let printed = if x < 1.0 { x.powi(3) - 2.0 * x.powf(1.5) + 1.0 } else { 0.0 };
            assert!((f(b, k) - printed).abs() < 1e-12);
        }
    }
}

proptest! {
    /// For any parameters: a share between 0 and 1, that falls with b and rises with k.
    #[test]
    fn attenuation_falls_with_blocking_and_rises_with_separation(
        offset in 0.1f64..5.0, slope in 0.0f64..20.0, exponent in 0.3f64..4.0, power in 0.3f64..4.0,
        b in 0.0f64..10.0, k in 0.0f64..1.0, more in 0.0f64..3.0,
    ) {
        let f = Attenuation { offset, slope, exponent, power };
        prop_assert_eq!(f.factor(0.0, k), 1.0);
        prop_assert!((0.0..=1.0).contains(&f.factor(b, k)));
        prop_assert!(f.factor(b + more, k) <= f.factor(b, k));
        prop_assert!(f.factor(b, k + more) >= f.factor(b, k));
    }
}

/// Every pixel is found from its own centre, neighbours are mutual and near, and all together fill the sphere.
#[test]
fn the_map_has_no_seam() {
    for resolution in [4, 5, 32, 33] {
        let map = SphereMap::new(resolution).unwrap();
        let mut whole = 0.0;
        for pixel in 0..map.len() {
            let centre = map.centre(pixel);
            assert_eq!(map.pixel(centre), pixel);
            assert_eq!(map.index(map.place(pixel)), pixel);
            whole += map.solid_angle(pixel);
            for other in map.neighbours(pixel) {
                assert_ne!(other, pixel);
                assert!(map.neighbours(other).contains(&pixel), "{pixel} and {other}");
                // Centres of triangles that share an edge are a third of two heights apart: 0.58 of the edge.
                // Radial projection stretches the middle of a face by 1.26 against the mean.
                let angle = centre.angle_between(map.centre(other)) * resolution as f64 / EDGE_ANGLE;
                assert!(angle > 0.35 && angle < 0.85, "{angle}");
            }
        }
        // The solid angles are to second order in the pixel's size.
        let error = whole / (4.0 * std::f64::consts::PI) - 1.0;
        assert!(error.abs() < 1.0 / (resolution * resolution) as f64, "{resolution}: {error}");
    }
}

/// On the sheet every face is an equilateral triangle of edge 1, and neighbours within a face share an edge.
#[test]
fn the_sheet_of_figure_4_3_is_twenty_triangles_side_by_side() {
    let map = SphereMap::new(8).unwrap();
    let mut area = 0.0;
    for pixel in 0..map.len() {
        let [a, b, c] = map.unfolded(pixel);
        for (p, q) in [(a, b), (b, c), (c, a)] {
            assert!((p.distance(q) - 0.125).abs() < 1e-12);
        }
        area += 0.5 * (b - a).perp_dot(c - a).abs();
        for corner in [a, b, c] {
            assert!((-1e-12..=5.5 + 1e-12).contains(&corner.x) && (-1e-12..=2.6).contains(&corner.y));
        }
    }
    assert!((area - 20.0 * 3.0_f64.sqrt() / 4.0).abs() < 1e-9);
}

/// A plate of 2 × 2 m, 5 m away, and a small body behind it at `(x, y)`.
fn plate_and(x: f64, y: f64, distance: f64) -> Vec<Solid> {
    let plate = block(DVec3::new(0.0, 0.0, 5.0), DVec3::new(2.0, 2.0, 0.02), DQuat::IDENTITY, 0);
    let direction = DVec3::new(x, y, 4.99).normalize();
    vec![plate, block(direction * distance, DVec3::splat(0.004), DQuat::IDENTITY, 1)]
}

/// The angle from a direction through the front of the plate to the great circles of its four edges.
fn angle_to_edge(x: f64, y: f64) -> f64 {
    let direction = DVec3::new(x, y, 4.99).normalize();
    [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y]
        .map(|side| (side * 4.99 + DVec3::Z).normalize().dot(direction))
        .into_iter()
        .map(|sine| sine.abs().asin())
        .fold(f64::INFINITY, f64::min)
}

#[test]
fn blocking_is_the_angle_to_the_edge_in_the_thesiss_pixels_and_a_half() {
    for (x, y) in [(0.0, 0.0), (0.5, 0.1), (-0.3, 0.6), (0.2, -0.85)] {
        let expected = angle_to_edge(x, y) / PIXEL + 0.5;
        for (resolution, tolerance) in [(32, 0.16), (64, 0.08), (128, 0.04)] {
            // Two points of the rim are up to a pixel apart: half a pixel aside at a depth of a pixel is a tenth more.
            let found = shelters(&plate_and(x, y, 8.0), resolution)[1];
            let error = (found.blocking - expected).abs();
            assert!(error < tolerance, "({x}, {y}) at {resolution}: {} and {expected}", found.blocking);
            assert_eq!(found.hidden, 1.0);
        }
    }
}

#[test]
fn separation_is_the_gap_over_the_distance() {
    for distance in [5.5, 7.0, 20.0] {
        let found = shelters(&plate_and(0.0, 0.0, distance), 32)[1];
        let front = distance - 0.002;
        let expected = (front - 5.01) / front;
        // The rear is read at the middle of the pixel, up to 1.2° aside: 2e-4 of the distance farther.
        assert!((found.separation - expected).abs() < 3e-4, "{} and {expected}", found.separation);
    }
}

/// Straight over the plate's edge: two sides of a triangle instead of the third.
#[test]
fn the_detour_is_the_shortest_way_over_the_edge() {
    for (x, distance) in [(0.0, 8.0), (0.5, 8.0), (0.5, 14.0)] {
        let [_, found] = shelters(&plate_and(x, 0.0, distance), 64)[..] else { panic!() };
        let place = DVec3::new(x, 0.0, 4.99).normalize() * (distance - 0.002);
        // The nearest point of the front's edges, found by walking along them.
        let way = (-1000..=1000)
            .flat_map(|i| {
                let along = f64::from(i) * 1e-3;
                [DVec3::new(1.0, along, 4.99), DVec3::new(along, 1.0, 4.99)]
            })
            .map(|edge| edge.length() + edge.distance(place))
            .fold(f64::INFINITY, f64::min);
        let expected = way - place.length();
        assert!((found.detour / expected - 1.0).abs() < 0.03, "{} and {expected}", found.detour);
    }
}

#[test]
fn nothing_in_front_is_exactly_no_shelter() {
    let side_by_side: Vec<Solid> = (0..6)
        .map(|i| {
            let turn = DQuat::from_rotation_y(f64::from(i));
            block(turn * DVec3::new(0.0, 0.0, 4.0), DVec3::ONE, turn, i as u32)
        })
        .collect();
    assert!(shelters(&side_by_side, 32).iter().all(|found| *found == Shelter::NONE));
}

#[test]
fn what_stands_together_or_does_not_occlude_gives_no_shelter() {
    let mut solids = plate_and(0.0, 0.0, 8.0);
    assert_eq!(shelters(&solids, 32)[1].attenuation, 0.0);
    solids[1].group = 0;
    assert_eq!(shelters(&solids, 32)[1], Shelter::NONE);
    solids[1].group = 1;
    solids[0].occludes = false;
    assert_eq!(shelters(&solids, 32)[1], Shelter::NONE);
    // Casting none, it still receives one.
    solids[1].occludes = false;
    solids[0].occludes = true;
    assert_eq!(shelters(&solids, 32)[1].attenuation, 0.0);
}

/// The foot of a wall on the ground is no edge: the wave comes over the top. In one piece and laid of bricks.
#[test]
fn nothing_flows_under_what_stands_on_the_ground() {
    let eye = DVec3::new(0.0, 0.5, 0.0);
    let target = block(DVec3::new(0.0, 0.2, 12.0), DVec3::splat(0.02), DQuat::IDENTITY, 1);
    let whole = block(DVec3::new(0.0, 1.0, 4.0), DVec3::new(30.0, 2.0, 0.2), DQuat::IDENTITY, 0);
    let mut laid = vec![target.clone()];
    for i in 0..30 {
        for j in 0..10 {
            let centre = DVec3::new(f64::from(i) - 14.5, f64::from(j) * 0.2 + 0.1, 4.0);
            laid.push(block(centre, DVec3::new(0.995, 0.195, 0.2), DQuat::IDENTITY, 0));
        }
    }
    // From the charge the top of the wall's front is 1.5 m higher at 3.9 m, the target 0.3 m lower at 12 m.
    let over = (1.5_f64 / 3.9).atan() + (0.3_f64 / 11.99).atan();
    let under = (0.5_f64 / 3.9).atan() - (0.3_f64 / 11.99).atan();
    let settings = Settings { resolution: 64, ..Settings::default() };
    for solids in [vec![target.clone(), whole], laid] {
        let blocking = |ground| shelter(&solids, eye, ground, &settings).unwrap().bodies[0].blocking;
        assert!((blocking(Some(0.0)) - over / PIXEL - 0.5).abs() < 0.1, "{}", blocking(Some(0.0)));
        assert!((blocking(None) - under / PIXEL - 0.5).abs() < 0.1, "{}", blocking(None));
    }
}

/// A wall laid of bricks shelters as the same wall in one piece: its joints are no rim.
#[test]
fn a_wall_of_bricks_hides_like_one_block() {
    let whole = plate_and(0.3, 0.2, 8.0);
    let mut laid = vec![whole[1].clone()];
    for i in 0..10 {
        for j in 0..10 {
            let centre = DVec3::new(f64::from(i) * 0.2 - 0.9, f64::from(j) * 0.2 - 0.9, 5.0);
            laid.push(block(centre, DVec3::new(0.195, 0.195, 0.02), DQuat::IDENTITY, 0));
        }
    }
    let (one, many) = (shelters(&whole, 64)[1], shelters(&laid, 64)[0]);
    // Rims of a group are found to a 256th of a pixel's width; joints of 5 mm let single rays through.
    assert!((one.blocking - many.blocking).abs() < 0.05, "{} and {}", one.blocking, many.blocking);
    assert!((one.separation - many.separation).abs() < 1e-6);
}

/// The body's own fold-out does not matter: straddling three faces that meet at a corner (which are far apart on the
/// sheet), straddling the sheet's own cut, or inside one face, b and k are the same within the pixels' error.
#[test]
fn a_body_that_straddles_faces_apart_on_the_sheet_is_sheltered_as_one_within_a_face() {
    let map = SphereMap::new(32).unwrap();
    let scene = |toward: DVec3| {
        let turn = DQuat::from_rotation_arc(DVec3::Z, toward.normalize());
        let solids = vec![
            block(DVec3::new(0.0, 0.0, 5.0), DVec3::new(3.0, 2.0, 0.4), DQuat::IDENTITY, 0),
            block(DVec3::new(0.4, 0.3, 9.0), DVec3::new(2.0, 1.2, 1.0), DQuat::IDENTITY, 1),
        ];
        shelters(&turned(&solids, turn), 32)[1]
    };
    // The middle of a face, a corner of five faces, the pole, and the edge along which the sheet is cut (−z).
    let face = map.centre(map.pixel(DVec3::new(0.1, 0.35, 0.8)));
    let places = [face, DVec3::Y, DVec3::NEG_Y, DVec3::new(0.0, 0.447, -0.894), DVec3::new(-0.25, 0.0, -0.9)];
    let found: Vec<Shelter> = places.map(scene).to_vec();
    for other in &found[1..] {
        // b is about 2.5 pixels; some sixty pixels of the body, each right to a tenth or on the wrong side of the rim.
        assert!((other.blocking - found[0].blocking).abs() < 0.12, "{found:?}");
        assert!((other.separation - found[0].separation).abs() < 0.01, "{found:?}");
    }
}

fn attenuation_of_turned(turn: DQuat, resolution: usize) -> [f64; 3] {
    let solids = vec![
        block(DVec3::new(0.0, 0.0, 5.0), DVec3::new(3.0, 2.0, 0.4), DQuat::from_rotation_y(0.2), 0),
        block(DVec3::new(1.2, 0.5, 11.0), DVec3::new(2.0, 1.5, 1.0), DQuat::from_rotation_x(0.3), 1),
        block(DVec3::new(-3.4, -1.0, 10.0), DVec3::new(2.0, 3.0, 1.0), DQuat::from_rotation_z(0.5), 2),
        block(DVec3::new(0.0, 2.9, 12.0), DVec3::new(6.0, 1.5, 1.0), DQuat::IDENTITY, 3),
    ];
    let found = shelters(&turned(&solids, turn), resolution);
    [found[1].attenuation, found[2].attenuation, found[3].attenuation]
}

/// Turning everything changes the attenuation by the pixels' error alone, and that falls at least in proportion to
/// the pixels' size: each doubling of the resolution must at least halve it over three doublings.
#[test]
fn turning_the_scene_changes_nothing_but_the_pixels_error() {
    let turns: Vec<DQuat> = (0..24)
        .map(|i| {
            let i = f64::from(i);
            DQuat::from_scaled_axis(DVec3::new((3.1 * i).sin(), (1.7 * i).cos(), (2.3 * i).sin()) * 3.0)
        })
        .collect();
    let spread = |resolution: usize| {
        let all: Vec<[f64; 3]> = turns.iter().map(|&turn| attenuation_of_turned(turn, resolution)).collect();
        let mut sum = 0.0;
        for body in 0..3 {
            let mean = all.iter().map(|f| f[body]).sum::<f64>() / all.len() as f64;
            sum += all.iter().map(|f| (f[body] - mean).powi(2)).sum::<f64>() / all.len() as f64;
        }
        (sum / 3.0).sqrt()
    };
    let spreads: Vec<f64> = [16, 32, 64, 128].map(spread).to_vec();
    println!("standard deviation of f over 24 turns at 16, 32, 64, 128: {spreads:?}");
    assert!(spreads[1] < 0.02, "{spreads:?}");
    let order = (spreads[0] / spreads[3]).log2() / 3.0;
    println!("order {order}");
    assert!(order > 1.0, "{order} from {spreads:?}");
}

#[test]
fn shelter_grows_with_the_occluder_and_falls_with_the_gap() {
    let behind = block(DVec3::new(0.2, 0.1, 12.0), DVec3::new(1.5, 1.0, 1.0), DQuat::IDENTITY, 1);
    let f = |width: f64, distance: f64| {
        // The occluder keeps its angular size as it comes nearer to the charge, and its edges stay where they are.
        let size = DVec3::new(width * distance / 5.0, width * distance / 5.0, 0.1);
        let front = block(DVec3::new(0.0, 0.0, distance + 0.05), size, DQuat::IDENTITY, 0);
        shelters(&[front, behind.clone()], 64)[1].attenuation
    };
    let grown: Vec<f64> = (1..30).map(|i| f(0.05 * f64::from(i), 9.0)).collect();
    assert!(grown.windows(2).all(|pair| pair[1] <= pair[0] + 1e-9), "{grown:?}");
    assert!(grown[0] > 0.9 && grown[28] < 0.5, "{grown:?}");
    let gap: Vec<f64> = (0..20).map(|i| f(1.2, 10.0 - 0.4 * f64::from(i))).collect();
    // The occluder's sides show a little more of themselves the nearer it is.
    assert!(gap.windows(2).all(|pair| pair[1] >= pair[0] - 2e-3), "{gap:?}");
    assert!(gap[19] > gap[0] + 0.2, "{gap:?}");
}

#[test]
fn nothing_is_too_thin_to_be_seen_and_nothing_thin_hides_more_than_it_covers() {
    let behind = block(DVec3::new(0.0, 0.0, 9.0), DVec3::new(0.1, 0.1, 0.1), DQuat::IDENTITY, 1);
    for width in [1e-6, 1e-3, 0.02] {
        let pin = block(DVec3::new(0.0, 0.0, 4.0), DVec3::new(width, width, 0.01), DQuat::IDENTITY, 0);
        let found = shelters(&[pin, behind.clone()], 32)[1];
        // It covers this part of the smallest pixel there is, and may stand in it.
        let most = width * width / 16.0 / 4e-4;
        assert!(found.hidden <= most * 1.01 && found.attenuation < 1.0 + f64::EPSILON, "{found:?}");
        assert!(found.hidden > 0.0, "{found:?}");
    }
    // A thin body in the shadow of a wall is sheltered, whichever way it lies.
    for size in [DVec3::new(1e-4, 1.0, 1e-4), DVec3::new(1e-4, 1e-4, 0.5), DVec3::splat(1e-5)] {
        let mut solids = plate_and(0.0, 0.0, 8.0);
        solids[1] = block(DVec3::new(0.0, 0.0, 8.0), size, DQuat::from_rotation_z(0.3), 1);
        assert_eq!(shelters(&solids, 32)[1].hidden, 1.0);
    }
}

#[test]
fn a_body_larger_than_a_face_and_one_near_the_charge_hide_what_is_behind() {
    let large = block(DVec3::new(0.0, 0.0, 1.05), DVec3::new(40.0, 40.0, 0.1), DQuat::IDENTITY, 0);
    let behind = block(DVec3::new(5.0, -3.0, 6.0), DVec3::ONE, DQuat::IDENTITY, 1);
    let beside = block(DVec3::new(0.0, 0.0, -6.0), DVec3::ONE, DQuat::IDENTITY, 2);
    let found = shelters(&[large.clone(), behind, beside], 32);
    assert_eq!((found[1].hidden, found[1].attenuation), (1.0, 0.0));
    assert_eq!(found[2], Shelter::NONE);
    // A plate of 40 m at 1 m is seen under a half-angle of 87.1° straight up.
    let map = SphereMap::new(64).unwrap();
    let seen = brisance_engine::occlusion::first_seen(&[large], DVec3::ZERO, 64).unwrap();
    let share: f64 = (0..map.len()).filter(|&p| seen[p].is_some()).map(|p| map.solid_angle(p)).sum();
    // A square plate from its axis: 4 asin(a²/(a² + h²)) [sr].
    let expected = 4.0 * (400.0_f64 / 401.0).asin();
    assert!((share / expected - 1.0).abs() < 2e-3, "{share} and {expected}");
}

/// Six walls around the charge: a closed room. What stands inside is open, what stands outside receives nothing.
fn room() -> Vec<Solid> {
    let mut walls: Vec<Solid> = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z]
        .iter()
        .zip(0..)
        .map(|(&side, group)| {
            block(side * 5.0, DVec3::splat(10.4) - side.abs() * 10.2, DQuat::IDENTITY, group)
        })
        .collect();
    walls.push(block(DVec3::new(0.0, 0.0, 3.0), DVec3::ONE, DQuat::IDENTITY, 10));
    walls.push(block(DVec3::new(0.0, 1.0, 8.0), DVec3::ONE, DQuat::IDENTITY, 11));
    walls
}

#[test]
fn a_closed_room_is_noticed_and_keeps_everything_in() {
    let found = shelter(&room(), DVec3::ZERO, None, &Settings::default()).unwrap();
    assert!(found.enclosed > 0.999, "{}", found.enclosed);
    assert_eq!(found.bodies[6], Shelter::NONE);
    assert_eq!(found.bodies[7].attenuation, 0.0);
    let open = shelter(&room()[..3], DVec3::ZERO, None, &Settings::default()).unwrap();
    // Three of six equal sides, each a little longer than the room is wide.
    assert!(open.enclosed > 0.5 && open.enclosed < 0.53, "{}", open.enclosed);
    // Seen from above a ground, a floor counts for nothing.
    let floor = shelter(&room()[3..], DVec3::ZERO, Some(-4.9), &Settings::default()).unwrap();
    assert!(floor.enclosed < 0.6, "{}", floor.enclosed);
}

#[test]
fn a_panel_in_the_open_is_loaded_and_one_behind_cover_is_not() {
    let cover = block(DVec3::new(-1.5, 0.0, 5.0), DVec3::new(3.0, 3.0, 0.2), DQuat::IDENTITY, 0);
    let wide = block(DVec3::new(0.0, 0.0, 6.0), DVec3::new(4.0, 1.0, 0.2), DQuat::IDENTITY, 1);
    let settings = Settings { per: Per::Panel, resolution: 64, ..Settings::default() };
    let found = shelter(&[cover, wide.clone()], DVec3::ZERO, None, &settings).unwrap();
    let body = found.bodies[1];
    assert!(body.hidden > 0.4 && body.hidden < 0.6, "{body:?}");
    assert_eq!(found.panels[1].len(), wide.points.len());
    for (panel, point) in found.panels[1].iter().zip(&wide.points) {
        // The shadow's edge is straight ahead.
        if point.position.x > 0.2 {
            assert_eq!(*panel, Shelter::NONE);
        } else if point.position.x < -0.5 {
            assert!(panel.hidden == 1.0 && panel.attenuation < 0.3, "{panel:?} at {}", point.position);
        }
    }
}

#[test]
fn bad_input_is_refused_in_a_sentence() {
    let solids = plate_and(0.0, 0.0, 8.0);
    for resolution in [0, 3, 513] {
        let settings = Settings { resolution, ..Settings::default() };
        let message = shelter(&solids, DVec3::ZERO, None, &settings).unwrap_err().to_string();
        assert!(message.contains("resolution") && message.contains("4 to 512"), "{message}");
    }
    let nothing = Attenuation { slope: -1.0, ..Attenuation::THESIS };
    let settings = Settings { attenuation: nothing, ..Settings::default() };
    assert!(shelter(&solids, DVec3::ZERO, None, &settings).unwrap_err().to_string().contains("slope"));
    // In the middle of an occluder, and on its face, edge and corner.
    for place in [(0.0, 0.0, 5.0), (0.3, 0.2, 4.99), (1.0, 0.1, 4.99), (1.0, 1.0, 4.99)] {
        let message = shelter(&solids, place.into(), None, &Settings::default()).unwrap_err().to_string();
        assert!(message.contains("in or on body 0"), "{place:?}: {message}");
    }
    let clear = shelter(&solids, DVec3::new(0.3, 0.2, 4.98), None, &Settings::default()).unwrap();
    assert_eq!(clear.bodies[1].attenuation, 0.0);
}

/// Bodies without area or volume make no number that is none.
#[test]
fn a_body_without_area_is_read_all_the_same() {
    use brisance_engine::geometry::TriangleMesh;
    use std::sync::Arc;
    let sliver = TriangleMesh {
        vertices: vec![DVec3::new(0.0, 0.0, 8.0), DVec3::new(0.0, 1.0, 8.0), DVec3::new(0.0, 2.0, 8.0)],
        triangles: vec![[0, 1, 2], [0, 2, 1]],
    };
    let flat = Solid {
        form: Form::Mesh(Arc::new(sliver)),
        group: 1,
        occludes: true,
        points: Vec::new(),
        by_point: false,
    };
    let mut solids = plate_and(0.0, 0.0, 12.0);
    solids[1].group = 2;
    solids.push(flat);
    let found = shelters(&solids, 32);
    assert!(
        found.iter().all(|s| s.attenuation.is_finite() && s.blocking.is_finite() && s.detour.is_finite())
    );
    assert_eq!(found[2].hidden, 1.0, "its middle is behind the plate");
}

/// A mesh is seen as the box that it is, whether it hides or is hidden.
#[test]
fn a_mesh_is_sheltered_and_shelters_as_the_same_box() {
    use brisance_engine::geometry::TriangleMesh;
    use std::sync::Arc;
    let as_mesh = |solid: &Solid| {
        let Form::Box { centre, half, world_from_box } = solid.form else { panic!() };
        let vertices = (0..8)
            .map(|code| {
                let sign = |bit: u32| if code & bit == 0 { -1.0 } else { 1.0 };
                centre + world_from_box * (half * DVec3::new(sign(1), sign(2), sign(4)))
            })
            .collect();
        let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        Solid { form: Form::Mesh(Arc::new(TriangleMesh { vertices, triangles })), ..solid.clone() }
    };
    let solids = [
        block(DVec3::new(0.1, 0.0, 5.0), DVec3::new(3.0, 2.0, 0.4), DQuat::from_rotation_y(0.4), 0),
        block(DVec3::new(0.9, 0.6, 9.0), DVec3::new(2.0, 1.2, 1.0), DQuat::from_rotation_x(0.5), 1),
    ];
    let boxes = shelters(&solids, 32);
    let meshes = shelters(&solids.each_ref().map(as_mesh), 32);
    for (a, b) in boxes.iter().zip(&meshes) {
        // Rays that graze an edge may fall on either side.
        assert!((a.blocking - b.blocking).abs() < 1e-3 && (a.separation - b.separation).abs() < 1e-4);
        assert!((a.detour - b.detour).abs() < 1e-3);
    }
    assert!(boxes[1].hidden > 0.5);
}
