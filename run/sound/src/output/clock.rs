//! The display's clock, measured by the samples that were played.

/// Largest lead of an event over the samples, seconds: frames come closer together than that.
const AHEAD: f64 = 0.02;

/// Assigns times of sounding to events of the display's clock.
///
/// Frames come unevenly. A late frame moves the clock, so that later ones keep their distance; the clocks drift apart by some millionths,
/// so that in the end a frame is too early, and moves it back.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Clock {
    ahead: Option<f64>,
}

impl Clock {
    /// Time by samples (s) of the display's `time` (s), at `now` by samples.
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
