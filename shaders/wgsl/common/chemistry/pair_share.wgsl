// The pair coefficient of Eq. 5, conservative: 4 m_j/(ρ_i + ρ_j) with both at
// rest density is 2 V0, the same for i and j, so that what one gives the other
// gets. The printed m_j/ρ_j·4ρ_i/(ρ_i + ρ_j) is not. `chemistry/exchange.rs`
// is the same in f64, and says why no D, Δt or h makes it unstable.

//!include common/liquid/kernel.wgsl
//!include common/liquid/particle.wgsl
//!include common/maths/decay.wgsl

/// −x·∇W/(|x|² + 0.01 h²)·h²/σ at q = |x|/h, never negative.
fn diffusion_weight(q: f32) -> f32 {
    return -spline_slope(q) * q / (q * q + 0.01);
}

/// K_ij: the share of its difference that a pair exchanges, for `rate` = Δt·D
/// (m²).
fn pair_share(rate: f32, weight: f32) -> f32 {
    let free = rate * (2.0 / (SUPPORT * SUPPORT)) * weight_scale() * weight;
    return min(free, 1.0 / f32(LIST_CAPACITY));
}

/// Share of the difference to a wall that fills `volume` of a particle's
/// support which the particle gives up in a substep.
fn wall_share(rate: f32, volume: f32) -> f32 {
    return decayed(rate * (24.0 / (SUPPORT * SUPPORT)) * max(volume, 0.0));
}
