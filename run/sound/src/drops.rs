//! Drops on solids, and acid on a glove.

use crate::bubble::Bubble;
use crate::event::{Drops, Onto};
use crate::random::Random;
use crate::voice::{Hiss, Voice};

/// Pressure at 1 m in full scale, of a drop of 3 mm at 2 m/s on a bench: chosen. That it goes as d²v² is assumed.
const TICK: f64 = 0.05;
const SIZE: f64 = 3e-3;
const SPEED: f64 = 2.0;

/// Most sounds of one event; more drops are louder.
const MOST: u32 = 12;

/// Time over which drops of one event fall, seconds: a display's frame.
const SPREAD: f64 = 0.011;

/// Share of drops that leave a bubble in a puddle: regular entrainment needs a size and speed that few have (Pumphrey and
/// Elmore 1990). Assumed.
const BUBBLES: f64 = 0.3;

/// Pressure of the hiss at 1 m in full scale, its band (Hz, width over it), its rise and fall in seconds: chosen to be heard beside a
/// boil, whose pitch is lower.
const SIZZLE: f64 = 0.12;
const SIZZLE_BAND: [f64; 2] = [6500.0, 0.8];
const SIZZLE_TIMES: [f64; 2] = [0.015, 0.18];
const CRACKLES: u32 = 14;

fn size(drops: &Drops) -> (f64, f64) {
    let diameter = f64::from(drops.diameter).clamp(0.2e-3, 8e-3);
    (diameter, f64::from(drops.speed.abs()).clamp(0.0, 10.0))
}

/// Amplitude of one drop, at 1 m.
fn tick(drops: &Drops) -> f64 {
    let (diameter, speed) = size(drops);
    let part = diameter / SIZE * speed / SPEED;
    TICK * part * part
}

/// Adds ticks, and in a puddle some bubbles.
pub(crate) fn drops(drops: &Drops, random: &mut Random, mut add: impl FnMut(Voice)) {
    let sounds = drops.count.min(MOST);
    if sounds == 0 {
        return;
    }
    let more = (f64::from(drops.count) / f64::from(sounds)).sqrt().min(8.0);
    let (diameter, speed) = size(drops);
    // Three over the time in which a drop moves by its own diameter.
    let pitch = (3.0 * speed / diameter).clamp(300.0, 7000.0);
    for _ in 0..sounds {
        let at = SPREAD * random.number();
        let amplitude = more * tick(drops) * random.between(0.5, 1.0);
        let seed = Random::new(random.bits(), 0);
        let band = [pitch * random.between(0.8, 1.3), 1.5];
        let hiss = Hiss::new(amplitude, band, [2e-4, 1.5e-3], seed);
        add(Voice::after(at, hiss));
        if drops.onto == Onto::Wet && random.number() < BUBBLES {
            let bubble = Bubble {
                radius: (0.25 * diameter * random.between(0.6, 1.4)) as f32,
                depth: 0.0,
                density: 1000.0,
            };
            add(Voice::after(at + 0.01, bubble.ring(1.0)));
        }
    }
}

/// Adds a hiss with crackles in it.
pub(crate) fn sizzle(strength: f32, random: &mut Random, mut add: impl FnMut(Voice)) {
    let loud = sizzle_level(strength);
    let seed = Random::new(random.bits(), 0);
    let hiss = Hiss::new(loud, SIZZLE_BAND, SIZZLE_TIMES, seed);
    add(Voice::after(0.0, hiss));
    for _ in 0..CRACKLES {
        let at = random.between(0.0, 2.0 * SIZZLE_TIMES[1]);
        let seed = Random::new(random.bits(), 0);
        let band = [random.between(3000.0, 9000.0), 1.0];
        let crackle = Hiss::new(loud, band, [1e-4, 2e-3], seed);
        add(Voice::after(at, crackle));
    }
}

/// Amplitude of drops at 1 m, in full scale.
pub(crate) fn level(drops: &Drops) -> f64 {
    tick(drops) * f64::from(drops.count).sqrt()
}

/// Amplitude of a sizzle of `strength` (0 to 1) at 1 m, in full scale; [`level`] gives that of drops.
pub(crate) fn sizzle_level(strength: f32) -> f64 {
    SIZZLE * f64::from(strength).clamp(0.0, 1.0)
}
