//! Length of the buffers of server and device: short, so that sound comes soon, and longer where they run dry.

use crate::RATE;

/// Samples at first: 25 ms. A thread without a real-time priority is seldom away for longer.
const FIRST: u32 = RATE / 40;
/// Samples at most: 120 ms. A blow that is heard later than that is perceived apart from the one that is seen, and a machine on which this
/// runs dry has no time for sound.
const MOST: u32 = RATE * 12 / 100;
/// Samples between one lengthening and the next: half a second's. While a server fills the longer buffer it may run dry again.
const BETWEEN: u64 = RATE as u64 / 2;

/// The length that the server's buffer is asked to have, and when it may be asked for a longer one.
#[derive(Debug)]
pub(super) struct Length {
    target: u32,
    /// Samples given since the server agreed to `target`; `None` while it has not.
    given: Option<u64>,
}

impl Length {
    pub fn new() -> Self {
        // The first lengthening may come at once.
        let given = Some(BETWEEN);
        Self {
            target: FIRST,
            given,
        }
    }

    /// Samples that server and device hold, or are asked to hold.
    pub fn target(&self) -> u32 {
        self.target
    }

    /// Counts `samples` that were given.
    pub fn gave(&mut self, samples: usize) {
        self.given = self.given.map(|given| given + samples as u64);
    }

    /// Call it when the server has run dry. Returns whether to ask for a longer buffer. It does not shrink again: a machine that was busy
    /// once will be again.
    pub fn lengthen(&mut self) -> bool {
        let due = self.given.is_some_and(|given| given >= BETWEEN) && self.target < MOST;
        if due {
            self.target = (2 * self.target).min(MOST);
            self.given = None;
        }
        due
    }

    /// Call it when the server has agreed to the target.
    pub fn agreed(&mut self) {
        self.given = Some(0);
    }
}
