//! Text over a window's picture, at the window's resolution, with the panel's fonts.

use std::sync::Arc;

use egui::text::{Galley, LayoutJob};
use egui::{Color32, ColorImage, Context, FontId, Pos2, RawInput};

use crate::panel::{SAID, context};

/// Height of text as a share of the window's width and of its height, and the least height, pixels of a screen of the usual density. Our
/// choice: 17 pixels in a window of 800 × 500, 26 in one of 1366 × 768, so that some ninety letters have room in a line. A screen of high
/// density has more pixels in a window of the same size, so that these shares need no factor.
const SHARES: [f32; 2] = [0.0215, 0.034];
const LEAST: f32 = 12.0;

/// A text, its colour, and where its upper left corner is, pixels.
pub type Block = (Arc<Galley>, Color32, Pos2);

/// Lays a text of that colour out, in a room so wide (pixels) and in so many rows at most.
pub type Lay<'a> = dyn FnMut(&str, Color32, f32, usize) -> Arc<Galley> + 'a;

/// The fonts, and how large a user wants text.
pub struct Letters {
    context: Context,
    scale: f32,
}

impl Letters {
    /// Text `scale` times as high as usual.
    pub fn new(scale: f32) -> Self {
        Self {
            context: context(),
            scale,
        }
    }

    /// Height of text in a window of that size, pixels, on a screen with so many pixels a pixel of the usual density.
    pub fn size(&self, window: [u32; 2], density: f32) -> f32 {
        let [across, down] = window.map(|side| side as f32);
        let size = (SHARES[0] * across).min(SHARES[1] * down);
        (self.scale * size.max(LEAST * density)).round()
    }

    /// What `set` lays out with text of that height, and the image that has its glyphs. A point of the layout is a pixel.
    pub fn lay<T>(&self, size: f32, set: impl FnOnce(&mut Lay<'_>) -> T) -> (T, ColorImage) {
        let font = FontId::proportional(size);
        // egui makes room for glyphs at the beginning of a frame alone.
        let _ = self.context.run(RawInput::default(), |_| {});
        self.context.fonts_mut(|fonts| {
            let mut lay = |text: &str, colour: Color32, room: f32, rows: usize| {
                let mut job = LayoutJob::simple(text.to_owned(), font.clone(), colour, room);
                job.wrap.max_rows = rows;
                fonts.layout_job(job)
            };
            let laid = set(&mut lay);
            (laid, fonts.image())
        })
    }
}

/// Writes a text into rows of `width` pixels; `image` has the font's glyphs.
pub fn write(pixels: &mut [u32], width: usize, image: &ColorImage, (laid, colour, at): &Block) {
    for row in &laid.rows {
        for glyph in &row.glyphs {
            let part = glyph.uv_rect;
            let offset = (glyph.pos + part.offset).round();
            let corner = *at + row.pos.to_vec2() + offset.to_vec2();
            for v in part.min[1]..part.max[1] {
                for u in part.min[0]..part.max[0] {
                    let x = corner.x + f32::from(u - part.min[0]);
                    let y = corner.y + f32::from(v - part.min[1]);
                    if x < 0.0 || y < 0.0 || x as usize >= width {
                        continue;
                    }
                    let texel = image.size[0] * usize::from(v) + usize::from(u);
                    let cover = image.pixels.get(texel).map_or(0, |texel| texel.a());
                    if cover > 0
                        && let Some(pixel) = pixels.get_mut(width * y as usize + x as usize)
                    {
                        let share = f32::from(cover) / 255.0;
                        *pixel = packed(SAID.lerp_to_gamma(*colour, share));
                    }
                }
            }
        }
    }
}

/// As a window's pixel, 0x00RRGGBB.
pub fn packed(colour: Color32) -> u32 {
    u32::from_be_bytes([0, colour.r(), colour.g(), colour.b()])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: 0.034 · 768 = 26.1, on a screen of twice the density with a window of the same size twice that, 0.0215 · 320 < 12, and a
    /// user's factor counts for all of them.
    #[test]
    fn text_is_as_high_as_window_and_user_ask_for() {
        let size = |scale, window, density| Letters::new(scale).size(window, density);
        assert_eq!(size(1.0, [1366, 768], 1.0), 26.0);
        assert_eq!(size(1.0, [2732, 1536], 2.0), 52.0);
        assert_eq!(size(1.5, [1366, 768], 1.0), 39.0);
        assert_eq!(size(1.0, [320, 240], 1.0), 12.0);
        assert_eq!(size(1.0, [640, 480], 2.0), 24.0);
        assert_eq!(size(2.0, [320, 240], 1.0), 24.0);
    }
}
