// The record `bulk` of the physical chemistry: a particle's extent and what goes with it through the lines
// that move it.

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
