//! A stream that enters a liquid takes air with it, whose bubbles ring.

use std::f64::consts::PI;

use crate::bubble::{Bubble, damping, loudness};
use crate::event::Pour;
use crate::random::Random;
use crate::voice::Voice;

const GRAVITY: f64 = 9.806_65;

/// Air over liquid, Q_a/Q = 0.04·Fr^0.28·(L/d)^0.4 with Fr = v²/gd (Biń 1993, Chem. Eng. Sci. 48(21), 3585).
const ENTRAINED: f64 = 0.04;
const BY_FROUDE: f64 = 0.28;
const BY_LENGTH: f64 = 0.4;

/// A limit above every measured jet.
const MOST_AIR: f64 = 2.0;

/// Speeds between which a stream begins to take air with it, m/s: smooth jets do from some 1 m/s on, a stream
/// poured by hand is disturbed and was assumed to from less.
const ONSET: [f64; 2] = [0.3, 1.0];

/// Bubbles' radii, metres: their number falls as r^-3/2 below Hinze's scale and as r^-10/3 above (Deane and Stokes 2002,
/// Nature 418, 839). Smaller ones than the least ring above 13 kHz.
const HINZE: f64 = 1e-3;
const SMALLEST: f64 = 0.25e-3;
const LARGEST: f64 = 5e-3;

/// Most bubbles a second, 1/s: more would be noise.
const MOST_BUBBLES: f64 = 3000.0;

/// Softest bubble over the loudest of its size: how a bubble is torn off varies (van den Doel 2005 also draws it).
const SOFTEST: f64 = 0.2;

/// Calls `each` for random events at `rate` (1/s) in the next `seconds`, with the time of each. Waits have no memory, so that each stretch
/// of time begins anew.
pub(crate) fn arrivals(
    seconds: f64,
    rate: f64,
    random: &mut Random,
    mut each: impl FnMut(f64, &mut Random),
) {
    let rate = rate.clamp(0.0, MOST_BUBBLES);
    if rate <= 0.0 {
        return;
    }
    let mut passed = random.wait() / rate;
    while passed < seconds {
        each(passed, random);
        passed += random.wait() / rate;
    }
}

/// The air that a stream takes with it.
#[derive(Clone, Copy, Debug)]
struct Air {
    /// Diameter of the stream at the surface, metres.
    diameter: f64,
    /// Bubbles, 1/s.
    rate: f64,
}

impl Air {
    fn of(pour: &Pour) -> Self {
        let flow = f64::from(pour.flow).clamp(0.0, 1e-2);
        let speed = f64::from(pour.speed).clamp(0.0, 10.0);
        if flow < 1e-9 || speed <= ONSET[0] {
            let (diameter, rate) = (1e-3, 0.0);
            return Self { diameter, rate };
        }
        let diameter = (4.0 * flow / (PI * speed)).sqrt();
        let air = flow * entrained(speed, diameter);
        let rate = air / mean_volume(diameter);
        Self { diameter, rate }
    }
}

/// Air over liquid of a stream of this speed (m/s) and diameter (m) at the surface. Its length is the height from which
/// it has its speed.
fn entrained(speed: f64, diameter: f64) -> f64 {
    let froude = speed * speed / (GRAVITY * diameter);
    let length = 0.5 * froude;
    let t = ((speed - ONSET[0]) / (ONSET[1] - ONSET[0])).clamp(0.0, 1.0);
    let all = ENTRAINED * libm::pow(froude, BY_FROUDE) * libm::pow(length, BY_LENGTH);
    (t * t * (3.0 - 2.0 * t) * all).min(MOST_AIR)
}

/// Largest bubble of a stream, metres: no wider than the stream.
fn largest(diameter: f64) -> f64 {
    (0.5 * diameter).clamp(1.01 * HINZE, LARGEST)
}

/// How many bubbles are below Hinze's scale and above, and their volumes over 4π/3, in Hinze's units.
fn shares(diameter: f64) -> ([f64; 2], [f64; 2]) {
    let (low, high) = (SMALLEST / HINZE, largest(diameter) / HINZE);
    let count = [
        2.0 * (1.0 / low.sqrt() - 1.0),
        (1.0 - libm::pow(high, -7.0 / 3.0)) * 3.0 / 7.0,
    ];
    let volume = [
        (1.0 - libm::pow(low, 2.5)) / 2.5,
        1.5 * (libm::pow(high, 2.0 / 3.0) - 1.0),
    ];
    (count, volume)
}

