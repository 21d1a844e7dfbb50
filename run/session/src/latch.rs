//! Grip by pressing twice, for who cannot hold a button pressed: the first press takes hold, the second lets go.

use vitriol_xr::{Hand, Side};

/// Squeeze or trigger from which on a button is pressed, and below which it is let go; as hands close and open
/// (`bodies::GRIP_CLOSES`).
const PRESSED: f32 = 0.6;
const LET_GO: f32 = 0.4;

/// How a hand grips.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Grip {
    /// As long as squeeze, trigger or the mouse's main button is held
    #[default]
    Hold,
    /// From one press of them to the next
    Toggle,
}

/// Both hands' buttons.
#[derive(Clone, Copy, Debug, Default)]
pub struct Latches([Latch; 2]);

#[derive(Clone, Copy, Debug, Default)]
struct Latch {
    down: bool,
    /// This press lets go.
    opens: bool,
    closed: bool,
}

impl Latches {
    /// Keeps the hand closed, or opens it, that `holds` something.
    pub fn apply(&mut self, side: Side, hand: &mut Hand, holds: bool) {
        // Of a controller that sleeps nothing is known.
        if !hand.active {
            return;
        }
        let latch = &mut self.0[side as usize];
        let pressed = hand.squeeze.max(hand.trigger);
        let was = latch.down;
        latch.down = pressed >= if was { LET_GO } else { PRESSED };
        if latch.down && !was {
            latch.opens = holds;
        }
        latch.opens &= latch.down;
        // A press that took hold of nothing is none.
        latch.closed = holds && !latch.opens;
        if latch.opens {
            (hand.squeeze, hand.trigger) = (0.0, 0.0);
        } else if latch.closed {
            hand.squeeze = 1.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_second_press_lets_go() {
        let mut latches = Latches::default();
        let mut frame = |pressed: f32, holds: bool| {
            let mut hand = Hand {
                active: true,
                trigger: pressed,
                ..Hand::default()
            };
            latches.apply(Side::Left, &mut hand, holds);
            hand.squeeze.max(hand.trigger)
        };
        // A press in the air closes the hand, and no longer than it lasts.
        assert_eq!([frame(1.0, false), frame(0.0, false)], [1.0, 0.0]);
        // One that takes hold: the world has it a frame later.
        assert_eq!([frame(1.0, false), frame(1.0, true)], [1.0, 1.0]);
        assert_eq!([frame(0.0, true), frame(0.3, true)], [1.0, 1.0]);
        // The next opens at once, and the hand stays open for as long as it lasts.
        assert_eq!([frame(0.7, true), frame(1.0, false)], [0.0, 0.0]);
        assert_eq!([frame(0.5, false), frame(0.0, false)], [0.0, 0.0]);
        assert_eq!(frame(1.0, false), 1.0);
    }

    #[test]
    fn a_hand_that_sleeps_does_not_open() {
        let mut latches = Latches::default();
        let mut hand = Hand::default();
        latches.apply(Side::Right, &mut hand, true);
        assert_eq!(hand, Hand::default());
    }
}
