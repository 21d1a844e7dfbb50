//! What the user chooses, by button, key and panel.

use std::sync::mpsc::Receiver;
use std::time::{Duration, Instant};

use vitriol_run::Action;
use vitriol_xr::Hand;

use crate::decision::Decision;
use crate::hold::Hold;
use crate::inputs::Buttons;

/// Within this time the end must be asked for again.
const AGAIN: Duration = Duration::from_secs(5);

/// How long it is said that a key which was tapped is to be held. Our choice: the line is read twice in that.
const TOLD: Duration = Duration::from_secs(3);

/// Collects decisions until the next frame does them.
pub(super) struct Choices {
    /// Decisions of the terminal's and the window's keys.
    elsewhere: Receiver<Decision>,
    buttons: Buttons,
    /// Decided and not done yet.
    wanted: Vec<Decision>,
    /// When the end was asked for once.
    asked: Option<Instant>,
    /// A key of a desk's window that is down, and what it decides.
    key: Option<(Decision, Hold)>,
    /// When such a key went up too early.
    tapped: Option<Instant>,
}

impl Choices {
    /// None yet; `elsewhere` brings those of keys.
    pub fn new(elsewhere: Receiver<Decision>) -> Self {
        Self {
            elsewhere,
            buttons: Buttons::default(),
            wanted: Vec::new(),
            asked: None,
            key: None,
            tapped: None,
        }
    }

    /// Takes in the decisions of keys until `now`; returns whether the end was asked for, which waits for no frame.
    pub fn hear(&mut self, now: Instant) -> bool {
        let mut ends = false;
        for decision in self.elsewhere.try_iter() {
            match decision {
                Decision::End => ends = true,
                Decision::AskEnd if self.asks_to_end(now) => ends = true,
                Decision::AskEnd => self.asked = Some(now),
                Decision::Hold(Some(decision)) => self.key = Some((*decision, Hold::default())),
                // Where it was held for long enough, `take` has taken it.
                Decision::Hold(None) => {
                    if self.key.take().is_some() {
                        self.tapped = Some(now);
                    }
                }
                decision => self.wanted.push(decision),
            }
        }
        ends
    }

    /// Drops the decisions of keys until `now`, but for the end; returns whether that was asked for.
    pub fn forget(&mut self, now: Instant) -> bool {
        let ends = self.hear(now);
        self.wanted.clear();
        (self.key, self.tapped) = (None, None);
        ends
    }

    /// Whether the end was asked for once, and is not confirmed yet.
    pub fn asks_to_end(&self, now: Instant) -> bool {
        self.asked
            .is_some_and(|asked| now.duration_since(asked) < AGAIN)
    }

    /// How far a hold of the button for a new start has come at that display time (ns), 0 to 1.
    pub fn holding(&self, now: i64) -> Option<f32> {
        self.buttons.holding(now)
    }

    /// How far the hold of a desk's key has come at the display time `shown_at` (ns), 0 to 1; 0 also for a short time after a tap.
    pub fn key_held(&self, shown_at: i64, now: Instant) -> Option<f32> {
        let share = (self.key.as_ref()).map(|(_, hold)| hold.share(shown_at).unwrap_or(0.0));
        let tapped = (self.tapped).is_some_and(|tapped| now.duration_since(tapped) < TOLD);
        share.or(tapped.then_some(0.0))
    }

    /// Takes in what was pressed on the panel.
    pub fn add(&mut self, decision: Option<Decision>) {
        self.wanted.extend(decision);
    }

    /// What is to be done in a frame with these hands, shown at `now` (ns), in its order. Of several scenes it is the last; a decision
    /// counts more than a button.
    pub fn take(&mut self, hands: &[Hand; 2], now: i64) -> Vec<Decision> {
        let pressed = self.buttons.advance(hands, now);
        let start = Decision::Act(Action::Start(None));
        let buttons = [
            (pressed.start, start),
            (pressed.recentre, Decision::Recentre),
        ];
        let buttons = buttons.into_iter().filter(|(pressed, _)| *pressed);
        let mut chosen: Vec<Decision> = buttons.map(|(_, decision)| decision).collect();
        let held = self.key.take_if(|(_, hold)| hold.advance(true, now));
        if let Some((decision, _)) = held {
            chosen.push(decision);
            self.tapped = None;
        }
        chosen.append(&mut self.wanted);
        let last = chosen.iter().rposition(brings_up);
        let mut at = 0..;
        chosen.retain(|decision| at.next() == last || !brings_up(decision));
        chosen
    }
}

