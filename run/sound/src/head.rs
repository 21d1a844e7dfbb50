//! The effect of a head on a sound on its way to each ear: Brown and Duda's structural model (IEEE Trans. Speech Audio Process. 6(5),
//! 1998), without shoulders and outer ears.
//!
//! Ahead and behind sound alike, as do above and below: a listener who turns the head can tell them apart.

use std::f64::consts::FRAC_PI_2;

use crate::RATE;

/// Samples that are rendered at once.
pub(crate) const BLOCK: usize = 64;

/// Radius of the head, metres (Brown and Duda 1998).
const RADIUS: f64 = 0.0875;

/// Speed of sound at 20 °C, m/s.
const SOUND: f64 = 343.2;

/// The shadow's least gain of high pitches (Brown and Duda 1998, α_min), and the angle of its deepest place, radians.
const SHADOW: f64 = 0.1;
const DEEPEST: f64 = 150.0 * std::f64::consts::PI / 180.0;

/// β = 2c/a, 1/s.
const CORNER: f64 = 2.0 * SOUND / RADIUS;

/// Part of the way to where the source is that a block goes: 1 − e^(−64 samples/20 ms).
const FOLLOW: f32 = 0.064_5;

/// Longest delay is 31.5 samples, and the interpolation takes two on each side.
const LINE: usize = 128;
const LEAD: f64 = 2.0;

/// The delay (samples, from when the sound would reach the nearest point of the head) and the gain α of high pitches, at
/// the ear whose axis has this cosine with the source.
///
/// Delay: Woodworth's (as Brown and Duda 1998 have it): (a/c)(1 − cos θ), in the shadow (a/c)(1 + θ − π/2).
/// Gain: α = (1 + α_min/2) + (1 − α_min/2) cos(180°·θ/150°).
pub(crate) fn at_ear(along: f32) -> (f32, f32) {
    let cosine = f64::from(along.clamp(-1.0, 1.0));
    let angle = libm::acos(cosine);
    let path = match angle < FRAC_PI_2 {
        true => 1.0 - cosine,
        false => 1.0 + angle - FRAC_PI_2,
    };
    let delay = path * RADIUS / SOUND * f64::from(RATE);
    let bend = libm::cos(angle / DEEPEST * std::f64::consts::PI);
    let gain = (1.0 + 0.5 * SHADOW) + (1.0 - 0.5 * SHADOW) * bend;
    (delay as f32, gain as f32)
}

/// One source's way to both ears.
#[derive(Debug)]
pub(crate) struct Head {
    line: [f32; LINE],
    at: usize,
    ears: [Side; 2],
    /// Cosine of the source with the right ear's axis, and gain by distance, at the end of the last block.
    along: f32,
    gain: f32,
}

#[derive(Debug)]
struct Side {
    delay: f32,
    high: f32,
    before: f32,
    state: f32,
}

impl Side {
    fn new(along: f32) -> Self {
        let (delay, high) = at_ear(along);
        Self {
            delay,
            high,
            before: 0.0,
            state: 0.0,
        }
    }

    /// H(s) = (αs + β)/(s + β), by the bilinear transform.
    fn shadow(&mut self, input: f32, high: f32) -> f32 {
        let (twice, corner) = (2.0 * RATE as f32, CORNER as f32);
        let sum = twice + corner;
        let now = (twice * high + corner) * input + (corner - twice * high) * self.before;
        let state = (now - (corner - twice) * self.state) / sum;
        self.before = input;
        // A smaller number would be denormal, which takes a processor a hundred times longer.
        self.state = if state.abs() < 1e-20 { 0.0 } else { state };
        self.state
    }
}

impl Head {
    /// The way of a source with this cosine to the right ear's axis, at `distance` metres.
    pub(crate) fn new(along: f32, distance: f32) -> Self {
        Self {
            line: [0.0; LINE],
            at: 0,
            ears: [Side::new(-along), Side::new(along)],
            along,
            gain: 1.0 / distance,
        }
    }

    /// Adds a block of the source to `out`, as both ears hear it, left and right, while the source moves to a new place.
    pub(crate) fn add(
        &mut self,
        bus: &[f32; BLOCK],
        (along, distance): (f32, f32),
        out: &mut [[f32; 2]; BLOCK],
    ) {
        self.along += FOLLOW * (along - self.along);
        let (from, to) = (self.gain, self.gain + FOLLOW * (1.0 / distance - self.gain));
        self.gain = to;
        let aims = [at_ear(-self.along), at_ear(self.along)];
        let starts = [0, 1].map(|side| (self.ears[side].delay, self.ears[side].high));
        for (index, sample) in bus.iter().enumerate() {
            let share = (index + 1) as f32 / BLOCK as f32;
            let between = |from: f32, to: f32| from + share * (to - from);
            self.line[self.at] = sample * between(from, to);
            for side in 0..2 {
                let delay = between(starts[side].0, aims[side].0);
                let high = between(starts[side].1, aims[side].1);
                let delayed = self.delayed(delay);
                out[index][side] += self.ears[side].shadow(delayed, high);
            }
            self.at = (self.at + 1) % LINE;
        }
        for (ear, (delay, high)) in self.ears.iter_mut().zip(aims) {
            (ear.delay, ear.high) = (delay, high);
        }
    }

    /// The input of `delay` samples before, by Lagrange's cubic.
    fn delayed(&self, delay: f32) -> f32 {
        let delay = delay + LEAD as f32;
        let whole = delay as usize;
        let d = delay - whole as f32;
        let [a, b, c, e] = [0, 1, 2, 3].map(|k| self.line[(self.at + LINE + 1 - whole - k) % LINE]);
        // At −1, 0, 1 and 2 samples from the whole delay.
        let (m, p, q) = (d + 1.0, d - 1.0, d - 2.0);
        -d * p * q / 6.0 * a + m * p * q / 2.0 * b - m * d * q / 2.0 * c + m * d * p / 6.0 * e
    }
}

#[cfg(test)]
mod tests;
