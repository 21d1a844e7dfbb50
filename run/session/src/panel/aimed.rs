//! The panel's button that a hand points at.

use egui::{Rect, Response};

/// A button that a hand points at, and can press.
#[derive(Clone, Debug, PartialEq)]
pub struct Aimed {
    /// Its text, in one line.
    pub text: String,
    /// Where it is on the panel, pixels.
    pub bounds: Rect,
    /// Whether it is held for a second, and not only pressed.
    pub holds: bool,
}

impl Aimed {
    /// The button of that text which was laid out, if a hand points at it.
    pub fn at(button: &Response, text: &str, holds: bool) -> Option<Self> {
        button.hovered().then(|| Self {
            text: text.replace('\n', " "),
            bounds: button.rect,
            holds,
        })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use std::collections::BTreeMap;

    use egui::{Event, pos2};

    use crate::info::{Info, Shown};
    use crate::panel::{input, view};
    use vitriol_run::texts::Texts;

    /// The buttons of a panel that shows this session, each with whether it is held: a pointer goes down its columns and takes in whatever
    /// it is at.
    fn buttons(info: &Info) -> BTreeMap<String, bool> {
        let words = Texts::english().unwrap().panel;
        let context = view::context();
        let mut found = BTreeMap::new();
        for x in [575.0, 740.0, 900.0] {
            for y in (10..864).step_by(16) {
                let at = pos2(x, y as f32);
                // What is under a pointer is known from where it was laid out before.
                for pass in 0..2 {
                    let input = input(vec![Event::PointerMoved(at)]);
                    let mut aimed = None;
                    let _ = context.run(input, |context| {
                        aimed = view::show(context, (info, &words), None, None).aimed;
                    });
                    if let (1, Some(aimed)) = (pass, aimed) {
                        // egui takes what is nearly under a pointer too.
                        let near = context.style().interaction.interact_radius;
                        let bounds = aimed.bounds.expand(near);
                        assert!(bounds.contains(at), "{aimed:?} {at:?}");
                        found.insert(aimed.text, aimed.holds);
                    }
                }
            }
        }
        found
    }

    /// What would lose work is held; a scene's two lines are one.
    #[test]
    fn buttons_are_known_with_how_they_are_pressed() {
        let scenes = buttons(&Info::default());
        for (text, holds) in [
            ("B   From the start", true),
            ("S   What happened", false),
            ("1 ✔ acid into water", true),
        ] {
            assert_eq!(scenes.get(text), Some(&holds), "{text}: {scenes:?}");
        }
        let asks = buttons(&Info {
            lesson: Some(Shown {
                step: "What will happen?".into(),
                answers: ["Nothing.", "It boils.", "It freezes."]
                    .map(str::to_owned)
                    .into(),
                ..Shown::default()
            }),
            ..Info::default()
        });
        assert_eq!(asks.get("K   It boils."), Some(&false), "{asks:?}");
    }
}
