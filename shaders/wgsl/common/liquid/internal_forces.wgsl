// Line 28: vorticity confinement (Macklin & Müller 2013). A strength of 0 leaves it out.
//!include common/liquid/kernel.wgsl
//!include common/liquid/vorticity.wgsl

/// ε of vorticity confinement, m/s.
override CONFINEMENT: f32 = 0.0;

/// Line 28: acceleration (m/s²) ε·(N × ω) with N = η/|η| (Macklin & Müller
/// 2013, Eq. 16). N fades out where η is below a thousandth of |ω|/h: the direction
/// of a vanishing gradient is noise.
fn confinement(eta: vec3<f32>, omega: vec4<f32>) -> vec3<f32> {
    let size = length(eta) + 1e-3 * magnitude_in(omega) / SUPPORT;
    return cross(eta, omega.xyz) * (CONFINEMENT / max(size, 1e-30));
}
