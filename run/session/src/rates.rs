//! The display's rate: the first thing to give way where frames do not fit its period, and the last to come back.
//!
//! A picture that comes less often and in time is seen as calm; one that is missed is not. But a longer period may have more
//! steps of the simulation in it, so that a lower rate is no help where these are what takes long.

use crate::clock::MOST_STEPS;
use crate::governor::{FULL, ROOM};

/// Time for which a higher rate must have had room before it is gone to, s: at first, and at most.
const WAIT: [f64; 2] = [4.0, 64.0];
/// What a lower rate must at least be better by, as a share of the load: a change is seen.
const WORTH: f64 = 0.05;

/// What a frame's parts take, ms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taken {
    /// One step of the simulation.
    pub step: f64,
    /// The picture.
    pub picture: f64,
    /// How much time a step simulates.
    pub frame_time: f64,
}

/// Rates that can be asked for, and the one that was.
#[derive(Clone, Debug, Default)]
pub struct Rates {
    /// Hz, ascending, up to the one that the session began with.
    all: Vec<f64>,
    at: usize,
    /// Time for which the next higher one has had room, s.
    room: f64,
    wait: f64,
}

impl Rates {
    /// Of a display that has these (Hz), and `now` has that one.
    pub fn new(rates: &[f32], now: f64) -> Self {
        let mut all: Vec<f64> = rates.iter().map(|&rate| f64::from(rate)).collect();
        all.retain(|rate| rate.is_finite() && *rate > 0.0 && *rate < now + 0.5);
        all.sort_by(f64::total_cmp);
        Self {
            at: all.len().saturating_sub(1),
            all,
            room: 0.0,
            wait: WAIT[0],
        }
    }

    /// The rate that is asked for, Hz, if it is not the one that the session began with.
    pub fn lowered(&self) -> Option<f64> {
        (self.at + 1 < self.all.len()).then(|| self.all[self.at])
    }

    /// Frames do not fit: the highest rate below this one at which they would, or else the one that helps most. `None` where
    /// none helps.
    pub fn lower(&mut self, taken: &Taken) -> Option<f64> {
        let lower = self.all.get(..self.at)?;
        let load = |at: usize| taken.load(self.all[at]);
        let fits = (0..lower.len()).rev().find(|&at| load(at) <= FULL);
        let least = (0..lower.len()).min_by(|&a, &b| load(a).total_cmp(&load(b)));
        let to = fits.or(least)?;
        if load(to) > load(self.at) - WORTH {
            return None;
        }
        if self.room < 0.0 {
            // It has just been gone up to.
            self.wait = (2.0 * self.wait).min(WAIT[1]);
        }
        (self.at, self.room) = (to, 0.0);
        Some(self.all[to])
    }

    /// `seconds` have passed in which nothing else was given up: the next higher rate, if frames would have fitted for long
    /// enough.
    pub fn raise(&mut self, taken: &Taken, seconds: f64) -> Option<f64> {
        let to = self.at + 1;
        let rate = *self.all.get(to)?;
        if taken.load(rate) > ROOM {
            self.room = self.room.min(0.0);
            return None;
        }
        self.room += seconds;
        if self.room < self.wait {
            return None;
        }
        // Below 0 for as long as a fall back would be a mistake.
        (self.at, self.room) = (to, -self.wait);
        Some(rate)
    }
}

impl Taken {
    /// Share of a period at that rate (Hz).
    fn load(&self, rate: f64) -> f64 {
        let period = 1e3 / rate;
        let steps = (period / self.frame_time - 1e-6)
            .ceil()
            .clamp(1.0, MOST_STEPS.into());
        (steps * self.step + self.picture) / period
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RATES: [f32; 4] = [120.0, 72.0, 90.0, 80.0];

    fn taken(step: f64, picture: f64) -> Taken {
        Taken {
            step,
            picture,
            frame_time: 1000.0 / 90.0,
        }
    }

    #[test]
    fn the_highest_that_fits_is_taken() {
        // Periods of 8.33, 11.11, 12.5 and 13.89 ms, with 1, 1, 2 and 2 steps.
        for (of, wanted) in [
            (taken(1.0, 7.0), Some(90.0)),
            (taken(0.5, 9.2), Some(80.0)),
            (taken(0.5, 10.5), Some(72.0)),
            // None fits; 72 Hz has the least load.
            (taken(0.5, 14.0), Some(72.0)),
            // 2 × 6 ms of steps in 13.9 ms are no better than 6 in 8.3; 6 in 11.1 are.
            (taken(6.0, 1.5), Some(90.0)),
        ] {
            let mut rates = Rates::new(&RATES, 120.0);
            assert_eq!(rates.lower(&of), wanted, "{of:?}");
        }
        // From 90 Hz nothing is gained by two steps in a frame, nor without a choice.
        assert_eq!(Rates::new(&RATES, 90.0).lower(&taken(8.0, 2.0)), None);
        assert_eq!(Rates::new(&[], 90.0).lower(&taken(1.0, 20.0)), None);
        assert_eq!(Rates::new(&[90.0], 90.0).lower(&taken(1.0, 20.0)), None);
    }

    #[test]
    fn it_comes_back_where_there_is_room_and_seldom_where_there_is_none() {
        let mut rates = Rates::new(&RATES, 120.0);
        assert_eq!(rates.lowered(), None);
        let (heavy, light) = (taken(0.5, 9.2), taken(0.5, 4.0));
        assert_eq!(rates.lower(&heavy), Some(80.0));
        assert_eq!(rates.lowered(), Some(80.0));
        let seconds_to_rise = |rates: &mut Rates| {
            let mut seconds = 0.0;
            loop {
                seconds += 0.5;
                if let Some(rate) = rates.raise(&light, 0.5) {
                    return (rate, seconds);
                }
                assert!(seconds < 300.0);
            }
        };
        assert_eq!(seconds_to_rise(&mut rates), (90.0, 4.0));
        // Too soon: the next try waits twice as long.
        assert_eq!(rates.lower(&heavy), Some(80.0));
        assert_eq!(seconds_to_rise(&mut rates), (90.0, 8.0));
        // Where it does not fit, it never comes back.
        assert!((0..1000).all(|_| rates.raise(&taken(0.5, 6.0), 0.5).is_none()));
    }
}
