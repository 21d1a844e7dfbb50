//! What the user chooses, by button, key and panel.

use std::sync::mpsc::Receiver;

use vitriol_xr::Hand;

use crate::vr::decision::Decision;
use crate::vr::inputs::Buttons;

/// Collects decisions until the next frame does them.
pub(super) struct Choices {
    /// Decisions of the terminal's and the mirror window's keys.
    elsewhere: Receiver<Decision>,
    buttons: Buttons,
    /// Decided and not done yet.
    wanted: Vec<Decision>,
}

/// What a frame has to do.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Chosen {
    /// This scene from its start.
    pub scene: Option<String>,
    /// The bench before the user.
    pub recentre: bool,
}

impl Choices {
    /// None yet; `elsewhere` brings those of keys.
    pub fn new(elsewhere: Receiver<Decision>) -> Self {
        Self {
            elsewhere,
            buttons: Buttons::default(),
            wanted: Vec::new(),
        }
    }

    /// Takes in what the keys said; whether the end was asked for, which waits for no frame.
    pub fn hear(&mut self) -> bool {
        self.wanted.extend(self.elsewhere.try_iter());
        let all = self.wanted.len();
        self.wanted.retain(|decision| *decision != Decision::End);
        self.wanted.len() < all
    }

    /// Takes in what was pressed on the panel.
    pub fn add(&mut self, decision: Option<Decision>) {
        self.wanted.extend(decision);
    }

    /// What is to be done in a frame with these hands, beside the scene `present`. Of several scenes it is the
    /// last; a decision counts more than a button.
    pub fn take(&mut self, hands: &[Hand; 2], present: &str) -> Chosen {
        let pressed = self.buttons.advance(hands);
        let mut chosen = Chosen {
            scene: pressed.start.then(|| present.to_owned()),
            recentre: pressed.recentre,
        };
        for decision in std::mem::take(&mut self.wanted) {
            match decision {
                Decision::Scene(name) => chosen.scene = Some(name),
                Decision::Start => chosen.scene = Some(present.to_owned()),
                Decision::Recentre => chosen.recentre = true,
                // `hear` says it before the next frame.
                Decision::End => self.wanted.push(decision),
            }
        }
        chosen
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use std::sync::mpsc::channel;

    fn scene(name: &str) -> Decision {
        Decision::Scene(name.into())
    }

    #[test]
    fn the_last_scene_is_taken_and_each_decision_once() {
        let (keys, elsewhere) = channel();
        let mut choices = Choices::new(elsewhere);
        let hands = [Hand::default(), Hand::default()];
        for decision in [scene("first"), Decision::Recentre, scene("second")] {
            keys.send(decision).unwrap();
        }
        assert!(!choices.hear());
        let chosen = choices.take(&hands, "present");
        let scene = Some("second".to_owned());
        let expected = Chosen {
            scene,
            recentre: true,
        };
        assert_eq!(chosen, expected);
        assert_eq!(choices.take(&hands, "present"), Chosen::default());
        // A start is one of the scene that is there.
        choices.add(Some(Decision::Start));
        let chosen = choices.take(&hands, "present");
        assert_eq!(chosen.scene.as_deref(), Some("present"));
    }

    #[test]
    fn the_end_is_heard_with_what_was_decided_before_it() {
        let (keys, elsewhere) = channel();
        let mut choices = Choices::new(elsewhere);
        keys.send(scene("other")).unwrap();
        keys.send(Decision::End).unwrap();
        assert!(choices.hear());
        assert!(!choices.hear());
        let hands = [Hand::default(), Hand::default()];
        assert_eq!(choices.take(&hands, "x").scene.as_deref(), Some("other"));
    }

    #[test]
    fn a_key_counts_more_than_a_button() {
        let (keys, elsewhere) = channel();
        let mut choices = Choices::new(elsewhere);
        let b = Hand {
            active: true,
            button_b: true,
            ..Hand::default()
        };
        let hands = [Hand::default(), b];
        keys.send(scene("other")).unwrap();
        choices.hear();
        assert_eq!(choices.take(&hands, "x").scene.as_deref(), Some("other"));
        // Held down it is no longer pressed; let go and pressed again it is.
        assert_eq!(choices.take(&hands, "x").scene, None);
        let up = Hand {
            active: true,
            ..Hand::default()
        };
        choices.take(&[Hand::default(), up], "x");
        assert_eq!(choices.take(&hands, "x").scene.as_deref(), Some("x"));
    }
}
