// What a pair of the physical chemistry swaps in a substep, and how much of a particle is swapped in all
// (`chemistry/transport.rs`).
//!include common/chemistry/heat.wgsl
//!include common/chemistry/molecules.wgsl
//!include common/liquid/kernel.wgsl
//!include common/liquid/step.wgsl

/// Liquid (V0·ρ0) that a pair at q = r/h swaps per diffusivity (s/m²), and heat per kelvin; the other counts
/// where `whole` is 1. The kernel's part is `diffusion_weight`; with the two harmonic means it needs one
/// division instead of three.
fn swapped_by(q: f32, own: Potential, other: Potential, whole: f32) -> vec2<f32> {
    let a = vec2<f32>(own.mass, own.mass * own.capacity);
    let b = vec2<f32>(other.mass, other.mass * other.capacity) * whole;
    let sums = max(a + b, vec2<f32>(1e-12));
    let inverse = 1.0 / ((q * q + 0.01) * sums.x * sums.y);
    let weight = (4.0 / (SUPPORT * SUPPORT)) * weight_scale() * (-spline_slope(q) * q) * inverse;
    return (step.time * weight * (a * b)) * sums.yx;
}

/// What mixes fastest between two particles whose eddies have that diffusivity (m²/s).
fn fastest_of(eddies: f32) -> f32 {
    return eddies + max(ACID_DIFFUSIVITY, THERMAL_DIFFUSIVITY);
}
