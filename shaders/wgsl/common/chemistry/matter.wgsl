// The record `matter` of the physical chemistry: what a particle holds.

struct Content {
    /// Mass fraction of acid, of liquid and vapour together.
    acid: f32,
    /// Specific enthalpy, J/kg.
    enthalpy: f32,
    /// Mass fraction of vapour.
    vapour: f32,
    /// Over V0·ρ0.
    mass: f32,
}

fn pack_content(content: Content) -> vec4<f32> {
    return vec4<f32>(content.acid, content.enthalpy, content.vapour, content.mass);
}

fn unpack_content(words: vec4<f32>) -> Content {
    return Content(words.x, words.y, words.z, words.w);
}
