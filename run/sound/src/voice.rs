//! The two kinds of tones: a ring that fades, and noise that fades.

use std::f64::consts::{PI, TAU};

use crate::RATE;
use crate::random::Random;

/// Seconds of a sample.
pub(crate) const SAMPLE: f64 = 1.0 / RATE as f64;

/// Below this part of full scale a voice ends: 100 dB below the loudest.
const END: f64 = 1e-5;

/// Highest frequency that a voice begins with, Hz: beyond hearing, and a rise stays below half the rate until it is faint.
const HIGHEST: f64 = 18_000.0;
const LOWEST: f64 = 20.0;

/// A sine that fades and may rise: a·e^(−dt)·sin(2πf(t + ξdt²/2)) (van den Doel 2005).
#[derive(Clone, Debug)]
pub(crate) struct Ring {
    /// The present value as a complex number: its size is the amplitude, its imaginary part the sound.
    state: [f64; 2],
    /// Factor of the state for each sample.
    turn: [f64; 2],
    /// Factor of `turn` for each sample.
    rise: [f64; 2],
}

fn times([a, b]: [f64; 2], [c, d]: [f64; 2]) -> [f64; 2] {
    [a * c - b * d, a * d + b * c]
}

fn turned(size: f64, angle: f64) -> [f64; 2] {
    [size * libm::cos(angle), size * libm::sin(angle)]
}

impl Ring {
    /// A ring of one pitch: amplitude, Hz, 1/s.
    pub(crate) fn new(amplitude: f64, frequency: f64, damping: f64) -> Self {
        Self::rising(amplitude, frequency, damping, 0.0)
    }

    /// A ring of a pitch that rises by the share `rise` in each time 1/`damping`.
    pub(crate) fn rising(amplitude: f64, frequency: f64, damping: f64, rise: f64) -> Self {
        let inaudible = !(LOWEST..=HIGHEST).contains(&frequency);
        let amplitude = if inaudible { 0.0 } else { amplitude };
        let step = TAU * frequency.clamp(LOWEST, HIGHEST) * SAMPLE;
        let damping = damping.max(1.0);
        Self {
            state: [amplitude, 0.0],
            turn: turned(libm::exp(-damping * SAMPLE), step),
            rise: turned(1.0, step * rise * damping * SAMPLE),
        }
    }

    fn level(&self) -> f64 {
        let [a, b] = self.state;
        (a * a + b * b).sqrt()
    }

    fn next(&mut self) -> f64 {
        let now = self.state[1];
        self.state = times(self.state, self.turn);
        self.turn = times(self.turn, self.rise);
        now
    }
}

/// Noise around a frequency, which comes up and fades.
#[derive(Clone, Debug)]
pub(crate) struct Hiss {
    amplitude: f64,
    fade: f64,
    come: f64,
    shown: f64,
    random: Random,
    /// A state-variable filter's coefficients and state (Zavalishin 2012, The art of VA filter design).
    filter: [f64; 3],
    state: [f64; 2],
}

impl Hiss {
    /// Noise of this amplitude around `frequency` (Hz) with a band of `width` of it; it comes up in `rise` seconds and falls to 1/e in
    /// `fall` seconds.
    pub(crate) fn new(
        amplitude: f64,
        [frequency, width]: [f64; 2],
        [rise, fall]: [f64; 2],
        random: Random,
    ) -> Self {
        let g = libm::tan(PI * frequency.clamp(LOWEST, HIGHEST) * SAMPLE);
        let k = width.clamp(0.05, 4.0);
        let a = 1.0 / (1.0 + g * (g + k));
        Self {
            amplitude,
            fade: libm::exp(-SAMPLE / fall.max(SAMPLE)),
            come: (SAMPLE / rise.max(SAMPLE)).min(1.0),
            shown: 0.0,
            random,
            filter: [a, g * a, k],
            state: [0.0; 2],
        }
    }

    fn next(&mut self) -> f64 {
        let noise = 2.0 * self.random.number() - 1.0;
        let [a1, a2, k] = self.filter;
        let g = a2 / a1;
        let rest = noise - self.state[1];
        let band = a1 * self.state[0] + a2 * rest;
        let low = self.state[1] + a2 * self.state[0] + g * a2 * rest;
        self.state = [2.0 * band - self.state[0], 2.0 * low - self.state[1]];
        self.shown = (self.shown + self.come).min(1.0);
        self.amplitude *= self.fade;
        self.amplitude * self.shown * k * band
    }
}

/// A kind of tone.
#[derive(Clone, Debug)]
pub(crate) enum Tone {
    Ring(Ring),
    Hiss(Hiss),
}

/// A tone that begins after some samples.
#[derive(Clone, Debug)]
pub(crate) struct Voice {
    pub(crate) tone: Tone,
    pub(crate) wait: u32,
}

impl Voice {
    /// A voice that begins after `seconds`.
    pub(crate) fn after(seconds: f64, tone: impl Into<Tone>) -> Self {
        let wait = (seconds.clamp(0.0, 10.0) * f64::from(RATE)) as u32;
        let tone = tone.into();
        Self { tone, wait }
    }

    /// Its amplitude now.
    pub(crate) fn level(&self) -> f64 {
        match &self.tone {
            Tone::Ring(ring) => ring.level(),
            Tone::Hiss(hiss) => hiss.amplitude,
        }
    }

    /// Whether it can no longer be heard, as NaN cannot.
    pub(crate) fn is_over(&self) -> bool {
        let level = self.level();
        level.is_nan() || level < END
    }

    /// Adds its samples to `bus`.
    pub(crate) fn add_to(&mut self, bus: &mut [f32]) {
        let skipped = (self.wait as usize).min(bus.len());
        self.wait -= skipped as u32;
        for sample in &mut bus[skipped..] {
            *sample += match &mut self.tone {
                Tone::Ring(ring) => ring.next(),
                Tone::Hiss(hiss) => hiss.next(),
            } as f32;
        }
    }
}

impl From<Ring> for Tone {
    fn from(ring: Ring) -> Self {
        Self::Ring(ring)
    }
}

impl From<Hiss> for Tone {
    fn from(hiss: Hiss) -> Self {
        Self::Hiss(hiss)
    }
}
