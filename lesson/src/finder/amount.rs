//! Liquid that comes bit by bit: how much in all, of what, where, and from when to when.

use glam::DVec3;

/// See the module. Means are by volume.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Amount {
    pub begun: f64,
    pub last: f64,
    /// Real m³.
    pub volume: f64,
    acid: f64,
    place: DVec3,
    warmth: f64,
    /// Of what the temperature is known, real m³.
    warm: f64,
}

/// A bit of it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Bit {
    /// Real m³.
    pub volume: f64,
    pub acid: f64,
    /// In the world, m of the scene.
    pub place: DVec3,
    /// °C.
    pub temperature: Option<f64>,
}

impl Amount {
    /// None yet, at `t`.
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

    /// Whether a while has passed at `now` without more of it.
    pub fn is_over(&self, now: f64, pause: f64) -> bool {
        now - self.last > pause
    }
}
