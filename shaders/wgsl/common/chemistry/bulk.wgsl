// The record `bulk` of the physical chemistry: a particle's extent and what goes with it through the lines
// that move it.
//!include common/chemistry/features.wgsl

/// ρ0, kg/m³.
override REST_DENSITY: f32 = 1000.0;
/// ρ of steam at 100 °C, kg/m³: with bubbles a particle's vapour is its gas as such steam.
const STEAM_DENSITY: f32 = 0.59;

struct Bulk {
    /// Over V0.
    volume: f32,
    /// ρ0 over the particle's density.
    lightness: f32,
    /// Vapour that it holds, over V0·ρ0.
    vapour: f32,
    /// What c and h lack, see `rests.wgsl`.
    rests: f32,
}

fn pack_bulk(bulk: Bulk) -> vec4<f32> {
    return vec4<f32>(bulk.volume, bulk.lightness, bulk.vapour, bulk.rests);
}

fn unpack_bulk(words: vec4<f32>) -> Bulk {
    return Bulk(words.x, words.y, words.z, words.w);
}

/// Density of a particle's liquid without the gas of the bubbles around it, over ρ0.
fn liquid_density(extent: Bulk) -> f32 {
    if (!BUBBLES) { return 1.0 / extent.lightness; }
    let gas = extent.vapour * (REST_DENSITY / STEAM_DENSITY);
    return extent.volume / (max(extent.volume - gas, 1e-3) * extent.lightness);
}
