//! An animated picture (GIF): it plays wherever a page shows pictures, without a click.

use color_quant::NeuQuant;
use gif::{Encoder, Frame, Repeat};

use crate::failure::{Blame, Failure};

/// Colours of a frame's palette: all that the format has, but for one that is transparent.
const COLOURS: usize = 255;
/// The transparent one.
const TRANSPARENT: u8 = 255;
/// Of so many pixels one is looked at to find the palette; NeuQuant takes 1 (best) to 30 (fastest). Our choice.
const SAMPLED: i32 = 3;
/// A change of a colour's share by no more, of 255, is not drawn again: what stands still takes no room. Our choice: it is not seen.
const UNSEEN: u8 = 3;

/// An animated picture in the making.
pub struct AnimatedPicture {
    encoder: Encoder<Vec<u8>>,
    size: [u16; 2],
    /// What is shown after the last frame, RGBA; empty before the first.
    shown: Vec<u8>,
}

impl AnimatedPicture {
    /// Begins one of `size` (width and height, pixels) that begins again when it ends.
    ///
    /// # Errors
    /// [`Failure::Other`], an error of the encoder.
    pub fn new(size: [u16; 2]) -> Result<Self, Failure> {
        let mut encoder = Encoder::new(Vec::new(), size[0], size[1], &[]).other()?;
        encoder.set_repeat(Repeat::Infinite).other()?;
        Ok(Self {
            encoder,
            size,
            shown: Vec::new(),
        })
    }

    /// Adds a frame that is shown for so many hundredths of a second: opaque RGBA rows from the top.
    ///
    /// # Errors
    /// [`Failure::Other`] for a picture of another size, or an error of the encoder.
    pub fn push(&mut self, rgba: &[u8], hundredths: u16) -> Result<(), Failure> {
        let [width, height] = self.size;
        if rgba.len() != 4 * usize::from(width) * usize::from(height) {
            let bytes = rgba.len();
            return Err(format!(
                "a frame of {bytes} bytes is none of {width}×{height} pixels"
            ))
            .other();
        }
        let colours = NeuQuant::new(SAMPLED, COLOURS, rgba);
        let mut palette = colours.color_map_rgb();
        palette.extend([0; 3]);
        let is_first = self.shown.is_empty();
        self.shown.resize(rgba.len(), 0);
        let mut buffer = Vec::with_capacity(rgba.len() / 4);
        for (now, shown) in rgba.chunks_exact(4).zip(self.shown.chunks_exact_mut(4)) {
            let near = |(a, b): (&u8, &u8)| a.abs_diff(*b) <= UNSEEN;
            if !is_first && now.iter().zip(shown.iter()).all(near) {
                buffer.push(TRANSPARENT);
            } else {
                shown.copy_from_slice(now);
                buffer.push(colours.index_of(now) as u8);
            }
        }
        let frame = Frame {
            delay: hundredths,
            transparent: (!is_first).then_some(TRANSPARENT),
            width,
            height,
            palette: Some(palette),
            buffer: buffer.into(),
            ..Frame::default()
        };
        self.encoder.write_frame(&frame).other()
    }

    /// Ends it and hands over the file's bytes.
    ///
    /// # Errors
    /// [`Failure::Other`], an error of the encoder.
    pub fn finish(self) -> Result<Vec<u8>, Failure> {
        self.encoder.into_inner().other()
    }
}

/// A picture with rows of `width` pixels at half its width and height: each pixel is the mean of four. It is opaque.
pub fn halved(rgba: &[u8], width: usize) -> Vec<u8> {
    let row = 4 * width.max(1);
    let mut half = Vec::with_capacity(rgba.len() / 4);
    for rows in rgba.chunks_exact(2 * row) {
        let (upper, lower) = rows.split_at(row);
        for (upper, lower) in upper.chunks_exact(8).zip(lower.chunks_exact(8)) {
            for channel in 0..3 {
                let four =
                    [upper, lower].map(|it| u16::from(it[channel]) + u16::from(it[channel + 4]));
                half.push(((four[0] + four[1] + 2) / 4) as u8);
            }
            half.push(255);
        }
    }
    half
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// Width and height.
    const SIDE: usize = 64;

    /// A red square, whose left edge is at `from`, before a bench and a wall.
    fn picture(from: usize) -> Vec<u8> {
        let pixels = (0..SIDE * SIDE).flat_map(|pixel| {
            let (x, y) = (pixel % SIDE, pixel / SIDE);
            match y {
                20..36 if (from..from + 16).contains(&x) => [220, 30, 40, 255],
                0..40 => [200, 205, 210, 255],
                _ => [60, 80, 70, 255],
            }
        });
        pixels.collect()
    }

    /// It is read again frame by frame; what did not change is not in the later one, and what changed has its colour.
    #[test]
    fn frames_come_back() {
        let mut animated = AnimatedPicture::new([SIDE as u16; 2]).unwrap();
        let wanted = [picture(4), picture(30)];
        for picture in &wanted {
            animated.push(picture, 10).unwrap();
        }
        assert!(animated.push(&[0; 8], 10).is_err());
        let file = animated.finish().unwrap();
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::RGBA);
        let mut decoder = options.read_info(&file[..]).unwrap();
        let mut shown = vec![0; 4 * SIDE * SIDE];
        for wanted in &wanted {
            let frame = decoder.read_next_frame().unwrap().unwrap();
            assert_eq!((frame.width, frame.height, frame.delay), (64, 64, 10));
            for (shown, pixel) in shown.chunks_exact_mut(4).zip(frame.buffer.chunks_exact(4)) {
                if pixel[3] > 0 {
                    shown.copy_from_slice(pixel);
                }
            }
            for (shown, wanted) in shown.iter().zip(wanted) {
                assert!(shown.abs_diff(*wanted) <= 24, "{shown}, not {wanted}");
            }
        }
        assert!(decoder.read_next_frame().unwrap().is_none());
    }

    #[test]
    fn half_a_picture_is_its_means() {
        let rows = [
            [0, 40, 7, 7],
            [20, 60, 7, 7],
            [1, 1, 200, 200],
            [1, 1, 200, 200],
        ];
        let rgba: Vec<u8> = rows.concat().into_iter().flat_map(|it| [it; 4]).collect();
        let means = [30_u8, 7, 1, 200].map(|it| [it, it, it, 255]);
        assert_eq!(halved(&rgba, 4), means.concat());
    }
}
