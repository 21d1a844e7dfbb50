//! When to try a lost runtime again: at once, then after a wait that doubles.

use std::time::{Duration, Instant};

/// First wait: a service that is started again is there within some tenths of a second.
const FIRST: Duration = Duration::from_millis(100);
/// Longest wait: a student who has put things right does not wait long for the picture.
const LONGEST: Duration = Duration::from_secs(5);

/// The tries so far.
#[derive(Debug)]
pub(super) struct Seek {
    due: Instant,
    wait: Duration,
}

impl Seek {
    /// The first try is due now.
    pub(super) fn begin() -> Self {
        Self {
            due: Instant::now(),
            wait: FIRST,
        }
    }

    /// Waits for the next try, `longest` at most. Whether it is due; then the one after it is
    /// due twice as late.
    pub(super) fn wait(&mut self, longest: Duration) -> bool {
        let left = self.due.saturating_duration_since(Instant::now());
        if left > longest {
            std::thread::sleep(longest);
            return false;
        }
        std::thread::sleep(left);
        self.due = Instant::now() + self.wait;
        self.wait = (2 * self.wait).min(LONGEST);
        true
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    #[test]
    fn the_wait_doubles_to_its_end() {
        let mut seek = Seek::begin();
        let mut waits = Vec::new();
        for _ in 0..9 {
            // As if the time had come.
            seek.due = Instant::now();
            assert!(seek.wait(Duration::ZERO));
            waits.push(
                seek.due
                    .saturating_duration_since(Instant::now())
                    .as_secs_f64(),
            );
        }
        let wanted = [0.1, 0.2, 0.4, 0.8, 1.6, 3.2, 5.0, 5.0, 5.0];
        for (got, wanted) in waits.iter().zip(wanted) {
            // A busy machine may take some time between the two looks at the clock.
            assert!(*got <= wanted && *got > wanted - 0.05, "{waits:?}");
        }
        let begun = Instant::now();
        assert!(!seek.wait(Duration::from_millis(10)));
        assert!(begun.elapsed() >= Duration::from_millis(10));
    }
}
