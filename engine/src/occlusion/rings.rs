//! The thesis's own count of distances (Fig. 4.4): 1 on the perimeter of a shape, 2 inside that, and so on.

/// Distance values of a shape drawn on a sheet of square pixels `width` wide, row by row: 0 outside it, and for a
/// pixel of the shape the number of steps, up, down, left or right, to the nearest pixel outside. Beyond the sheet
/// is outside.
///
/// The engine's own distance values are exact and have no grid: from a pixel's centre to the silhouette, in pixels,
/// plus a half, which is what this counts where an edge runs along the grid. Where it runs aslant the count is up to
/// √2 times as much, 1.12 times on the average over all slants.
pub fn ring_values(shape: &[bool], width: usize) -> Vec<u32> {
    let height = shape.len().checked_div(width).unwrap_or(0);
    let mut values: Vec<u32> = shape[..width * height].iter().map(|&inside| u32::from(inside)).collect();
    // A pixel is one more than its least neighbour: one sweep from each corner settles city-block distances.
    let step = |values: &mut Vec<u32>, at: usize, one: Option<usize>, two: Option<usize>| {
        if values[at] > 0 {
            let least = one.map_or(0, |i| values[i]).min(two.map_or(0, |i| values[i]));
            values[at] = least + 1;
        }
    };
    for at in 0..values.len() {
        let (x, y) = (at % width, at / width);
        step(&mut values, at, (x > 0).then(|| at - 1), (y > 0).then(|| at - width));
    }
    let forward = values.clone();
    for at in (0..values.len()).rev() {
        let (x, y) = (at % width, at / width);
        step(&mut values, at, (x + 1 < width).then(|| at + 1), (y + 1 < height).then(|| at + width));
        values[at] = values[at].min(forward[at]);
    }
    values
}
