//! Steam: round puffs that face the eye, over the finished picture in their order. Their colours are
//! premultiplied by their opacity, and that is low, so their order hardly shows; where one meets
//! glass or liquid it fades, over its own radius, and is not cut off.

//!include common/chemistry/puff.wgsl
//!include common/picture/daylight.wgsl
//!include common/picture/frame.wgsl
//!include common/picture/tile_marks.wgsl

@group(0) @binding(7) var<storage, read> puffs: array<Puff>;
/// For each tile a bit a puff, as `tile_puffs.wgsl` writes them.
@group(0) @binding(5) var<storage, read> puffs_in_tiles: array<u32>;
@group(0) @binding(6) var<storage, read> depths: array<f32>;

/// Share of the light that falls on a puff which it sends to the eye, on the whole: it scatters
/// nearly all, forwards more than back.
const WHITENESS = 0.85;

/// Light of a puff at a pixel, premultiplied, and what it lets through; `behind` is the view depth of what
/// is there.
fn puff_at(index: u32, eye: u32, pixel: vec2<i32>, behind: f32) -> vec4<f32> {
    let puff = puffs[index];
    let view = &frame.views[eye];
    let middle = (*view).clip_from_stage * vec4<f32>(puff.position, 1.0);
    // In the puff's plane across the eye's axis, in its radii.
    let at = (*view).eye + middle.w * seen_along(eye, vec2<f32>(pixel) + 0.5) - puff.position;
    let square = dot(at, at) / (puff.radius * puff.radius);
    // A ball's share before what is behind it, from its back to its front.
    let before = saturate(0.5 + 0.5 * (behind - middle.w) / puff.radius);
    let soft = max(1.0 - square, 0.0);
    let opacity = (1.0 - exp(-puff.depth)) * soft * soft * before;
    let key = key_light(puff.position * frame.metres_per_unit);
    return vec4<f32>(display(WHITENESS * (ambient_light(0.0) + 0.5 * key.light)) * opacity, 1.0 - opacity);
}

/// All puffs at a pixel of a tile: their light, and what they let through.
fn steam_over(pixel: vec2<i32>, eye: u32, tile: u32) -> vec4<f32> {
    let behind = frame.views[eye].near / max(depths[pixel_index(pixel, eye)], 1e-9);
    var seen = vec4<f32>(0.0, 0.0, 0.0, 1.0);
    for (var word = 0u; word < PUFF_WORDS; word++) {
        for (var rest = puffs_in_tiles[tile * PUFF_WORDS + word]; rest != 0u; rest &= rest - 1u) {
            let puff = puff_at(32u * word + firstTrailingBit(rest), eye, pixel, behind);
            seen = vec4<f32>(puff.rgb + puff.a * seen.rgb, puff.a * seen.a);
        }
    }
    return seen;
}
