//! A crack pattern is the same to the last bit on every machine, for any number of threads and in every version that
//! does not mean to change it.

mod panes;

use brisance_engine::fracture::{
    Fineness, Fragment, Glass, Pattern, Pieces, Recipe, Settings, Stopper, Wiggle,
};
use brisance_engine::geometry::Polygon;
use glam::DVec2;
use panes::{MIDDLE, square};

/// FNV-1a over 64-bit words.
fn hash(words: impl Iterator<Item = u64>) -> u64 {
    words.fold(0xCBF2_9CE4_8422_2325, |hash, word| {
        word.to_le_bytes()
            .iter()
            .fold(hash, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01B3))
    })
}

/// Everything that a pattern tells.
fn pattern_hash(pattern: &Pattern) -> u64 {
    let cracks = pattern.cracks.iter().flat_map(|crack| {
        let stopper = match crack.stopped_by {
            None => 0,
            Some(Stopper::Tip(tip)) => 1 + 2 * u64::from(tip),
            Some(Stopper::Border(edge)) => 2 + 2 * u64::from(edge),
        };
        let [a, b] = crack.ends;
        let numbers = [a.x, a.y, b.x, b.y, crack.growth[0], crack.growth[1]].map(f64::to_bits);
        let parent = crack.parent.map_or(0, |parent| 1 + u64::from(parent));
        numbers.into_iter().chain([parent, u64::from(crack.tip), stopper])
    });
    let vertices = pattern.vertices().iter().flat_map(|v| v.to_array().map(f64::to_bits));
    let ring = |(ring, border): (&[u32], &[bool])| {
        let sides =
            ring.iter().zip(border).map(|(&vertex, &border)| 2 * u64::from(vertex) + u64::from(border));
        [ring.len() as u64].into_iter().chain(sides).collect::<Vec<_>>()
    };
    let fragments = pattern.fragments().flat_map(|fragment| {
        let rings = fragment.rings().zip(fragment.on_border()).flat_map(ring);
        [fragment.closed_at().to_bits()].into_iter().chain(rings).collect::<Vec<_>>()
    });
    hash(cracks.chain(vertices).chain(fragments))
}

fn recipe(glass: Glass, pieces: usize, wiggle_probability: f64) -> Pattern {
    let fineness = Fineness::Pieces(pieces);
    Recipe { glass, fineness, wiggle_probability, ..Recipe::default() }.grow(&square()).unwrap().pattern
}

/// The thesis's rule on a pane with a hole, cracks turning often.
fn tree() -> Pattern {
    let mut pane = square();
    pane.push_ring([(0.7, 0.7), (0.7, 0.8), (0.8, 0.8), (0.8, 0.7)].map(DVec2::from));
    let wiggle = Wiggle { probability: 0.7, variance: 0.4, spacing: 0.01 };
    let settings = Settings { fork_variance: 0.6, wiggle, ..Settings::literal(MIDDLE, 0.003, 0.45) };
    Pattern::grow(&pane, &settings).unwrap()
}

/// A change of these numbers changes what every saved seed gives: the study's tables and pictures with it.
#[test]
fn fixed_patterns_keep_their_bits() {
    let patterns = [
        ("annealed, 500", recipe(Glass::Annealed, 500, 0.5), 0x2833_1540_E21C_6E2C),
        ("annealed, 5000, straight", recipe(Glass::Annealed, 5000, 0.0), 0xBCF1_69E2_655F_A93B),
        ("tempered, 3000", recipe(Glass::Tempered, 3000, 0.5), 0x9A45_1811_2F5C_19FB),
        ("laminated, 200", recipe(Glass::Laminated, 200, 0.5), 0x9DC9_0DD7_316C_FE66),
        ("the thesis's rule round a hole", tree(), 0xE622_2362_0669_D234),
    ];
    let found = patterns.map(|(name, pattern, pinned)| (name, pattern_hash(&pattern), pinned));
    for (name, hash, pinned) in found {
        assert_eq!(hash, pinned, "{name} has changed: {hash:#018X}; all of them: {found:X?}");
    }
}

#[test]
fn any_number_of_threads_makes_the_same_pieces() {
    // More than one batch of chunks for each of two threads, and the last one not full.
    let pattern = recipe(Glass::Annealed, 5000, 0.5);
    let pieces = [1, 2, 7].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let pieces = pool.install(|| Pieces::of(&pattern, 6e-3, 2500.0)).unwrap();
        format!("{pieces:?}")
    });
    assert!(pieces[0] == pieces[1] && pieces[0] == pieces[2]);
}

/// Neighbours have numbers near each other, which is what makes a million of them quick to walk.
#[test]
fn numbers_follow_space() {
    let pattern = recipe(Glass::Annealed, 20_000, 0.0);
    let mut polygon = Polygon::default();
    let centroid = |fragment: Fragment| {
        fragment.outline(&mut polygon);
        polygon.moments().centroid
    };
    let centroids: Vec<DVec2> = pattern.fragments().map(centroid).collect();
    let size = (1.0 / centroids.len() as f64).sqrt();
    let mut steps: Vec<f64> = centroids.windows(2).map(|pair| pair[0].distance(pair[1]) / size).collect();
    steps.sort_by(f64::total_cmp);
    // A tree is some four pieces wide. In no order at all the median step would be half a pane, 70 sizes.
    let (median, long) = (steps[steps.len() / 2], steps[steps.len() * 9 / 10]);
    assert!(median < 3.0 && long < 10.0, "from one fragment to the next it is {median} and {long} sizes");
}