/// Mean volume of a bubble, m³.
fn mean_volume(diameter: f64) -> f64 {
    let (count, volume) = shares(diameter);
    4.0 / 3.0 * PI * HINZE * HINZE * HINZE * (volume[0] + volume[1]) / (count[0] + count[1])
}

/// Radius of a bubble (m) for a number in [0, 1): the distribution's inverse.
fn radius(diameter: f64, number: f64) -> f64 {
    let (count, _) = shares(diameter);
    let at = number * (count[0] + count[1]);
    let size = match at < count[0] {
        true => {
            let root = 1.0 / (SMALLEST / HINZE).sqrt() - 0.5 * at;
            1.0 / (root * root)
        }
        false => libm::pow(1.0 - (at - count[0]) * 7.0 / 3.0, -3.0 / 7.0),
    };
    size * HINZE
}

/// The bubbles of a stream in the next `seconds`.
pub(crate) fn pour(pour: &Pour, seconds: f64, random: &mut Random, mut add: impl FnMut(Voice)) {
    let air = Air::of(pour);
    arrivals(seconds, air.rate, random, |at, random| {
        let bubble = Bubble {
            radius: radius(air.diameter, random.number()) as f32,
            // Bubbles go down by some diameters of the stream; the first of these sounds.
            depth: (5.0 * air.diameter * random.number()) as f32,
            density: pour.density,
        };
        let strength = random.between(SOFTEST, 1.0);
        add(Voice::after(at, bubble.ring(strength)));
    });
}

/// Root mean square pressure of a stream at 1 m, in full scale: a ring of amplitude a has the energy a²/4d.
pub(crate) fn level(pour: &Pour) -> f64 {
    let air = Air::of(pour);
    ringing(air.rate, HINZE)
}

/// Root mean square of `rate` rings a second of bubbles of `radius` metres.
pub(crate) fn ringing(rate: f64, radius: f64) -> f64 {
    loudness(radius) * (rate.clamp(0.0, MOST_BUBBLES) / (4.0 * damping(radius))).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 10 mL/s at 1.5 m/s, by hand: d = 2.913 mm, Fr = 78.76, L/d = 39.38; 0.04·3.396·4.347 = 0.5905.
    #[test]
    fn air_is_the_reviews() {
        let pour = Pour {
            flow: 1e-5,
            speed: 1.5,
            density: 998.0,
            lasts: 1.0,
        };
        let air = Air::of(&pour);
        assert!((air.diameter - 2.913e-3).abs() < 1e-6, "{air:?}");
        let share = entrained(1.5, air.diameter);
        assert!((share - 0.5905).abs() < 0.002, "{share}");
        let slow = Pour { speed: 0.2, ..pour };
        assert_eq!(Air::of(&slow).rate, 0.0);
    }

    /// The air in bubbles is the air that is taken in; eight in ten are below Hinze's scale.
    #[test]
    fn bubbles_carry_the_air() {
        let mut random = Random::new(1, 2);
        let diameter = 20e-3;
        let radii: Vec<f64> = (0..2_000_000)
            .map(|_| radius(diameter, random.number()))
            .collect();
        let mean = radii
            .iter()
            .map(|r| 4.0 / 3.0 * PI * r.powi(3))
            .sum::<f64>()
            / radii.len() as f64;
        // The deviation of one is 4.7 times the mean: 0.33 % of it for so many.
        assert!((mean / mean_volume(diameter) - 1.0).abs() < 0.01, "{mean}");
        assert!(radii.iter().all(|r| (SMALLEST..=LARGEST).contains(r)));
        // ∫r^-3/2 from 0.25 to 1 is 2, ∫r^-10/3 from 1 to 5 is 0.4186.
        let below = radii.iter().filter(|r| **r < HINZE).count() as f64 / radii.len() as f64;
        assert!((below - 2.0 / 2.4186).abs() < 0.002, "{below}");
    }

    #[test]
    fn arrivals_have_their_rate() {
        let mut random = Random::new(3, 0);
        let mut count = 0;
        for _ in 0..10_000 {
            arrivals(1e-3, 700.0, &mut random, |at, _| {
                assert!((0.0..1e-3).contains(&at));
                count += 1;
            });
        }
        // Deviation of a count of 7,000 is 84.
        assert!((6_700..7_300).contains(&count), "{count}");
    }
}
