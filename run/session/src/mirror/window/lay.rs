//! Where a picture lies in its window.

use crate::mirror::shrink::fit;

/// The upper left corner of a picture of `extent` pixels in a window of that size, and its width and height there, pixels: as large as it
/// fits, in the middle.
fn place(window: [u32; 2], extent: [u32; 2]) -> ([u32; 2], [u32; 2]) {
    let fitting = fit(extent, window);
    let size = [0, 1].map(|side| fitting[side].min(window[side]));
    ([0, 1].map(|side| (window[side] - size[side]) / 2), size)
}

/// The place `at` of a window (pixels) in its picture: 0 to 1 from the picture's upper left, and beyond that beside it.
pub fn within(window: [u32; 2], extent: [u32; 2], at: [f64; 2]) -> [f32; 2] {
    let (corner, size) = place(window, extent);
    [0, 1].map(|side| {
        let from_corner = at[side] - f64::from(corner[side]);
        (from_corner / f64::from(size[side].max(1))) as f32
    })
}

/// The place in a window (pixels) of a place of its picture, the other way about.
pub fn onto(window: [u32; 2], extent: [u32; 2], at: [f32; 2]) -> [f32; 2] {
    let (corner, size) = place(window, extent);
    [0, 1].map(|side| corner[side] as f32 + at[side] * size[side] as f32)
}

/// Lays `picture` as large as it fits in the middle of `window`.
pub fn lay(window: &mut [u32], size: [u32; 2], picture: &[u32], extent: [u32; 2]) {
    let ([left, upper], [across, down]) = place(size, extent);
    let [left, upper, across, down] = [left, upper, across, down].map(|side| side as usize);
    let width = size[0] as usize;
    let [columns, rows] = extent.map(|side| side as usize);
    for (y, line) in window
        .chunks_exact_mut(width)
        .skip(upper)
        .take(down)
        .enumerate()
    {
        let row = &picture[columns * (y * rows / down)..][..columns];
        let line = &mut line[left..left + across];
        if across == columns {
            line.copy_from_slice(row);
            continue;
        }
        for (x, pixel) in line.iter_mut().enumerate() {
            *pixel = row[x * columns / across];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_lies_in_the_middle() {
        let mut window = [0; 20];
        lay(&mut window, [5, 4], &[1, 2], [2, 1]);
        let rows: Vec<&[u32]> = window.chunks(5).collect();
        // 5 / 2 = 2.5 times: 5 × 3 (2.5 rounded), of which the first three columns are the first.
        assert_eq!(rows[0], [1, 1, 1, 2, 2]);
        assert_eq!(rows[2], [1, 1, 1, 2, 2]);
        assert_eq!(rows[3], [0; 5]);
        // Twice as large, with a row above and one below, and with a column at either side.
        let mut window = [0; 16];
        lay(&mut window, [4, 4], &[1, 2], [2, 1]);
        assert_eq!(window[..8], [0, 0, 0, 0, 1, 1, 2, 2]);
        let mut window = [0; 8];
        lay(&mut window, [4, 2], &[1], [1, 1]);
        assert_eq!(window, [0, 1, 1, 0, 0, 1, 1, 0]);
        // Its own size: as it is.
        let mut window = [0; 6];
        lay(&mut window, [3, 2], &[1, 2, 3, 4, 5, 6], [3, 2]);
        assert_eq!(window, [1, 2, 3, 4, 5, 6]);
    }

    /// The pointer is on the same part of the picture however the window lays it.
    #[test]
    fn a_pointer_is_where_the_picture_lies() {
        // 400 × 300 in 1000 × 600: 800 × 600, with 100 columns to the left.
        let at = |x: f64, y: f64| {
            let at = within([1000, 600], [400, 300], [x, y]);
            let back = onto([1000, 600], [400, 300], at);
            // Rounding of single precision.
            let off = [f64::from(back[0]) - x, f64::from(back[1]) - y];
            assert!(off.iter().all(|it| it.abs() < 1e-3), "{x} {y}: {back:?}");
            at
        };
        assert_eq!(at(100.0, 0.0), [0.0, 0.0]);
        assert_eq!(at(900.0, 600.0), [1.0, 1.0]);
        assert_eq!(at(500.0, 150.0), [0.5, 0.25]);
        // Beside it.
        assert_eq!(at(20.0, 660.0), [-0.1, 1.1]);
        // In 500 × 1000: 500 × 375, with 312 rows above.
        let high = within([500, 1000], [400, 300], [250.0, 312.0]);
        assert_eq!(high, [0.5, 0.0]);
        // As large as the window.
        assert_eq!(within([400, 300], [400, 300], [100.0, 225.0]), [0.25, 0.75]);
    }
}
