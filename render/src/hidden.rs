//! The part of the picture that the headset's lenses hide, one bit a pixel.

use glam::Vec2;

/// Bits of one view, row by row, each row in whole words from its left; bits past a row's end are set. `corners` are of triangles, three
/// each, 0 to 1 from the upper left; a pixel is hidden if its centre lies in one.
pub fn hidden_words(corners: &[[f32; 2]], [width, height]: [u32; 2]) -> Vec<u32> {
    let row_words = width.div_ceil(32) as usize;
    let mut words = vec![0_u32; row_words * height as usize];
    let spare = width % 32;
    if spare != 0 {
        for row in words.chunks_mut(row_words) {
            row[row_words - 1] = u32::MAX << spare;
        }
    }
    let size = Vec2::new(width as f32, height as f32);
    for triangle in corners.chunks_exact(3) {
        let at = |corner: usize| Vec2::from(triangle[corner]) * size;
        let (a, b, c) = (at(0), at(1), at(2));
        let low = a.min(b).min(c).max(Vec2::ZERO);
        let high = a.max(b).max(c).min(size);
        for y in low.y as u32..high.y.ceil() as u32 {
            for x in low.x as u32..high.x.ceil() as u32 {
                let p = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
                let side = |from: Vec2, to: Vec2| (to - from).perp_dot(p - from);
                let (u, v, w) = (side(a, b), side(b, c), side(c, a));
                if (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0) {
                    words[y as usize * row_words + (x / 32) as usize] |= 1 << (x % 32);
                }
            }
        }
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever the winding, half of a square is its half, and the row's spare bits are set.
    #[test]
    fn half_a_picture_is_hidden() {
        for corners in [
            [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]],
            [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]],
        ] {
            let words = hidden_words(&corners, [40, 40]);
            assert_eq!(words.len(), 80);
            let bit = |x: usize, y: usize| words[2 * y + x / 32] >> (x % 32) & 1 == 1;
            for y in 0..40 {
                for x in 0..64 {
                    let expected = x >= 40 || x + y < 39;
                    // The diagonal itself runs through centres.
                    if x + y != 39 {
                        assert_eq!(bit(x, y), expected, "({x}, {y})");
                    }
                }
            }
        }
    }
}
