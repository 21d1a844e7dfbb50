//! Sums over liquid that arrives in portions: volume, acid, position, temperature, first and last arrival.

use glam::DVec3;

use super::Bench;
use crate::event::{Cause, Event, Incident, What};

/// Sums over liquid that arrives in portions. Its means are weighted by volume.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Amount {
    pub begun: f64,
    pub last: f64,
    /// Volume at real size, m³.
    pub volume: f64,
    acid: f64,
    place: DVec3,
    warmth: f64,
    /// Volume of the portions whose temperature is known, at real size, m³.
    warm: f64,
}

/// A portion of liquid, as one observation has it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Bit {
    /// Volume at real size, m³.
    pub volume: f64,
    pub acid: f64,
    /// Mean position in the world, m of the scene.
    pub place: DVec3,
    /// Mean temperature, °C.
    pub temperature: Option<f64>,
}

impl Amount {
    /// Empty sums that begin at time `t`, s.
    pub fn at(t: f64) -> Self {
        Self {
            begun: t,
            last: t,
            ..Self::default()
        }
    }

    pub fn add(&mut self, t: f64, bit: &Bit) {
        self.last = t;
        self.volume += bit.volume;
        self.acid += bit.volume * bit.acid;
        self.place += bit.volume * bit.place;
        if let Some(temperature) = bit.temperature {
            self.warm += bit.volume;
            self.warmth += bit.volume * temperature;
        }
    }

    pub fn acid(&self) -> f64 {
        self.acid / self.volume.max(f64::MIN_POSITIVE)
    }

    pub fn place(&self) -> DVec3 {
        self.place / self.volume.max(f64::MIN_POSITIVE)
    }

    pub fn temperature(&self) -> Option<f64> {
        (self.warm > 0.0).then(|| self.warmth / self.warm)
    }

    /// The incident of this liquid, with its times and its mean place.
    pub fn incident(&self, bench: &Bench, what: What, cause: Cause) -> Event {
        Event::Incident(Incident {
            t_s: self.begun,
            until_s: self.last,
            what,
            cause,
            place_m: bench.place(self.place()),
        })
    }

    /// Whether nothing has been added in the `pause` seconds before `now`.
    pub fn is_over(&self, now: f64, pause: f64) -> bool {
        now - self.last > pause
    }
}
