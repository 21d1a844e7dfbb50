//! Boiling: bubbles leave the wall, collapse in colder liquid, or burst at the surface.

use crate::bubble::{AIR, Bubble, RADII, loudness};
use crate::event::Bubbles;
use crate::pour::{arrivals, ringing};
use crate::random::Random;
use crate::voice::{Hiss, Voice};

/// Latent heat of water over the gas constant, K, and its boiling point, K: Clausius and Clapeyron's slope.
const LATENT: f64 = 40_660.0 / 8.314;
const BOILING: f64 = 373.15;

/// Rayleigh's time of collapse, over R·√(ρ/Δp) (Phil. Mag. 34, 1917).
const COLLAPSE: f64 = 0.915;

/// Radius of the rest of a collapsed bubble, which rings, over the bubble's radius: least and greatest. The colder the liquid, the smaller
/// the rest. Assumed.
const LEFT: [f64; 2] = [0.25, 0.8];

/// Amplitudes over those of a bubble of that size torn off in a pour, chosen: a bubble that leaves the wall swells
/// slowly, one that bursts opens upwards. A collapse sets all of Δp's work free.
const DEPARTS: f64 = 0.08;
const BURSTS: f64 = 0.18;
const COLLAPSES: f64 = 0.7;
/// The film's spray at a burst, and the collapse's own blow.
const SPRAY: f64 = 0.08;
const BLOW: f64 = 0.9;

/// Spread of ln R.
const SPREAD: f64 = 0.3;

/// Vapour pressure deficit against the air's pressure in a liquid this far below its boiling point (K), over the air's pressure.
fn lack(subcooling: f64) -> f64 {
    let cold = BOILING - subcooling.clamp(0.0, 90.0);
    1.0 - libm::exp(-LATENT * (1.0 / cold - 1.0 / BOILING))
}

fn one(all: &Bubbles, random: &mut Random) -> Bubble {
    let size = f64::from(all.radius) * libm::exp(SPREAD * random.normal());
    Bubble {
        radius: size as f32,
        depth: all.depth.max(0.0),
        density: all.density,
    }
}

/// Adds the voices of the next `seconds`.
pub(crate) fn boil(all: &Bubbles, seconds: f64, random: &mut Random, mut add: impl FnMut(Voice)) {
    let [departures, collapses, bursts] =
        [all.departures, all.collapses, all.bursts].map(f64::from);
    arrivals(seconds, departures, random, |at, random| {
        add(Voice::after(at, one(all, random).ring(DEPARTS)));
    });
    arrivals(seconds, collapses, random, |at, random| {
        let (blow, (rest, strength)) = collapse(all, random);
        add(Voice::after(at, blow));
        add(Voice::after(at, rest.ring(strength)));
    });
    arrivals(seconds, bursts, random, |at, random| {
        let bubble = one(all, random);
        let bubble = Bubble {
            depth: 0.0,
            ..bubble
        };
        let size = f64::from(bubble.radius).clamp(RADII[0], RADII[1]);
        let seed = Random::new(random.bits(), 0);
        let spray = Hiss::new(SPRAY * loudness(size), [3500.0, 2.0], [5e-4, 6e-3], seed);
        add(Voice::after(at, bubble.ring(BURSTS)));
        add(Voice::after(at, spray));
    });
}

/// The blow of a collapse, and the bubble that is left with the strength of its ring. Amplitudes go as √(R³Δp), the root of the work that
/// is done.
fn collapse(all: &Bubbles, random: &mut Random) -> (Hiss, (Bubble, f64)) {
    let bubble = one(all, random);
    let lack = lack(f64::from(all.subcooling)).max(1e-3);
    let radius = f64::from(bubble.radius).clamp(RADII[0], RADII[1]);
    let density = f64::from(all.density).clamp(500.0, 3000.0);
    let time = COLLAPSE * radius * (density / (lack * AIR)).sqrt();
    let amplitude = loudness(radius) * lack.sqrt();
    let seed = Random::new(random.bits(), 0);
    let blow = Hiss::new(
        BLOW * amplitude,
        [1.0 / time, 3.0],
        [0.25 * time, time],
        seed,
    );
    let left = (LEFT[1] - (LEFT[1] - LEFT[0]) * lack) * random.between(0.8, 1.2);
    let rest = Bubble {
        radius: (left * radius) as f32,
        ..bubble
    };
    let strength = COLLAPSES * amplitude / loudness(left * radius);
    (blow, (rest, strength))
}

/// Root mean square pressure at 1 m, in full scale.
pub(crate) fn level(all: &Bubbles) -> f64 {
    let radius = f64::from(all.radius).clamp(RADII[0], RADII[1]);
    let [departures, collapses, bursts] =
        [all.departures, all.collapses, all.bursts].map(|rate| ringing(f64::from(rate), radius));
    let collapses = COLLAPSES * lack(f64::from(all.subcooling)).sqrt() * collapses;
    let (departures, bursts) = (DEPARTS * departures, BURSTS * bursts);
    (departures * departures + collapses * collapses + bursts * bursts).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steam tables: 47.41 kPa at 80 °C, 70.18 at 90 °C, 101.42 at 100 °C. The straight law is off by 2 %.
    #[test]
    fn lack_is_the_steam_tables() {
        for (subcooling, pressure) in [(0.0, 101.42), (10.0, 70.18), (20.0, 47.41)] {
            let found = 101.42 * (1.0 - lack(subcooling));
            assert!(
                (found / pressure - 1.0).abs() < 0.02,
                "{subcooling}: {found}"
            );
        }
    }
}
