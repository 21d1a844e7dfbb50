//! When the simulation steps, between the times of two display frames.
//!
//! The simulation has a step of its own and the display a rate of its own. The poses that a runtime
//! predicts for a frame are those of the time at which its picture is seen, so simulated time is
//! display time: a frame takes the steps whose ends lie in the time since the frame before, each
//! with the poses of its own end, between those of the two frames. The last of them ends less than
//! a step before the picture is seen, which is all that this adds to the delay from hand to flask.

/// Most steps in a frame. A display of 20 Hz has 4.5 at 90 Hz of simulation. A machine on which more are due is too
/// slow, and more steps in each frame would make it slower still.
pub const MOST_STEPS: u32 = 5;

/// Turns display times into steps.
#[derive(Clone, Debug)]
pub struct StepClock {
    /// Simulated seconds a second of the display, above 0 to 1. The hands' way is spread over fewer steps then, so that seen from the
    /// bench they are faster.
    pub rate: f64,
    /// Display time of the last frame, ns.
    last: Option<i64>,
    /// Simulated time between the end of the last step and the display time, s; less than a step.
    pub since: f64,
    /// Time that the simulation was too slow for, s.
    pub slowed: f64,
}

impl Default for StepClock {
    fn default() -> Self {
        Self {
            rate: 1.0,
            last: None,
            since: 0.0,
            slowed: 0.0,
        }
    }
}

/// A frame's steps.
#[derive(Clone, Debug, PartialEq)]
pub struct Due {
    /// For each step the place of its end between the last frame's display time (0) and this
    /// one's (1).
    pub ends: Vec<f32>,
    /// Simulated time that is not simulated, s; above 0 where the machine is too slow.
    pub skipped: f64,
}

impl StepClock {
    /// The steps of `frame_time` (s) that are due in the frame whose picture is seen at `display_ns`.
    /// None in the first frame, and after [`StepClock::pause`].
    pub fn advance(&mut self, display_ns: i64, frame_time: f64) -> Due {
        let mut due = Due {
            ends: Vec::new(),
            skipped: 0.0,
        };
        let last = self.last.replace(display_ns);
        let Some(passed) = last.map(|last| display_ns.saturating_sub(last)) else {
            return due;
        };
        if passed < 1 {
            return due;
        }
        let passed = 1e-9 * self.rate * passed as f64;
        // The display's times are rounded to ns: a step that lacks less than a millionth of itself is due.
        let whole = ((self.since + passed) / frame_time + 1e-6).floor();
        if whole <= f64::from(MOST_STEPS) {
            let end = |step: u32| (f64::from(step) * frame_time - self.since) / passed;
            due.ends = (1..=whole as u32)
                .map(|step| end(step).clamp(0.0, 1.0) as f32)
                .collect();
            self.since = (self.since + passed - whole * frame_time).max(0.0);
        } else {
            // Slow motion: the hands' whole way is spread over fewer steps.
            due.ends = (1..=MOST_STEPS)
                .map(|step| step as f32 / MOST_STEPS as f32)
                .collect();
            due.skipped = self.since + passed - f64::from(MOST_STEPS) * frame_time;
            self.since = 0.0;
            self.slowed += due.skipped;
        }
        due
    }

    /// The display stands still: what passes until its next frame is not simulated.
    pub fn pause(&mut self) {
        self.last = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEP: f64 = 1.0 / 90.0;

    fn ns(seconds: f64) -> i64 {
        (1e9 * seconds).round() as i64
    }

    /// Display times at which the steps of frames at these times end.
    fn ends(times: &[f64], frame_time: f64) -> Vec<f64> {
        let mut clock = StepClock::default();
        let mut all = Vec::new();
        let mut last = times[0];
        for &time in times {
            let due = clock.advance(ns(time), frame_time);
            assert!(due.ends.len() <= MOST_STEPS as usize);
            all.extend(
                due.ends
                    .iter()
                    .map(|&s| last + (time - last) * f64::from(s)),
            );
            last = time;
        }
        all
    }

    /// At whatever rate the display runs, steps end at multiples of the step from the start on.
    #[test]
    fn steps_keep_their_own_time() {
        for rate in [20.0, 60.0, 72.0, 90.0, 120.0, 144.0] {
            for frame_time in [STEP, 1.0 / 60.0] {
                let times: Vec<f64> = (0..400).map(|n| 7.0 + f64::from(n) / rate).collect();
                let ends = ends(&times, frame_time);
                let all = 399.0 / rate / frame_time;
                assert!(
                    (ends.len() as f64 - all).abs() < 1.0 + 1e-6,
                    "{rate} {}",
                    ends.len()
                );
                for (n, end) in ends.iter().enumerate() {
                    let expected = 7.0 + (n + 1) as f64 * frame_time;
                    // Display times are whole nanoseconds, places are of 32 bits.
                    assert!((end - expected).abs() < 1e-6, "{rate} Hz, step {n}: {end}");
                }
            }
        }
    }

    /// A jittering display has the same steps.
    #[test]
    fn jitter_moves_no_step() {
        let times: Vec<f64> = (0..300)
            .map(|n| f64::from(n) / 90.0 + 0.004 * (f64::from(n) * 2.1).sin())
            .collect();
        let ends = ends(&times, STEP);
        for (n, end) in ends.iter().enumerate() {
            assert!((end - times[0] - (n + 1) as f64 * STEP).abs() < 1e-6);
        }
    }

    #[test]
    fn slow_motion_is_bounded_and_counted() {
        let mut clock = StepClock::default();
        clock.advance(0, STEP);
        let mut simulated = 0.0;
        for n in 1..=20 {
            let due = clock.advance(ns(0.2 * f64::from(n)), STEP);
            assert_eq!(due.ends.len() as u32, MOST_STEPS);
            assert_eq!(due.ends.last(), Some(&1.0));
            simulated += STEP * due.ends.len() as f64;
        }
        // All time that was not simulated is counted in `slowed`.
        assert!((clock.slowed + simulated + clock.since - 4.0).abs() < 1e-9);
        // And nothing is made up for.
        assert_eq!(clock.advance(ns(4.0 + STEP), STEP).ends.len(), 1);
    }

    /// At a quarter of the speed, steps end where a display that is four times as slow has them.
    #[test]
    fn a_slower_clock_has_the_same_steps_later() {
        let mut clock = StepClock {
            rate: 0.25,
            ..StepClock::default()
        };
        clock.advance(0, STEP);
        let counts: Vec<_> = (1..=12)
            .map(|n| clock.advance(ns(STEP * f64::from(n)), STEP).ends.len())
            .collect();
        assert_eq!(counts, [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]);
        assert_eq!(clock.slowed, 0.0);
    }

    #[test]
    fn a_pause_is_not_simulated_and_a_long_frame_is_slow_motion() {
        let mut clock = StepClock::default();
        clock.advance(0, STEP);
        clock.pause();
        assert!(clock.advance(ns(3.0), STEP).ends.is_empty());
        assert_eq!(clock.advance(ns(3.0 + STEP), STEP).ends.len(), 1);
        // Nor is a clock that goes backwards, as a new runtime's may.
        assert!(clock.advance(ns(1.0), STEP).ends.is_empty());
        assert_eq!(clock.slowed, 0.0);
        // Two seconds for a frame: a machine that slow goes on none the less.
        let most = MOST_STEPS as usize;
        assert_eq!(clock.advance(ns(3.0), STEP).ends.len(), most);
        assert!((clock.slowed - (2.0 - most as f64 * STEP)).abs() < 1e-9);
    }
}
