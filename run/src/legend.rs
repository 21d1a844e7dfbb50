//! What a film's colours stand for, drawn into its pictures: a bar of the map with
//! numbers and unit, or the two liquids' tints.

use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster_width};
use vitriol_lesson::Language;
use vitriol_render::{ColourBy, ColourMap, tints};

use crate::canvas::{Canvas, INK, MARGIN, PADDING};
use crate::failure::Failure;
use crate::texts::Texts;

/// The bar, pixels.
const BAR: [usize; 2] = [280, 14];
/// Height of a tick below the bar, pixels.
const TICK: usize = 5;

pub(crate) const SIZE: RasterHeight = RasterHeight::Size16;

/// What legends are written in.
#[derive(Clone, Debug)]
pub struct Words(Texts);

impl Words {
    /// Those of a language. The font of films has Latin letters alone, so Chinese films have English ones.
    ///
    /// # Errors
    /// As for [`Texts::of`].
    pub fn of(language: Language) -> Result<Self, Failure> {
        let texts = Texts::of(match language {
            Language::Zh => Language::En,
            other => other,
        });
        Ok(Self(texts?))
    }

    /// Draws what `colours` stand for into the upper left corner of `picture` (RGBA rows of `width` pixels, from the top);
    /// without these that liquids are tinted, if they are.
    pub fn draw(&self, picture: &mut [u8], width: usize, colours: Option<ColourBy>, tinted: bool) {
        match colours {
            Some(colours) => {
                if let Some(legend) = Legend::of(colours, self) {
                    legend.draw(picture, width, self);
                }
            }
            None if tinted => self.draw_tints(picture, width),
            None => {}
        }
    }

    /// The tints of water and acid, and that they are artificial.
    fn draw_tints(&self, picture: &mut [u8], width: usize) {
        let text = SIZE.val();
        let lines = [
            (None, &self.0.legend.tints),
            (Some(tints::WATER), &self.0.panel.water),
            (Some(tints::ACID), &self.0.panel.sulfuric_acid),
        ];
        let line = text + 6;
        let letters = lines.iter().map(|(_, name)| name.chars().count() + 3).max();
        let wide = letters.unwrap_or(0) * get_raster_width(FontWeight::Regular, SIZE);
        let panel = [wide + 2 * PADDING, lines.len() * line + 2 * PADDING];
        let mut canvas = Canvas::new(picture, width);
        if !canvas.panel([MARGIN; 2], panel) {
            return;
        }
        let left = MARGIN + PADDING;
        for (index, (tint, name)) in lines.into_iter().enumerate() {
            let top = MARGIN + PADDING + index * line;
            let mut start = left;
            if let Some(tint) = tint {
                let colour = tints::seen_through(tint).map(|share| (255.0 * share).round() as u32);
                for y in 0..text {
                    for x in 0..2 * text {
                        canvas.blend(left + x, top + y, colour, 255);
                    }
                }
                start += 2 * text + 8;
            }
            canvas.write(SIZE, [start, top], name);
        }
    }
}

/// The scale of an attribute.
#[derive(Clone, Debug, PartialEq)]
struct Legend {
    title: String,
    map: ColourMap,
    range: [f32; 2],
    step: f32,
    decimals: usize,
}

impl Legend {
    /// The legend of temperature or acid; speed has none, since its colours only set
    /// what moves off from what rests.
    fn of(colour_by: ColourBy, words: &Words) -> Option<Self> {
        let (title, step, decimals) = match colour_by {
            ColourBy::Speed(_) => return None,
            ColourBy::Temperature(coldest, hottest) => {
                (&words.0.legend.temperature, tick_step(hottest - coldest), 0)
            }
            ColourBy::Acid => (&words.0.legend.acid, 0.2, 1),
        };
        Some(Self {
            title: title.clone(),
            map: colour_by.map(),
            range: colour_by.range(),
            step,
            decimals,
        })
    }

    /// Draws it into `picture`; into none where it has no room.
    fn draw(&self, picture: &mut [u8], width: usize, words: &Words) {
        let text = SIZE.val();
        let panel = [
            BAR[0] + 2 * PADDING,
            2 * text + BAR[1] + TICK + 2 * PADDING + 4,
        ];
        let mut canvas = Canvas::new(picture, width);
        if !canvas.panel([MARGIN; 2], panel) {
            return;
        }
        let left = MARGIN + PADDING;
        let mut top = MARGIN + PADDING;
        canvas.write(SIZE, [left, top], &self.title);
        top += text + 4;
        for x in 0..BAR[0] {
            let place = x as f32 / (BAR[0] - 1) as f32;
            let colour = self
                .map
                .at(place)
                .map(|share| (255.0 * share).round() as u32);
            for y in 0..BAR[1] {
                canvas.blend(left + x, top + y, colour, 255);
            }
        }
        top += BAR[1];
        for value in self.ticks() {
            let share = (value - self.range[0]) / (self.range[1] - self.range[0]);
            let at = left + (share * (BAR[0] - 1) as f32).round() as usize;
            for y in 0..TICK {
                canvas.blend(at, top + y, [INK; 3], 255);
            }
            let decimal = &words.0.panel.spilt.decimal;
            let label = format!("{value:.*}", self.decimals).replace('.', decimal);
            let wide = label.chars().count() * get_raster_width(FontWeight::Regular, SIZE);
            let start = (at.saturating_sub(wide / 2)).clamp(MARGIN, left + BAR[0] + PADDING - wide);
            canvas.write(SIZE, [start, top + TICK], &label);
        }
    }

