//! The strip at the upper edge of a desk's window: the lesson's step, a pause and the instructor's message. The panel that shows them
//! too stands in the scene, where it may be small or out of view.

use egui::pos2;
use vitriol_run::texts::PanelTexts;

use super::letters::{Block, Letters, packed, write};
use crate::info::{Info, Mark};
use crate::panel::{SAID, WARNING, WHITE};

/// Lines of text at most, so that little of the bench is covered.
const LINES: usize = 2;
/// Between two texts of a line.
const GAP: &str = "   ";

/// What the strip says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Said {
    /// What must not be missed: how to use a key, a pause, the instructor's message and actions.
    urgent: String,
    /// The lesson's step, or its result.
    step: String,
    /// The pour under way, at the right end.
    pouring: String,
    /// How far the hold of a key has come, per cent.
    share: u32,
}

impl Said {
    /// What it says in that state.
    pub fn of(info: &Info, words: &PanelTexts) -> Self {
        let told = &info.told;
        let key = info.key_held.map(|_| &words.hold);
        let ends = info.ends.then(|| words.ends("Esc"));
        let urgent = key.into_iter().chain(&ends);
        let urgent = urgent.chain(&told.paused).chain(&told.message);
        let urgent: Vec<&str> = urgent.chain(&told.done).map(String::as_str).collect();
        // A summary that fills the panel has its heading where the strip is, where the panel fills the window.
        let shown = info.lesson.as_ref().filter(|_| info.happened.is_none());
        let step = shown.map_or_else(String::new, |shown| {
            let open = (shown.steps.iter()).find(|(mark, _)| *mark == Mark::Open);
            let open = open.map(|(_, text)| format!("{GAP}▶ {text}"));
            format!("{}{}", shown.step, open.unwrap_or_default())
        });
        Self {
            urgent: urgent.join(GAP),
            step,
            pouring: info.pouring_text(words).unwrap_or_default(),
            share: info.key_held.unwrap_or(0),
        }
    }

    fn is_empty(&self) -> bool {
        [&self.urgent, &self.step, &self.pouring]
            .iter()
            .all(|text| text.is_empty())
    }
}

/// The strip, which is painted anew only where its text or the window's size has changed.
#[derive(Default)]
pub struct Strip {
    said: Said,
    /// Its rows, 0x00RRGGBB, and the window's width and height and the text's height that they were painted for.
    pixels: Vec<u32>,
    of: Option<([u32; 2], f32)>,
}

impl Strip {
    /// Says that from now on.
    pub fn say(&mut self, said: Said) {
        self.said = said;
        self.of = None;
    }

    /// The uppermost rows of a window of that size, with text of that height, 0x00RRGGBB; none where nothing is said.
    pub fn pixels(&mut self, letters: &Letters, window: [u32; 2], size: f32) -> &[u32] {
        if self.of != Some((window, size)) {
            self.pixels = painted(letters, &self.said, window, size);
            self.of = Some((window, size));
        }
        &self.pixels
    }
}

