//! Frames in real time where no headset paces them: those of a window and of a stand-in.

use std::time::{Duration, Instant};

/// Paces frames. One that takes longer than a period ends with the next period.
#[derive(Clone, Copy, Debug)]
pub struct FrameClock {
    /// Frames a second.
    rate_hz: f64,
    started: Option<Instant>,
    /// From the first frame to the first one of this rate, s.
    since: f64,
    /// Number of the period of this rate in which the last frame is shown; 0 before the first one.
    period: u64,
}

impl FrameClock {
    /// So many frames a second.
    pub fn new(rate_hz: f64) -> Self {
        Self {
            rate_hz,
            started: None,
            since: 0.0,
            period: 0,
        }
    }

    /// So many frames a second from the last frame on.
    pub fn change(&mut self, rate_hz: f64) {
        self.since = self.time();
        self.period = self.period.min(1);
        self.rate_hz = rate_hz;
    }

    /// Length of a period, s.
    pub fn seconds(&self) -> f64 {
        self.rate_hz.recip()
    }

    /// Length of a period, ns.
    pub fn period_ns(&self) -> i64 {
        (1e9 * self.seconds()).round() as i64
    }

    /// From the first frame to the last one, s.
    pub fn time(&self) -> f64 {
        self.since + self.period.saturating_sub(1) as f64 * self.seconds()
    }

    /// When the last frame began, by [`FrameClock::wait`]; `None` before the first one.
    pub fn began(&self) -> Option<Instant> {
        Some(self.started? + Duration::from_secs_f64(self.time()))
    }

    /// Waits until the next frame is to begin; the time since the last one, s.
    pub fn wait(&mut self) -> f64 {
        let start = *self.started.get_or_insert_with(Instant::now);
        let passed = self.go_on(start.elapsed().as_secs_f64());
        let begin = start + Duration::from_secs_f64(self.time());
        std::thread::sleep(begin.saturating_duration_since(Instant::now()));
        passed
    }

    /// Goes on by a period, however long the last frame took.
    pub fn step(&mut self) {
        self.period += 1;
    }

    /// The next frame at `now` seconds after the start: in the period that this is in, and in none twice. The time since the last one, s.
    fn go_on(&mut self, now: f64) -> f64 {
        let before = self.period;
        let period = ((now - self.since) / self.seconds()).floor() as u64 + 1;
        self.period = (before + 1).max(period);
        (self.period - before) as f64 * self.seconds()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Frames are a period apart; one that takes two and a half is followed by the period after them.
    #[test]
    fn a_slow_frame_misses_periods() {
        let mut clock = FrameClock::new(50.0);
        let nearly = |a: f64, b: f64| (a - b).abs() < 1e-9;
        for (now, time, passed) in [
            (0.0, 0.0, 0.02),
            (0.001, 0.02, 0.02),
            (0.0401, 0.04, 0.02),
            (0.09, 0.08, 0.04),
            (0.0901, 0.1, 0.02),
        ] {
            assert!(nearly(clock.go_on(now), passed), "{now}");
            assert!(nearly(clock.time(), time), "{now}: {}", clock.time());
        }
        assert_eq!(clock.period_ns(), 20_000_000);
        clock.step();
        assert!(nearly(clock.time(), 0.12), "{}", clock.time());
    }

    /// No time is left out and none is counted twice where the rate changes.
    #[test]
    fn another_rate_begins_at_the_last_frame() {
        let mut clock = FrameClock::new(50.0);
        let nearly = |a: f64, b: f64| (a - b).abs() < 1e-9;
        // Before the first frame too.
        clock.change(25.0);
        for (rate, now, time, passed) in [
            (50.0, 0.0, 0.0, 0.02),
            (50.0, 0.001, 0.02, 0.02),
            (25.0, 0.021, 0.06, 0.04),
            // It took two periods.
            (25.0, 0.15, 0.14, 0.08),
            (50.0, 0.141, 0.16, 0.02),
        ] {
            clock.change(rate);
            assert!(nearly(clock.go_on(now), passed), "{now}");
            assert!(nearly(clock.time(), time), "{now}: {}", clock.time());
        }
    }

    /// It waits at least until the frame begins; how much longer is the system's matter.
    #[test]
    fn a_frame_begins_at_its_time() {
        let mut clock = FrameClock::new(200.0);
        assert!(clock.began().is_none());
        for _ in 0..3 {
            clock.wait();
            assert!(clock.began().is_some_and(|begin| begin <= Instant::now()));
        }
    }
}
