//! The ring of a bubble.

use std::f64::consts::PI;

use crate::voice::Ring;

/// Pressure of the air, Pa.
pub(crate) const AIR: f64 = 101_325.0;

/// Ratio of the air's heat capacities.
const GAMMA: f64 = 1.4;

/// Surface tension of water at 20 °C, N/m (IAPWS R1-76, 2014). Acid's is 25 % less at most: a change of 0.01 % in 1 mm.
const TENSION: f64 = 0.072_75;

/// Gravity, m/s².
const GRAVITY: f64 = 9.806_65;

/// Part of the damping that is by radiation and heat: per second, over 1/r (van den Doel 2005).
const DAMPING: f64 = 0.13;
/// The other part, over r^-3/2.
const DAMPING_SMALL: f64 = 0.0072;

/// By how much a bubble's frequency rises in one time of its damping (van den Doel 2005, ξ).
const RISE: f64 = 0.1;

/// Depth in radii from which the surface no longer raises the pitch: there Strasberg's √(1 − R/2h) (1953) is 0.95.
const DEEP: f64 = 5.0;

/// Pressure at 1 m of a bubble of 1 mm, in full scale: chosen.
const LOUDNESS: f64 = 0.02;

/// Range to which radii are clamped, metres: a bubble of 0.17 mm rings at 20 kHz, one of 30 mm at 110 Hz.
pub(crate) const RADII: [f64; 2] = [0.17e-3, 30e-3];

/// Range to which densities are clamped, kg/m³.
const DENSITIES: [f64; 2] = [500.0, 3000.0];

/// One bubble of gas in a liquid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bubble {
    /// Radius, metres.
    pub radius: f32,
    /// Depth of its middle below the surface, metres.
    pub depth: f32,
    /// Density of the liquid, kg/m³.
    pub density: f32,
}

impl Bubble {
    fn size(&self) -> f64 {
        f64::from(self.radius).clamp(RADII[0], RADII[1])
    }

    /// Its frequency (Hz): Minnaert 1933, f = √(3γp/ρ)/2πR, with the liquid's weight and, as in Leighton 1994,
    /// surface tension: 3γp becomes 3γ(p + 2σ/R) − 2σ/R.
    pub fn frequency(&self) -> f64 {
        let (radius, density) = (self.size(), f64::from(self.density));
        let density = density.clamp(DENSITIES[0], DENSITIES[1]);
        let depth = f64::from(self.depth).clamp(0.0, 10.0);
        let skin = 2.0 * TENSION / radius;
        let stiffness = 3.0 * GAMMA * (AIR + density * GRAVITY * depth + skin) - skin;
        (stiffness / density).sqrt() / (2.0 * PI * radius)
    }

    /// Damping of its ring, 1/s.
    pub fn damping(&self) -> f64 {
        damping(self.size())
    }

    /// Its ring, times `strength`.
    pub(crate) fn ring(&self, strength: f64) -> Ring {
        let rise = match f64::from(self.depth) < DEEP * self.size() {
            true => RISE,
            false => 0.0,
        };
        let (frequency, damping) = (self.frequency(), self.damping());
        Ring::rising(strength * loudness(self.size()), frequency, damping, rise)
    }
}

/// Damping of a bubble of this radius (m), 1/s.
pub(crate) fn damping(radius: f64) -> f64 {
    DAMPING / radius + DAMPING_SMALL / (radius * radius.sqrt())
}

/// Pressure at 1 m of a bubble of this radius (m): as r^3/2 (van den Doel 2005).
pub(crate) fn loudness(radius: f64) -> f64 {
    let size = radius / 1e-3;
    LOUDNESS * size * size.sqrt()
}
