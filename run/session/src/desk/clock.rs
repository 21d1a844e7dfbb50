//! The desk's frames in real time, at a display's rate.

use std::time::{Duration, Instant};

/// Lowest and highest rate of a display that is believed, Hz.
const RATES: [f64; 2] = [20.0, 1000.0];
/// The rate of a display that reports none, Hz: that of most.
const USUAL: f64 = 60.0;
/// Highest rate of frames, Hz: a scene has 90 steps a second, and a frame without a step shows nothing that was not there before.
const MOST: f64 = 90.0;

/// The rate of frames at a display of `reported` mHz, Hz: its own, or a whole part of it.
pub fn rate(reported: Option<u32>) -> f64 {
    let told = reported.map(|reported| 1e-3 * f64::from(reported));
    let of_display = told.filter(|rate| (RATES[0]..RATES[1]).contains(rate));
    let rate = of_display.unwrap_or(USUAL);
    // A display that reports 90.1 Hz means 90.
    rate / (rate / (MOST + 1.0)).ceil()
}

/// Paces frames. One that takes longer than a period ends with the next period.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    rate: f64,
    started: Option<Instant>,
    /// Number of the period in which the last frame is shown.
    period: u64,
}

impl Clock {
    /// Frames at that rate, Hz.
    pub fn new(rate: f64) -> Self {
        Self {
            rate,
            started: None,
            period: 0,
        }
    }

    /// Length of a period, ns.
    pub fn period_ns(&self) -> i64 {
        (1e9 / self.rate).round() as i64
    }

    /// Waits until the next frame is to begin: its display time since the first one's, ns, and the time since the last one, s.
    pub fn wait(&mut self) -> (i64, f32) {
        let start = *self.started.get_or_insert_with(Instant::now);
        let due = self.due(start.elapsed().as_secs_f64());
        let begin = start + Duration::from_secs_f64((self.period - 1) as f64 / self.rate);
        std::thread::sleep(begin.saturating_duration_since(Instant::now()));
        due
    }

    /// The next frame at `now` seconds after the start: in the period that this is in, and in none twice.
    fn due(&mut self, now: f64) -> (i64, f32) {
        let before = self.period;
        self.period = (before + 1).max((now * self.rate).floor() as u64 + 1);
        let passed = (self.period - before) as f64 / self.rate;
        let time = 1e9 * (self.period - 1) as f64 / self.rate;
        (time.round() as i64, passed as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_display_has_its_own_rate_or_a_part_of_it() {
        for (reported, expected) in [
            (None, 60.0),
            (Some(0), 60.0),
            (Some(59_940), 59.94),
            (Some(90_100), 90.1),
            (Some(144_000), 72.0),
            (Some(240_000), 80.0),
        ] {
            assert!((rate(reported) - expected).abs() < 1e-9, "{reported:?}");
        }
    }

    /// Frames are a period apart; one that takes two and a half is followed by the period after them.
    #[test]
    fn a_slow_frame_misses_periods() {
        let mut clock = Clock::new(50.0);
        let times = [0.0, 0.001, 0.0401, 0.09, 0.0901].map(|now| clock.due(now));
        let periods = times.map(|(time, _)| time / 20_000_000);
        assert_eq!(periods, [0, 1, 2, 4, 5]);
        let passed = times.map(|(_, passed)| (1000.0 * passed).round());
        assert_eq!(passed, [20.0, 20.0, 20.0, 40.0, 20.0]);
        assert_eq!(clock.period_ns(), 20_000_000);
    }
}
