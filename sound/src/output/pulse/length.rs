//! How much server and device hold: little, so that sound comes soon, and more where that runs dry.

use crate::RATE;

/// Samples at first: 25 ms. A thread without a real-time priority is seldom away for longer.
const FIRST: u32 = RATE / 40;
/// Samples at most: 120 ms. A blow that is heard later than that is told from the one that is seen, and a machine on which this
/// runs dry has no time for sound.
const MOST: u32 = RATE * 12 / 100;
/// Samples between one lengthening and the next: half a second's. While a server fills the longer buffer it may run dry again.
const BETWEEN: u64 = RATE as u64 / 2;

/// See the module.
#[derive(Debug)]
pub(super) struct Length {
    target: u32,
    /// Samples given since the server agreed to `target`; `None` while it has not.
    given: Option<u64>,
}

impl Length {
    pub fn new() -> Self {
        // The first may come at once.
        let given = Some(BETWEEN);
        Self {
            target: FIRST,
            given,
        }
    }

    /// Samples that they hold, or are asked to.
    pub fn target(&self) -> u32 {
        self.target
    }

    /// So many samples more were given.
    pub fn gave(&mut self, samples: usize) {
        self.given = self.given.map(|given| given + samples as u64);
    }

    /// The server has run dry: whether another target is to be asked for. It does not shrink again: what was busy once will be.
    pub fn lengthen(&mut self) -> bool {
        let due = self.given.is_some_and(|given| given >= BETWEEN) && self.target < MOST;
        if due {
            self.target = (2 * self.target).min(MOST);
            self.given = None;
        }
        due
    }

    /// The server agrees.
    pub fn agreed(&mut self) {
        self.given = Some(0);
    }
}
