//! The meniscus: liquid that wets a vessel's wall climbs it, within some millimetres of it. Particles of that size cannot show that, so the
//! surface's normal is turned there as Young and Laplace's equation has it, by weight and surface tension: it shows as the line where a surface
//! meets its glass.

//!include common/picture/frame.wgsl

/// Capillary length √(σ/(ρ g)) of water at 20 °C (72.8 mN/m), and what acid adds by its mass (98 %: 55 mN/m, 1836 kg/m³), m.
const CAPILLARY = 0.00272;
const CAPILLARY_OF_ACID = -0.00099;
/// How far from level a surface may be, the cosine: what stands upright, or falls, has no meniscus; from the second on a surface has it wholly.
const LEVEL = vec2<f32>(0.5, 0.8);

/// How far a surface counts as level, 0 to 1.
fn levelness(normal: vec3<f32>) -> f32 {
    return smoothstep(LEVEL.x, LEVEL.y, normal.y);
}

/// The slope, as an angle, of a meniscus at `away` capillary lengths from an upright wall with a contact angle of 30°, as the solver's glass
/// has it: 60° at the wall. A fit, within 0.2°, of the exact profile, ln cot φ/4 − 2 cos φ/2 = `away` + the same at 60°.
fn meniscus_slope(away: f32) -> f32 {
    let dying = exp(-away);
    let square = dying * dying;
    return dying * (0.81861 + square * (0.14872 + square * (-0.03768 + square * 0.11528)));
}

/// The normal of a surface with its meniscus at a wall, whose outward normal is `wall`, `gap` away (scene's unit).
fn with_meniscus(normal: vec3<f32>, wall: vec3<f32>, gap: f32, acid: f32) -> vec3<f32> {
    let length_ = (CAPILLARY + CAPILLARY_OF_ACID * acid) / frame.metres_per_unit;
    let level = levelness(normal);
    // Six lengths away it is 0.1°.
    if (level == 0.0 || gap > 6.0 * length_) { return normal; }
    let slope = level * meniscus_slope(max(gap, 0.0) / length_);
    let inwards = dot(wall, normal) * normal - wall;
    let across = dot(inwards, inwards);
    if (across < 1e-6) { return normal; }
    return cos(slope) * normal + sin(slope) * inverseSqrt(across) * inwards;
}
