//! The smallest box about points, and its corners.

use glam::{DVec2, DVec3};

/// Points of the plane and of space: what [`bounds`] needs of both.
pub trait Coordinates: Copy {
    /// All coordinates infinite.
    const INFINITY: Self;
    /// All coordinates infinite and negative.
    const NEG_INFINITY: Self;
    /// The lower of each coordinate.
    fn min(self, other: Self) -> Self;
    /// The higher of each coordinate.
    fn max(self, other: Self) -> Self;
}

/// Corners of the smallest box about points: the lowest and the highest of each coordinate.
///
/// For no points the first is infinite and the second infinite and negative: a box that holds and overlaps nothing.
pub fn bounds<P: Coordinates>(points: impl IntoIterator<Item = P>) -> (P, P) {
    let nothing = (P::INFINITY, P::NEG_INFINITY);
    points.into_iter().fold(nothing, |(low, high), point| (low.min(point), high.max(point)))
}

/// The corners of a box with this lowest and this highest one: the bits of a corner's number say along which axes it is
/// high.
pub fn box_corners(low: DVec3, high: DVec3) -> [DVec3; 8] {
    std::array::from_fn(|code| {
        let pick = |axis: usize| if code >> axis & 1 == 0 { low[axis] } else { high[axis] };
        DVec3::new(pick(0), pick(1), pick(2))
    })
}

macro_rules! coordinates {
    ($($point:ty),*) => {$(
        impl Coordinates for $point {
            const INFINITY: Self = Self::INFINITY;
            const NEG_INFINITY: Self = Self::NEG_INFINITY;

            fn min(self, other: Self) -> Self {
                Self::min(self, other)
            }

            fn max(self, other: Self) -> Self {
                Self::max(self, other)
            }
        }
    )*};
}

coordinates!(DVec2, DVec3);