    /// Values that have a number: multiples of the step.
    fn ticks(&self) -> Vec<f32> {
        let first = (self.range[0] / self.step - 1e-4).ceil() as i32;
        let last = (self.range[1] / self.step + 1e-4).floor() as i32;
        (first..=last).map(|n| n as f32 * self.step).collect()
    }
}

/// Three to seven numbers over a range of temperatures.
fn tick_step(range: f32) -> f32 {
    let steps = [5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0];
    let fits = steps.into_iter().find(|step| range / step <= 7.0);
    fits.unwrap_or(1000.0)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use noto_sans_mono_bitmap::get_raster;

    use super::*;

    const WIDTH: usize = 960;
    const GREY: u8 = 128;

    fn drawn(colour_by: ColourBy, language: Language) -> Vec<u8> {
        let mut picture = vec![GREY; 4 * WIDTH * 540];
        let words = Words::of(language).unwrap();
        words.draw(&mut picture, WIDTH, Some(colour_by), false);
        picture
    }

    /// Each letter of a legend is in the font: none is left out. The words are those of the film's language, in Chinese films English.
    #[test]
    fn words_are_drawn_in_the_films_language() {
        for language in Language::ALL {
            let Words(texts) = Words::of(language).unwrap();
            let (legend, panel) = (&texts.legend, &texts.panel);
            for text in [
                &legend.temperature,
                &legend.acid,
                &legend.tints,
                &panel.water,
                &panel.sulfuric_acid,
            ] {
                for letter in text.chars() {
                    let raster = get_raster(letter, FontWeight::Regular, SIZE);
                    assert!(raster.is_some(), "{language}: {letter} of {text}");
                }
            }
        }
        let acid = |language| drawn(ColourBy::Acid, language);
        assert_ne!(acid(Language::De), acid(Language::En));
        assert_eq!(acid(Language::Zh), acid(Language::En));
    }

    /// A hue that a particle's colour has is where the scale has its value.
    #[test]
    fn the_bar_is_the_map_from_end_to_end() {
        let picture = drawn(ColourBy::Temperature(20.0, 180.0), Language::En);
        let row = MARGIN + PADDING + SIZE.val() + 4 + BAR[1] / 2;
        for x in 0..BAR[0] {
            let place = x as f32 / (BAR[0] - 1) as f32;
            let first = 4 * (row * WIDTH + MARGIN + PADDING + x);
            let expected = ColourMap::Plasma.at(place);
            for (byte, share) in picture[first..first + 3].iter().zip(expected) {
                assert!((f32::from(*byte) - 255.0 * share).abs() <= 0.51);
            }
        }
        // Nothing elsewhere.
        assert!(picture[4 * WIDTH * 140..].iter().all(|&byte| byte == GREY));
        assert!(
            picture[..4 * WIDTH * MARGIN]
                .iter()
                .all(|&byte| byte == GREY)
        );
    }

    #[test]
    fn numbers_are_round_and_within() {
        let words = Words::of(Language::En).unwrap();
        let ticks = |coldest, hottest| {
            let colour_by = ColourBy::Temperature(coldest, hottest);
            Legend::of(colour_by, &words).unwrap().ticks()
        };
        assert_eq!(
            ticks(20.0, 150.0),
            [20.0, 40.0, 60.0, 80.0, 100.0, 120.0, 140.0]
        );
        assert_eq!(ticks(15.0, 105.0), [20.0, 40.0, 60.0, 80.0, 100.0]);
        assert_eq!(Legend::of(ColourBy::Acid, &words).unwrap().ticks().len(), 6);
        assert!(Legend::of(ColourBy::Speed(1.0), &words).is_none());
    }

    #[test]
    fn a_picture_without_room_stays_as_it_is() {
        let mut small = vec![GREY; 4 * 200 * 100];
        let words = Words::of(Language::En).unwrap();
        words.draw(&mut small, 200, Some(ColourBy::Acid), false);
        words.draw(&mut small, 200, None, true);
        assert!(small.iter().all(|&byte| byte == GREY));
    }
}
