//! Devices that were lost, and when to give up.

/// Frames after which a loss is no longer taken for the cause of the next one: ten seconds at 90 Hz.
const APART: u64 = 900;
/// Losses in a row after which the session ends: what loses each device anew is no accident, but a driver or the program.
const MOST: u32 = 3;
/// Frames in which the panel reports a loss: ten seconds at 90 Hz.
const SAID: u64 = 900;

/// Counts devices that were lost, and decides when the session gives up.
#[derive(Debug, Default)]
pub(super) struct Losses {
    /// Those after which the bench was brought back.
    pub count: u32,
    in_a_row: u32,
    /// Frame of the last one.
    last: Option<u64>,
    /// A device is lost, and there is no other one yet.
    pending: bool,
}

impl Losses {
    /// Takes in that a device was lost in that frame; returns whether the session is to go on with another. A second call for the same loss
    /// means that no other device was found, and returns false.
    pub fn may_go_on(&mut self, frame: u64) -> bool {
        if std::mem::replace(&mut self.pending, true) {
            return false;
        }
        let soon = self.last.is_some_and(|last| frame - last < APART);
        self.in_a_row = if soon { self.in_a_row + 1 } else { 1 };
        self.last = Some(frame);
        self.in_a_row <= MOST
    }

    /// Takes in that in that frame the bench is on another device, and goes on there.
    pub fn brought_back(&mut self, frame: u64) {
        self.pending = false;
        self.count += 1;
        // With its runtime a device goes unsaid.
        self.last = Some(frame);
    }

    /// Whether the panel reports the loss in that frame.
    pub fn is_said(&self, frame: u64) -> bool {
        self.last.is_some_and(|last| frame - last < SAID)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn survived(losses: &mut Losses, frame: u64) -> bool {
        let goes_on = losses.may_go_on(frame);
        losses.brought_back(frame);
        goes_on
    }

    #[test]
    fn three_in_a_row_are_borne_and_any_number_that_are_far_apart() {
        let mut losses = Losses::default();
        assert!((0..10).all(|n| survived(&mut losses, n * APART)));
        assert!(losses.is_said(9 * APART + 5) && !losses.is_said(9 * APART + SAID));
        let soon = [1, 2, 3].map(|n| survived(&mut losses, 9 * APART + n));
        assert_eq!(soon, [true, true, false]);
        assert_eq!(losses.count, 13);
    }

    #[test]
    fn where_no_other_device_is_found_it_ends() {
        let mut losses = Losses::default();
        assert!(losses.may_go_on(5) && !losses.may_go_on(5));
        assert_eq!(losses.count, 0);
    }
}
