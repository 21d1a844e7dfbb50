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

    /// Waits for the next try, `longest` at most. Returns whether it is due; then the one after it is due twice as late.
    pub(super) fn wait(&mut self, longest: Duration) -> bool {
        let (time, due) = self.plan(Instant::now(), longest);
        std::thread::sleep(time);
        due
    }

    /// The time to wait from `now` on, and whether the try is due then.
    fn plan(&mut self, now: Instant, longest: Duration) -> (Duration, bool) {
        let left = self.due.saturating_duration_since(now);
        if left > longest {
            return (longest, false);
        }
        self.due = now + left + self.wait;
        self.wait = (2 * self.wait).min(LONGEST);
        (left, true)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    #[test]
    fn the_wait_doubles_to_its_end() {
        let milliseconds = Duration::from_millis;
        let mut seek = Seek::begin();
        // By a clock that goes only as the seeker waits, in turns of 300 ms at most.
        let mut now = seek.due;
        let (mut last, mut waits) = (now, Vec::new());
        while waits.len() < 10 {
            let (time, due) = seek.plan(now, milliseconds(300));
            assert!(due || time == milliseconds(300));
            now += time;
            if due {
                waits.push((now - last).as_millis());
                last = now;
            }
        }
        let wanted = [0, 100, 200, 400, 800, 1600, 3200, 5000, 5000, 5000];
        assert_eq!(waits, wanted);
        // And by the real one.
        seek.due = Instant::now() + LONGEST;
        let begun = Instant::now();
        assert!(!seek.wait(milliseconds(10)));
        assert!(begun.elapsed() >= milliseconds(10));
    }
}
