//! Blows: the modes of struck bodies, and glass that breaks.

use std::f64::consts::PI;

use crate::event::{Body, Glass, Strike};
use crate::modes::{Cup, WAVES};
use crate::random::Random;
use crate::voice::{Hiss, Ring, Voice};

/// Loss factor of a glass that stands on a bench, and of one in a hand: assumed (glass alone has 0.001). Liquid adds up to as much again.
const LOSS: f64 = 0.003;
const HELD: f64 = 5.0;

/// How long bodies touch, seconds: the order that Hertz's law gives for 0.1 kg at 0.1 m/s. Assumed.
const TOUCH_GLASS: f64 = 0.1e-3;
const TOUCH_BENCH: f64 = 0.3e-3;
const TOUCH_DULL: f64 = 2e-3;

/// Part of a blow that goes into a mode: at the wall, and at the bottom, which hardly moves in one. Assumed.
const AT_WALL: f64 = 0.3;
const AT_BOTTOM: f64 = 0.03;

/// Pressure at 1 m in full scale, of a mode that moves at 1 m/s: chosen.
const RING: f64 = 0.3;

/// Modes of a table's top: Hz, 1/s, and pressure at 1 m in full scale, of 1 N·s. Chosen: wood on legs, a loss factor of
/// some 0.15.
const BENCH: [[f64; 3]; 4] = [
    [95.0, 45.0, 1.2],
    [170.0, 70.0, 1.0],
    [290.0, 120.0, 0.7],
    [460.0, 190.0, 0.4],
];

/// The blow's own noise, over 1 N·s.
const KNOCK: f64 = 1.5;

/// Limit to which impulses are clamped, N·s: a full flask that falls from a table.
const HARDEST: f64 = 2.0;

/// Longest that shards of a broken glass fall and turn, seconds.
const SHATTER: f64 = 0.6;
const SHARDS: u32 = 36;

/// Adds the voices of a blow.
pub(crate) fn strike(blow: &Strike, random: &mut Random, mut add: impl FnMut(Voice)) {
    let impulse = f64::from(blow.impulse.abs()).min(HARDEST);
    let [a, b] = blow.bodies;
    for (body, other) in [(a, b), (b, a)] {
        let (touch, share) = match other {
            Body::Glass(_) => (TOUCH_GLASS, AT_WALL),
            Body::Bench => (TOUCH_BENCH, AT_BOTTOM),
            Body::Dull => (TOUCH_DULL, AT_WALL),
        };
        match body {
            Body::Glass(glass) => ring(&glass, impulse * share, touch, &mut add),
            Body::Bench => thump(impulse, touch, random, &mut add),
            Body::Dull => {}
        }
    }
}

/// Share of a mode's amplitude that a blow of this length excites.
fn excited(frequency: f64, touch: f64) -> f64 {
    let slow = 2.0 * frequency * touch;
    1.0 / (1.0 + slow * slow)
}

/// Adds a glass's modes, for a blow whose part in each is `impulse` (N·s).
fn ring(glass: &Glass, impulse: f64, touch: f64, add: &mut impl FnMut(Voice)) {
    let cup = Cup::of(glass);
    let loss = LOSS * if glass.held { HELD } else { 1.0 } * (1.0 + cup.filled());
    for waves in WAVES {
        let frequency = cup.frequency(waves);
        let speed = impulse / cup.mass(waves) * excited(frequency, touch);
        let damping = PI * frequency * loss;
        let tone = Ring::new(RING * speed, frequency, damping);
        add(Voice::after(0.0, tone));
    }
}

fn thump(impulse: f64, touch: f64, random: &mut Random, add: &mut impl FnMut(Voice)) {
    for [frequency, damping, loud] in BENCH {
        let amplitude = loud * impulse * excited(frequency, touch);
        let tone = Ring::new(amplitude, frequency, damping);
        add(Voice::after(0.0, tone));
    }
    let seed = Random::new(random.bits(), 0);
    let band = [0.3 / touch, 2.0];
    let knock = Hiss::new(KNOCK * impulse, band, [touch, 4.0 * touch], seed);
    add(Voice::after(0.0, knock));
}

/// Adds the voices of a glass that breaks: a crack, and shards that ring as small plates do, fewer and fewer.
pub(crate) fn shatter(glass: &Glass, random: &mut Random, mut add: impl FnMut(Voice)) {
    let loud = LOUDEST_BREAK * (Cup::of(glass).whole() / 0.1).sqrt().clamp(0.2, 2.0);
    let seed = Random::new(random.bits(), 0);
    let crack = Hiss::new(2.0 * loud, [4500.0, 2.5], [2e-4, 0.02], seed);
    add(Voice::after(0.0, crack));
    for _ in 0..SHARDS {
        let late = (0.25 * SHATTER * random.wait()).min(SHATTER);
        let frequency = 2500.0 * libm::exp(1.5 * random.number());
        let damping = PI * frequency * 5.0 * LOSS;
        let amplitude = loud * random.between(0.1, 0.5) * libm::exp(-2.0 * late / SHATTER);
        let tone = Ring::new(amplitude, frequency, damping);
        add(Voice::after(late, tone));
    }
}

/// Pressure at 1 m of a glass of 0.1 kg that breaks: chosen.
const LOUDEST_BREAK: f64 = 0.15;

/// Amplitude of a blow at 1 m, in full scale.
pub(crate) fn level(blow: &Strike) -> f64 {
    let mut sum = 0.0;
    strike(blow, &mut Random::new(0, 0), |voice| sum += voice.level());
    sum
}

/// Amplitude of a glass that breaks at 1 m, in full scale; [`level`] gives that of a blow.
pub(crate) const BREAK: f64 = LOUDEST_BREAK;
