//! Takes states and pictures from a port to their sink, on a thread of its own that may wait.

use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::picture::EncodedPicture;
use crate::port::Feed;
use crate::student::State;

/// Time between two states. Our choice: a curve with 20 points a second is smooth, and more would cost frames time.
const STATE_PERIOD: Duration = Duration::from_millis(50);
/// The longest sleep. New items wake it earlier.
const LONGEST: Duration = Duration::from_secs(1);

/// Receiver of a port's states and pictures.
pub(crate) trait Sink {
    /// Takes a state of the student.
    fn state(&mut self, state: State);
    /// A picture, and whether one of H.264 is missing before it.
    fn picture(&mut self, gap: bool, picture: Arc<EncodedPicture>);
}

/// Runs until the last port is gone, or `stop` returns true.
pub(crate) fn run(mut feed: Feed, sink: &mut impl Sink, stop: impl Fn() -> bool) {
    feed.wake_this_thread();
    let mut next_state = Instant::now();
    loop {
        // Queried before the items are taken, so that a student's last ones are not lost.
        let over = feed.closed() || stop();
        for (gap, picture) in feed.take_pictures() {
            sink.picture(gap, picture);
        }
        let now = Instant::now();
        let early = next_state.saturating_duration_since(now);
        if (early.is_zero() || over)
            && let Some(state) = feed.take_state()
        {
            sink.state(state);
            next_state = now + STATE_PERIOD;
        }
        if over {
            return;
        }
        feed.wait(if early.is_zero() { LONGEST } else { early });
    }
}
