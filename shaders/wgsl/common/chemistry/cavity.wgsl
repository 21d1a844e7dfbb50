// Cavities: bubbles wider than the particles resolve. In the density constraint a cavity is a body as glass is, by the kernel's
// integral over its sphere. Of a smaller bubble the particles around it hold the gas (`sim/exchange.wgsl`); between both sizes a bubble
// is partly either.
//!include common/liquid/kernel.wgsl

/// Radii over h from which on a bubble is partly a cavity, and altogether: at h = 2d its diameter is 1.6 and 2.4 d. Chosen.
const CAVITY_FROM: f32 = 0.4;
const CAVITY_WHOLE: f32 = 1.5 * CAVITY_FROM;

/// Cells around its own that a bubble reaches at most: of 20 mm at d = 1.25 mm.
const CAVITY_CELLS: i32 = 9;

/// Share of a bubble of that radius (m) that is a cavity.
fn cavity_share(radius: f32) -> f32 {
    return smoothstep(CAVITY_FROM, CAVITY_WHOLE, radius * INVERSE_SUPPORT);
}

/// ∫_q^1 tᵏ·spline(t) dt for k = 1, 2, 3: the spline is of truncated cubes (a − t)³.
fn spline_moments(q: f32) -> vec3<f32> {
    return 2.0 * cube_moments(1.0, max(1.0 - q, 0.0)) - 8.0 * cube_moments(0.5, max(0.5 - q, 0.0));
}

/// ∫_0^u (a − t)ᵏ t³ dt for k = 1, 2, 3.
fn cube_moments(a: f32, u: f32) -> vec3<f32> {
    let fourth = u * u * u * u;
    let first = 0.25 * a - 0.2 * u;
    let second = a * (0.25 * a - 0.4 * u) + u * u / 6.0;
    let third = a * (a * (0.25 * a - 0.6 * u) + 0.5 * u * u) - u * u * u / 7.0;
    return fourth * vec3<f32>(first, second, third);
}

/// Slope of B over −1/h that a particle within a cavity feels at least: deep inside, the integral is 1 everywhere.
const LEAST_SLOPE: f32 = 0.2;

/// B = ∫ W over a sphere of `radius` whose centre is `distance` away (m), and dB/d distance (1/m).
///
/// Of the kernel's shell of radius s the share (R² − (r − s)²)/(4rs) lies in the sphere, where the two cross.
fn cavity_at(distance: f32, radius: f32) -> vec2<f32> {
    let r = max(distance * INVERSE_SUPPORT, 0.02);
    let R = radius * INVERSE_SUPPORT;
    let low = spline_moments(min(abs(R - r), 1.0));
    let crossed = low - spline_moments(min(R + r, 1.0));
    let within = select(0.0, 1.0 - 32.0 * low.y, R > r);
    let volume = within + 8.0 / r * ((R * R - r * r) * crossed.x + 2.0 * r * crossed.y - crossed.z);
    var slope = 8.0 / (r * r) * (crossed.z - (R * R + r * r) * crossed.x);
    if (R > r) { slope = min(slope, -LEAST_SLOPE); }
    return vec2<f32>(volume, slope * INVERSE_SUPPORT);
}

/// The record `cavities` of a particle, in whole quanta, as sums of integers do not depend on order: Σ ∇B over 1/h, and Σ B as it would
/// be at the substep's start with that gradient.
const CAVITY_QUANTUM: f32 = 1.0 / 1048576.0;

fn cavity_gradient(words: vec4<i32>) -> vec3<f32> {
    return vec3<f32>(words.xyz) * (CAVITY_QUANTUM * INVERSE_SUPPORT / max(f32(words.w) * CAVITY_QUANTUM, 1.0));
}

/// Σ B at a particle that is `offset` (m) from where it was at the substep's start; no more than the space where cavities overlap.
fn cavity_volume(words: vec4<i32>, offset: vec3<f32>) -> f32 {
    return clamp(min(f32(words.w) * CAVITY_QUANTUM, 1.0) + dot(cavity_gradient(words), offset), 0.0, 1.0);
}
