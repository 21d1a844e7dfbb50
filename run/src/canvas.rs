//! A picture that panels and text are drawn over.

use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};

/// Least distance of a panel from the picture's edges, and of what is in it from its own, pixels.
pub(crate) const MARGIN: usize = 16;
pub(crate) const PADDING: usize = 12;
/// Text and ticks, sRGB grey.
pub(crate) const INK: u32 = 30;
/// Share of a panel's white over the picture, of 255.
const WHITENESS: u32 = 215;

/// A picture: RGBA rows from the top.
pub(crate) struct Canvas<'a> {
    picture: &'a mut [u8],
    width: usize,
}

impl<'a> Canvas<'a> {
    /// Over rows of `width` pixels.
    pub(crate) fn new(picture: &'a mut [u8], width: usize) -> Self {
        Self { picture, width }
    }

    /// Draws the white that text stands on, with its upper left corner at `at`; whether it has room.
    pub(crate) fn panel(&mut self, at: [usize; 2], size: [usize; 2]) -> bool {
        let height = self.picture.len() / 4 / self.width.max(1);
        let room = [self.width, height];
        if (0..2).any(|axis| at[axis] + size[axis] + MARGIN > room[axis]) {
            return false;
        }
        for y in 0..size[1] {
            for x in 0..size[0] {
                self.blend(at[0] + x, at[1] + y, [255; 3], WHITENESS);
            }
        }
        true
    }

    /// Lays `colour` over a pixel; `alpha` is 0 to 255.
    pub(crate) fn blend(&mut self, x: usize, y: usize, colour: [u32; 3], alpha: u32) {
        let first = 4 * (y * self.width + x);
        let Some(pixel) = self.picture.get_mut(first..first + 3) else {
            return;
        };
        for (old, new) in pixel.iter_mut().zip(colour) {
            let mixed = (u32::from(*old) * (255 - alpha) + new * alpha + 127) / 255;
            *old = mixed.min(255) as u8;
        }
    }

    /// Writes a line of that height, with its upper left corner at `at`.
    pub(crate) fn write(&mut self, size: RasterHeight, [x, y]: [usize; 2], text: &str) {
        let advance = get_raster_width(FontWeight::Regular, size);
        for (index, letter) in text.chars().enumerate() {
            // The font has all letters that titles and numbers are made of.
            let Some(raster) = get_raster(letter, FontWeight::Regular, size) else {
                continue;
            };
            for (dy, row) in raster.rows().enumerate() {
                for (dx, &ink) in row.iter().enumerate() {
                    self.blend(x + index * advance + dx, y + dy, [INK; 3], ink.into());
                }
            }
        }
    }
}