fn brings_up(decision: &Decision) -> bool {
    use Action::{Scene, Start};
    matches!(
        decision,
        Decision::Toggle | Decision::Act(Scene(_) | Start(_))
    )
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use std::sync::mpsc::channel;

    fn scene(name: &str) -> Decision {
        Decision::Act(Action::Scene(name.into()))
    }

    #[test]
    fn the_last_scene_is_taken_and_each_decision_once() {
        let (keys, elsewhere) = channel();
        let mut choices = Choices::new(elsewhere);
        let hands = [Hand::default(), Hand::default()];
        let hint = Decision::Act(Action::Hint(None));
        for decision in [scene("first"), Decision::Recentre, hint, scene("second")] {
            keys.send(decision).unwrap();
        }
        assert!(!choices.hear(Instant::now()));
        let expected = [
            Decision::Recentre,
            Decision::Act(Action::Hint(None)),
            scene("second"),
        ];
        assert_eq!(choices.take(&hands, 0), expected);
        assert_eq!(choices.take(&hands, 0), []);
        // Nor does the other order come up beside a scene.
        for decision in [scene("first"), Decision::Toggle] {
            keys.send(decision).unwrap();
        }
        assert!(!choices.hear(Instant::now()));
        assert_eq!(choices.take(&hands, 0), [Decision::Toggle]);
    }

    /// At a desk a key that would lose work is held for a second, as the panel's button is; after a tap it is said so.
    #[test]
    fn a_key_that_loses_work_is_held() {
        let (keys, elsewhere) = channel();
        let mut choices = Choices::new(elsewhere);
        let hands = [Hand::default(), Hand::default()];
        let (begun, ms) = (Instant::now(), |n: i64| 1_000_000 * n);
        let start = Decision::Act(Action::Start(None));
        // Other decisions count at once.
        assert_eq!(Decision::Summary.by_key(), Decision::Summary);
        keys.send(start.clone().by_key()).unwrap();
        assert!(!choices.hear(begun));
        assert_eq!(choices.take(&hands, ms(0)), []);
        assert_eq!(choices.take(&hands, ms(500)), []);
        assert_eq!(choices.key_held(ms(500), begun), Some(0.5));
        keys.send(Decision::Hold(None)).unwrap();
        assert!(!choices.hear(begun));
        assert_eq!(choices.take(&hands, ms(2000)), []);
        let told = |after| choices.key_held(ms(2000), begun + Duration::from_secs(after));
        assert_eq!([2, 4].map(told), [Some(0.0), None]);
        // Held for a second it counts, once.
        keys.send(start.clone().by_key()).unwrap();
        assert!(!choices.hear(begun));
        assert_eq!(choices.take(&hands, ms(3000)), []);
        assert_eq!(choices.take(&hands, ms(4000)), [start]);
        assert_eq!(choices.key_held(ms(4000), begun), None);
        assert_eq!(choices.take(&hands, ms(9000)), []);
    }

    #[test]
    fn the_end_is_heard_with_what_was_decided_before_it() {
        let (keys, elsewhere) = channel();
        let mut choices = Choices::new(elsewhere);
        keys.send(scene("other")).unwrap();
        keys.send(Decision::End).unwrap();
        assert!(choices.hear(Instant::now()));
        assert!(!choices.hear(Instant::now()));
        let hands = [Hand::default(), Hand::default()];
        assert_eq!(choices.take(&hands, 0), [scene("other")]);
    }

    #[test]
    fn a_key_that_ends_is_pressed_twice() {
        let (keys, elsewhere) = channel();
        let mut choices = Choices::new(elsewhere);
        let start = Instant::now();
        let mut press = |seconds: u64| {
            keys.send(Decision::AskEnd).unwrap();
            choices.hear(start + Duration::from_secs(seconds))
        };
        assert!(!press(0));
        // Too late.
        assert!(!press(6));
        assert!(press(8));
    }

    /// Of what is typed while a session is made ready the end alone counts.
    #[test]
    fn what_is_forgotten_is_not_done() {
        let now = Instant::now();
        for (asks, ends) in [(0, false), (1, false), (2, true)] {
            let (keys, elsewhere) = channel();
            let mut choices = Choices::new(elsewhere);
            keys.send(scene("other")).unwrap();
            for _ in 0..asks {
                keys.send(Decision::AskEnd).unwrap();
            }
            assert_eq!(choices.forget(now), ends, "{asks}");
            let hands = [Hand::default(), Hand::default()];
            assert_eq!(choices.take(&hands, 0), []);
        }
    }

    #[test]
    fn a_key_counts_more_than_a_button() {
        let (keys, elsewhere) = channel();
        let mut choices = Choices::new(elsewhere);
        let b = |down| {
            let hand = Hand {
                active: true,
                button_b: down,
                ..Hand::default()
            };
            [Hand::default(), hand]
        };
        let mut frame = |down, seconds: i64, key: bool| {
            if key {
                keys.send(scene("other")).unwrap();
                choices.hear(Instant::now());
            }
            choices.take(&b(down), 1_000_000_000 * seconds)
        };
        assert_eq!(frame(true, 0, false), []);
        assert_eq!(frame(true, 1, true), [scene("other")]);
        // Held on it counts no more; let go and held again it does.
        assert_eq!(frame(true, 2, false), []);
        assert_eq!(frame(false, 3, false), []);
        assert_eq!(frame(true, 4, false), []);
        assert_eq!(frame(true, 5, false), [Decision::Act(Action::Start(None))]);
    }
}
