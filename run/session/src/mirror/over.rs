//! What stands over the picture of a desk's window, at the window's resolution: the strip and the label.

use egui::{Rect, pos2};

use super::label::{Label, Said as LabelSaid};
use super::letters::Letters;
use super::strip::{Said as StripSaid, Strip};

/// Strip and label, and the fonts that both use.
pub struct Over {
    letters: Letters,
    strip: Strip,
    label: Label,
}

impl Over {
    /// Both say nothing yet; their text is `scale` times as high as usual.
    pub fn new(scale: f32) -> Self {
        Self {
            letters: Letters::new(scale),
            strip: Strip::default(),
            label: Label::default(),
        }
    }

    /// The strip says that from now on.
    pub fn strip(&mut self, said: StripSaid) {
        self.strip.say(said);
    }

    /// The label says that from now on, or nothing.
    pub fn label(&mut self, said: Option<LabelSaid>) {
        self.label.say(said);
    }

    /// Draws both over a window of that size, on a screen with `density` pixels a pixel of the usual density. `place` leads from the picture
    /// to the window (pixels), and there the pointer is.
    pub fn draw(
        &mut self,
        pixels: &mut [u32],
        (window, density): ([u32; 2], f32),
        place: impl Fn([f32; 2]) -> [f32; 2],
        pointer: Option<[f32; 2]>,
    ) {
        let size = self.letters.size(window, density);
        let rows = self.strip.pixels(&self.letters, window, size);
        for (pixel, painted) in pixels.iter_mut().zip(rows) {
            *pixel = *painted;
        }
        let width = window[0] as usize;
        let upper = rows.len() / width.max(1);
        let [right, lower] = window.map(|side| side as f32);
        let room = Rect::from_min_max(pos2(0.0, upper as f32), pos2(right, lower));
        let onto = (pixels, width);
        (self.label).draw(&self.letters, onto, (room, size), place, pointer);
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::info::{Info, Shown};
    use crate::panel::SAID;
    use vitriol_run::texts::Texts;

    /// What is at the picture's upper edge has its label under the strip.
    #[test]
    fn a_label_leaves_the_strip_free() {
        let words = Texts::english().unwrap().panel;
        let info = Info {
            lesson: Some(Shown {
                step: "1 / 5   Pour the acid".into(),
                ..Shown::default()
            }),
            ..Info::default()
        };
        let window = [640, 400];
        let mut over = Over::new(1.0);
        let mut drawn = |label: Option<LabelSaid>| {
            over.strip(StripSaid::of(&info, &words));
            over.label(label);
            let mut pixels = vec![0; 640 * 400];
            let place = |[x, y]: [f32; 2]| [640.0 * x, 400.0 * y];
            over.draw(&mut pixels, (window, 1.0), place, Some([200.0, 10.0]));
            pixels
        };
        let without = drawn(None);
        let strip = without.iter().take_while(|it| **it != 0).count();
        assert!(strip > 640 * 12 && strip.is_multiple_of(640), "{strip}");
        let with = drawn(Some(LabelSaid {
            text: "Sash".into(),
            bounds: [[0.0, 0.0], [1.0, 0.05]],
        }));
        assert_eq!(with[..strip], without[..strip]);
        let ground = u32::from_be_bytes([0, SAID.r(), SAID.g(), SAID.b()]);
        assert!(with[strip..].contains(&ground));
        assert!(!without[strip..].contains(&ground));
    }
}
