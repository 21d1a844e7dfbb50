//! Simulated time: how far a run goes, and how far it is.

use vitriol_lesson::whole_nanoseconds;

/// How far a run goes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// Frame time Δt_f, s.
    pub frame_time: f64,
    /// Number of steps.
    pub steps: u64,
    /// What was asked for, s; the steps end at it or after.
    asked: f64,
}

impl Span {
    /// As many whole steps as cover `seconds`.
    pub fn covering(seconds: f64, frame_time: f64) -> Self {
        // A millionth of a step is rounding, and no reason for one more.
        let steps = (seconds / frame_time - 1e-6).ceil().max(1.0);
        Self {
            frame_time,
            steps: steps as u64,
            asked: seconds,
        }
    }

    /// Simulated time in whole nanoseconds, s.
    pub fn seconds(self) -> f64 {
        whole_nanoseconds(self.steps as f64 * self.frame_time)
    }

    /// Whether the time is up.
    pub fn is_over(self, time: &SimulatedTime) -> bool {
        time.steps() > 0 && time.exact() >= self.asked - 1e-6 * self.frame_time
    }
}

/// Simulated time, step by step: a whole number of steps after the last
/// change of their length, so that it is the same however often it is asked for.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SimulatedTime {
    base: f64,
    since: u64,
    frame_time: f64,
    steps: u64,
}

impl SimulatedTime {
    /// Steps so far.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Time at their end in whole nanoseconds, s: what is written of a run.
    pub fn seconds(&self) -> f64 {
        whole_nanoseconds(self.exact())
    }

    /// Time at their end, s. Not rounded, so that what rounding leaves out does not add up where steps change their length.
    fn exact(&self) -> f64 {
        self.base + self.since as f64 * self.frame_time
    }

    /// A step of `frame_time` (s) more.
    pub fn advance(&mut self, frame_time: f64) {
        if frame_time != self.frame_time {
            self.base = self.exact();
            (self.since, self.frame_time) = (0, frame_time);
        }
        self.since += 1;
        self.steps += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_span_has_whole_steps() {
        let steps = |seconds, frame_time| Span::covering(seconds, frame_time).steps;
        assert_eq!(steps(8.0, 1.0 / 90.0), 720);
        assert_eq!(steps(8.001, 1.0 / 90.0), 721);
        assert_eq!(steps(1e-9, 1.0 / 90.0), 1);
    }

    #[test]
    fn time_is_whole_steps_of_each_length() {
        let mut time = SimulatedTime::default();
        for _ in 0..900 {
            time.advance(1.0 / 90.0);
        }
        assert_eq!(time.seconds(), 10.0);
        for _ in 0..60 {
            time.advance(1.0 / 60.0);
        }
        assert_eq!(time.seconds(), 11.0);
        assert_eq!(time.steps(), 960);
    }

    /// The built-in scenes' step has fifteen decimals. Times are what a clock of 90 Hz shows.
    #[test]
    fn times_are_whole_nanoseconds() {
        let frame_time = 0.011111111111111;
        let mut time = SimulatedTime::default();
        for _ in 0..108 {
            time.advance(frame_time);
        }
        assert_eq!(time.seconds().to_string(), "1.2");
        assert_eq!(Span::covering(9.6, frame_time).seconds(), 9.6);
    }

    /// Were each of them rounded, 90 steps of 1/90 s and as many of 1/60 s would be 20 ns too long.
    #[test]
    fn rounding_does_not_add_up() {
        let mut time = SimulatedTime::default();
        for step in 0..180 {
            time.advance([1.0 / 90.0, 1.0 / 60.0][step % 2]);
        }
        assert_eq!(time.seconds(), 2.5);
    }
}
