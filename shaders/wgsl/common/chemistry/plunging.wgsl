// Air that a stream takes down where it plunges into liquid.
//!include common/liquid/gravity.wgsl
//!include common/liquid/kernel.wgsl
//!include common/maths/lot.wgsl

/// Speed from which on a rough stream takes air down, m/s (Ervine, McKeogh and Elsawy 1980).
const ONSET: f32 = 0.8;
/// Share of its fastest fall that a particle has left when it is in liquid, and of a full neighbourhood that it has there.
const SLOWED: f32 = 0.8;
const IMMERSED: f32 = 0.9;
/// Speed of fall of one that is at rest, m/s.
const RESTS: f32 = 0.2;
/// Most of a neighbourhood that tells a stream's diameter.
const WIDEST: f32 = 0.9;
/// Most that a stream's width changes in a step of the bubbles, over itself. Chosen: a stream thins by no
/// more in that time.
const MOST_THINNED: f32 = 0.02;

/// Diameter of a stream whose particles fill that share of their neighbourhoods, m. Of n × n in its section, at h = 2d, they fill
/// (1 − 0.3/n)², and it is as wide as a circle of n² d².
fn width_of_stream(filled: f32) -> f32 {
    return 0.169 * SUPPORT / (1.0 - sqrt(min(filled, WIDEST)));
}

/// Width of a falling particle's stream, which changes by `MOST_THINNED` at most in a step of the bubbles: what fills its
/// neighbourhood just before it is in liquid is no stream. `fall` is its entry of `falls`.
fn width_of_fall(fall: vec2<f32>, filled: f32) -> f32 {
    let width = width_of_stream(filled);
    if (fall.x < RESTS) { return width; }
    return clamp(width, (1.0 - MOST_THINNED) * fall.y, (1.0 + MOST_THINNED) * fall.y);
}

/// Air over liquid that a stream of `speed` (m/s) and `width` (m) takes down: 0.04 Fr^0.28 (L/D)^0.4 (Biń 1993), here with the
/// speed and width with which it plunges and with the height L = u²/2g from which it fell.
fn taken_down(speed: f32, width: f32) -> f32 {
    if (speed < ONSET || GRAVITY <= 0.0) { return 0.0; }
    let froude = speed * speed / (GRAVITY * width);
    return 0.04 * pow(froude, 0.28) * pow(0.5 * froude, 0.4);
}

/// Bit of a claim of a bubble's place that is for air.
const CLAIM_OF_AIR: u32 = 0x80000000u;

/// Radius of the smallest and of the largest bubble of such air, m (1 to 4 mm in diameter: Biń 1993).
const LEAST_AIR: f32 = 0.5e-3;
const MOST_AIR: f32 = 2e-3;

/// Radius of a bubble of air that a particle of `identity` may bring after a fall of that `speed`, m: by lot.
fn radius_of_air(identity: u32, speed: f32) -> f32 {
    return LEAST_AIR * pow(MOST_AIR / LEAST_AIR, lot(identity, bitcast<u32>(speed)));
}
