// The record `eddies` of the physical chemistry: what the flow leaves unresolved around a particle
// (`chemistry/eddies.rs`).

struct Eddies {
    /// K: diffusivity of acid and heat, m²/s.
    diffusivity: f32,
    /// ε: power that they take from the flow, W/kg.
    dissipation: f32,
}

/// Turbulent Schmidt and Prandtl number.
const SCHMIDT: f32 = 0.7;

fn pack_eddies(eddies: Eddies) -> vec2<f32> {
    return vec2<f32>(eddies.diffusivity, eddies.dissipation);
}

fn unpack_eddies(words: vec2<f32>) -> Eddies {
    return Eddies(words.x, words.y);
}
