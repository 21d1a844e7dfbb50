//! The display's clock, told by the samples that were played.

/// Farther ahead than this, seconds, an event is not kept waiting: frames come closer together than that.
const AHEAD: f64 = 0.02;

/// When an event of the display's clock sounds.
///
/// Frames come unevenly. What is late moves the clock, so that what follows keeps its distance; the clocks drift apart
/// by some millionths, so that in the end something is too early, and moves it back.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Clock {
    ahead: Option<f64>,
}

impl Clock {
    /// Time by samples (s) of what the display has at `time` (s), at `now` by samples.
    pub(super) fn sounds_at(&mut self, time: f64, now: f64) -> f64 {
        let fits = |ahead: &f64| (now..=now + AHEAD).contains(&(time + ahead));
        let ahead = self.ahead.filter(fits).unwrap_or(now - time);
        if ahead.is_finite() {
            self.ahead = Some(ahead);
        }
        (time + ahead).max(now)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Frames of 90 Hz that come up to 8 ms late: once the latest has come, all keep their distance.
    #[test]
    fn distances_are_kept_and_none_is_late() {
        let mut clock = Clock::default();
        let mut last = 0.0;
        for frame in 0..1000u32 {
            let time = f64::from(frame) / 90.0;
            let now = time + 5.0 + f64::from(frame * 37 % 9) * 1e-3;
            let at = clock.sounds_at(time, now);
            assert!(at >= now && at - now < 0.02);
            if frame > 10 {
                assert!((at - last - 1.0 / 90.0).abs() < 1e-9, "{frame}");
            }
            last = at;
        }
    }

    #[test]
    fn a_clock_that_leaps_is_followed() {
        let mut clock = Clock::default();
        assert_eq!(clock.sounds_at(100.0, 1.0), 1.0);
        assert_eq!(clock.sounds_at(0.0, 2.0), 2.0);
        assert_eq!(clock.sounds_at(500.0, 3.0), 3.0);
        assert_eq!(clock.sounds_at(f64::MAX, 3.0), 3.0);
    }
}
