// The record `eddies` of the physical chemistry: what the flow leaves unresolved around a particle
// (`chemistry/eddies.rs`), and what of it is not mixed (`chemistry/segregation.rs`).

struct Eddies {
    /// K: diffusivity of acid and heat, m²/s.
    diffusivity: f32,
    /// s²: variance of the acid fraction within the liquid.
    variance: f32,
}

/// C_s²/Sc_t, times Δ² (m²).
override EDDY_AREA: f32 = 0.0;
/// Turbulent Schmidt and Prandtl number.
const SCHMIDT: f32 = 0.7;

fn pack_eddies(eddies: Eddies) -> vec2<f32> {
    return vec2<f32>(eddies.diffusivity, eddies.variance);
}

fn unpack_eddies(words: vec2<f32>) -> Eddies {
    return Eddies(words.x, words.y);
}

/// ε: power that they take from the flow, W/kg.
fn dissipation_of(eddies: Eddies) -> f32 {
    let rate = eddies.diffusivity / max(EDDY_AREA, 1e-12);
    return SCHMIDT * eddies.diffusivity * rate * rate;
}
