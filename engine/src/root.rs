//! Where a continuous function crosses zero.

/// The root of `f` between `low` and `high`, at which `f` has opposite signs, by bisection to the last bit.
///
/// If the signs do not differ, the end with the smaller magnitude is the answer's neighbour: callers check
/// their bracket first.
pub(crate) fn bisect(mut low: f64, mut high: f64, mut f: impl FnMut(f64) -> f64) -> f64 {
    let rising = f(high) > 0.0;
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle == low || middle == high {
            break;
        }
        if (f(middle) > 0.0) == rising {
            high = middle;
        } else {
            low = middle;
        }
    }
    0.5 * (low + high)
}