fn painted(letters: &Letters, said: &Said, window: [u32; 2], size: f32) -> Vec<u32> {
    if said.is_empty() {
        return Vec::new();
    }
    let wide = window[0] as f32;
    let (blocks, image) = letters.lay(size, |lay| {
        let [margin, above] = [0.5 * size, 0.25 * size].map(f32::round);
        let mut room = wide - 2.0 * margin;
        let mut blocks: Vec<Block> = Vec::new();
        if !said.pouring.is_empty() {
            let laid = lay(&said.pouring, WHITE, f32::INFINITY, 1);
            let left = (wide - margin - laid.size().x).round();
            room -= laid.size().x + 2.0 * margin;
            blocks.push((laid, WHITE, pos2(left, above)));
        }
        let (mut upper, mut lines) = (above, LINES);
        for (text, colour) in [(&said.urgent, WARNING), (&said.step, WHITE)] {
            if lines > 0 && !text.is_empty() {
                let laid = lay(text, colour, room.max(size), lines);
                lines -= laid.rows.len().min(lines);
                let height = laid.size().y.round();
                blocks.push((laid, colour, pos2(margin, upper)));
                upper += height;
            }
        }
        blocks
    });
    let below = blocks.iter().map(|(laid, _, at)| at.y + laid.size().y);
    let rows = (below.fold(0.0, f32::max) + 0.25 * size).round() as usize;
    let [width, height] = window.map(|side| side as usize);
    let mut pixels = vec![packed(SAID); width * rows.min(height)];
    for block in &blocks {
        write(&mut pixels, width, &image, block);
    }
    let filled = width * said.share as usize / 100;
    let bar = (0.15 * size).ceil() as usize;
    for row in pixels.chunks_mut(width.max(1)).rev().take(bar) {
        for pixel in row.iter_mut().take(filled) {
            *pixel = packed(WARNING);
        }
    }
    pixels
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::desk::SCALES;
    use crate::info::{Pouring, Shown};
    use vitriol_lesson::Language;
    use vitriol_run::texts::Texts;

    /// A small window, and a laptop's screen.
    const WINDOWS: [[u32; 2]; 2] = [[800, 500], [1366, 768]];

    fn pixels(info: &Info, words: &PanelTexts, window: [u32; 2]) -> Vec<u32> {
        let (letters, mut strip) = (Letters::new(1.0), Strip::default());
        strip.say(Said::of(info, words));
        let size = letters.size(window, 1.0);
        strip.pixels(&letters, window, size).to_vec()
    }

    fn with_step(text: &str) -> Info {
        Info {
            lesson: Some(Shown {
                step: text.into(),
                ..Shown::default()
            }),
            ..Info::default()
        }
    }

    /// Pixels in which text of that kind is: bright ones, of which those of a warning have little blue.
    fn count(pixels: &[u32], warns: bool) -> usize {
        let is_of = |pixel: &&u32| {
            let [_, red, _, blue] = pixel.to_be_bytes();
            red > 150 && (blue < 110) == warns
        };
        pixels.iter().filter(is_of).count()
    }

    #[test]
    fn without_a_step_there_is_no_strip() {
        let words = Texts::english().unwrap().panel;
        for window in WINDOWS {
            assert!(pixels(&Info::default(), &words, window).is_empty());
        }
    }

    /// However long a text is, in letters and in Chinese characters, it takes two lines: less than an eighth of the window.
    #[test]
    fn a_step_is_read_and_covers_little() {
        let words = Texts::english().unwrap().panel;
        for window in WINDOWS {
            let [width, height] = window.map(|side| side as usize);
            for text in ["1 / 5   Pour the acid", "1 / 5   把硫酸倒入水中"] {
                let short = pixels(&with_step(text), &words, window);
                let long = pixels(&with_step(&text.repeat(20)), &words, window);
                assert!(count(&short, false) > 50, "{text} {window:?}");
                assert!(count(&long, false) > 2 * count(&short, false));
                assert_eq!(count(&short, true), 0);
                assert!(short.len() < long.len() && long.len().is_multiple_of(width));
                assert!(8 * long.len() < width * height, "{text} {window:?}");
            }
        }
    }

    /// However large a user wants text, the strip covers less than a quarter of the window.
    #[test]
    fn a_larger_text_leaves_the_bench_free() {
        let words = Texts::english().unwrap().panel;
        let said = Said::of(&with_step(&"Pour the acid ".repeat(40)), &words);
        for [width, height] in WINDOWS {
            let [least, usual, most] = [SCALES[0], 1.0, SCALES[1]].map(|scale| {
                let (letters, mut strip) = (Letters::new(scale), Strip::default());
                strip.say(said.clone());
                let size = letters.size([width, height], 1.0);
                strip.pixels(&letters, [width, height], size).len()
            });
            assert!(least < usual && usual < most);
            assert!(4 * most < (width * height) as usize, "{most}");
        }
    }

    #[test]
    fn a_pause_and_a_message_are_seen_beside_a_step() {
        for language in Language::ALL {
            let texts = Texts::of(language).unwrap();
            let mut info = with_step("1 / 5   Pour the acid");
            let plain = pixels(&info, &texts.panel, WINDOWS[0]);
            info.told.paused = Some(texts.instructor.held.clone());
            let paused = pixels(&info, &texts.panel, WINDOWS[0]);
            assert!(count(&paused, true) > 50, "{language}");
            assert!(paused.len() > plain.len(), "{language}");
            info.told.message = Some(texts.instructor.message("Goggles!"));
            let both = pixels(&info, &texts.panel, WINDOWS[0]);
            assert!(count(&both, true) > count(&paused, true), "{language}");
        }
    }

    /// What is poured stands at the right end, and an examination does not show it.
    #[test]
    fn a_pour_is_at_the_right_end() {
        let words = Texts::english().unwrap().panel;
        let mut info = with_step("1 / 5");
        info.pouring = Some(Pouring::of(12e-6, 4.2e-6));
        let right = |info: &Info| {
            let rows = pixels(info, &words, WINDOWS[0]);
            let halves = rows.chunks(400).skip(1).step_by(2);
            halves.map(|half| count(half, false)).sum::<usize>()
        };
        assert!(right(&info) > 50);
        info.lesson.as_mut().unwrap().quiet = true;
        assert_eq!(right(&info), 0);
    }

    /// The bar of a key's hold is as long as the hold has lasted.
    #[test]
    fn a_hold_fills_the_lower_edge() {
        let words = Texts::english().unwrap().panel;
        for percent in [0, 50, 100] {
            let info = Info {
                key_held: Some(percent),
                ..Info::default()
            };
            let rows = pixels(&info, &words, WINDOWS[0]);
            let last = rows.chunks(800).next_back().unwrap();
            let filled = last.iter().filter(|it| **it == packed(WARNING)).count();
            assert_eq!(filled, 8 * percent as usize);
        }
    }
}
