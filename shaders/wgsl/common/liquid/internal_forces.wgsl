// Line 28: vorticity confinement (Macklin & Müller 2013) and cohesion (Akinci
// et al. 2013) between particles. A strength of 0 leaves a force out.
//!include common/liquid/kernel.wgsl
//!include common/liquid/vorticity.wgsl

/// ε of vorticity confinement, m/s.
override CONFINEMENT: f32 = 0.0;
/// γm of cohesion, m⁴/s².
override COHESION: f32 = 0.0;
/// βρ₀ of adhesion, m/s².
override ADHESION: f32 = 0.0;

/// Line 28: acceleration (m/s²) towards a particle at a distance of q support
/// radii: γm·C (Akinci et al. 2013, Eq. 2). Repels where it is negative.
fn cohesion(q: f32) -> f32 {
    let a = max(1.0 - q, 0.0) * q;
    let shape = a * a * a;
    let scale = COHESION * 32.0 / (3.14159265358979 * SUPPORT * SUPPORT * SUPPORT);
    return scale * select(2.0 * shape - 0.015625, shape, q > 0.5);
}

/// Line 28: acceleration (m/s²) ε·(N × ω) with N = η/|η| (Macklin & Müller
/// 2013, Eq. 16). N fades out where η is below a thousandth of |ω|/h: the direction
/// of a vanishing gradient is noise.
fn confinement(eta: vec3<f32>, omega: vec4<f32>) -> vec3<f32> {
    let size = length(eta) + 1e-3 * magnitude_in(omega) / SUPPORT;
    return cross(eta, omega.xyz) * (CONFINEMENT / max(size, 1e-30));
}
