//! What the user can ask a session for: by a button, a key of the computer, the panel or, as an instructor, the console.

use vitriol_run::{Action, choices};

/// A request of the user to the session.
#[derive(Clone, Debug, PartialEq)]
pub enum Decision {
    /// Does an action in the run.
    Act(Action),
    /// Changes to the scene that shows the other order of acid and water. [`Decision::at`] says which one that is.
    Toggle,
    /// Moves the bench before the user.
    Recentre,
    /// Shows the summary of the attempt on the panel, or hides it.
    Summary,
    /// Ends the session.
    End,
    /// Ends the session as [`Decision::End`] does, but only where it is asked for again within five seconds: a key is soon pressed by
    /// mistake.
    AskEnd,
    /// The key of this decision went down in a desk's window; the decision counts when the key has been [held](super::hold) for long enough.
    /// `None`: the key is up again.
    Hold(Option<Box<Decision>>),
}

impl Decision {
    /// Whether it undoes what the user did, so that it takes a [`hold`](super::hold).
    pub fn loses_work(&self) -> bool {
        use Action::{Finish, Scene, Skip, Start};
        matches!(
            self,
            Self::Toggle | Self::Act(Scene(_) | Start(_) | Skip(_) | Finish)
        )
    }

    /// What is sent where its key goes down in a desk's window: there a key takes the hold that the panel's button takes.
    pub fn by_key(self) -> Self {
        match self.loses_work() {
            true => Self::Hold(Some(Box::new(self))),
            false => self,
        }
    }

    /// This decision where `present` is the scene in use. A toggle becomes the scene that it leads to; it is `None` where `present` has no
    /// other order.
    pub fn at(self, present: &str) -> Option<Self> {
        if self != Self::Toggle {
            return Some(self);
        }
        let other = choices::counterpart(present);
        if other.is_none() {
            tracing::info!("{present} has no other order");
        }
        other.map(|scene| Self::Act(Action::Scene(scene.into())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_toggle_leads_to_the_other_order() {
        let scene = |name: &str| Some(Decision::Act(Action::Scene(name.into())));
        let toggled = |present| Decision::Toggle.at(present);
        assert_eq!(toggled("acid-into-water"), scene("water-into-acid"));
        assert_eq!(toggled("water-into-acid"), scene("acid-into-water"));
        assert_eq!(toggled("layer-and-swirl"), scene("layer-and-swirl-right"));
        assert_eq!(toggled("hot-acid"), scene("acid-into-water"));
        assert_eq!(toggled("two-flasks"), None);
        // Nothing else depends on the scene.
        for decision in [Decision::Recentre, Decision::Act(Action::Start(None))] {
            assert_eq!(decision.clone().at("two-flasks"), Some(decision));
        }
        assert!(Decision::Toggle.loses_work());
    }

    #[test]
    fn a_key_takes_a_hold_where_the_panels_button_does() {
        use Action::{Answer, Hint, Skip, Start};
        let answer = Answer {
            step: None,
            answer: 1,
        };
        for action in [Start(None), Skip(None)] {
            let decision = Decision::Act(action);
            let held = Decision::Hold(Some(Box::new(decision.clone())));
            assert_eq!(decision.by_key(), held);
        }
        for decision in [
            Decision::AskEnd,
            Decision::Summary,
            Decision::Act(Hint(None)),
            Decision::Act(answer),
        ] {
            assert_eq!(decision.clone().by_key(), decision);
        }
    }
}
