//! Steam: puffs of mist over the finished picture, in their order. Their colours are premultiplied by their opacity, and that is low, so their
//! order hardly shows; where one meets glass or liquid it fades, and is not cut off.
//!
//! A puff is a ball that is densest in its middle, with wisps that go with it: they are a function of the place in the ball, so both
//! eyes see the same. The room lights it: ceiling and floor from all sides, and the window by the phase function of mist.

//!include common/chemistry/puff.wgsl
//!include common/picture/daylight.wgsl
//!include common/picture/frame.wgsl
//!include common/picture/mist_phase.wgsl
//!include common/picture/tile_marks.wgsl
//!include common/picture/vessel_rays.wgsl

@group(0) @binding(7) var<storage, read> puffs: array<Puff>;
/// For each tile a bit a puff, as `tile_puffs.wgsl` writes them.
@group(0) @binding(5) var<storage, read> puffs_in_tiles: array<u32>;
@group(0) @binding(6) var<storage, read> depths: array<f32>;

/// How much the density varies from wisp to wisp, of its mean.
const WISPS = 0.75;
/// Share of a puff's radius over which it ends at the glass that it is in.
const SOFT_WALL = 0.35;

/// Density over its mean at `at` in a puff (in radii): smooth, with a mean of 1 over many puffs, and within 0.07 (rms) over each. Waves across each other, bent by each other, whose
/// phases are the puff's own.
fn wisps(at: vec3<f32>, index: u32) -> f32 {
    let phase = 2.399963 * f32(index & 1023u) * vec3<f32>(1.0, 1.7, 2.3);
    let bent = at + 0.25 * sin(4.1 * at.yzx + phase);
    let waves = sin(8.0 * bent + phase.zxy);
    return 1.0 + WISPS * (waves.x * waves.y + waves.y * waves.z + waves.z * waves.x) / 1.5;
}

/// The share of a puff in a vessel that is within its glass, at `at` (stage); 1 for one in the open. There is no mist in the wall, and little
/// in the air beyond.
fn within_glass(middle: vec3<f32>, at: vec3<f32>, radius: f32) -> f32 {
    var share = 1.0;
    for (var index = 0u; index < frame.blocker_count; index++) {
        let m = frame.vessels[index].vessel_from_stage;
        let p = (m * vec4<f32>(middle, 1.0)).xyz;
        let outer = frame.vessels[index].outer;
        if (dot(p.xz, p.xz) > outer * outer || p.y < 0.0 || p.y > frame.vessels[index].rim) { continue; }
        let q = (m * vec4<f32>(at, 1.0)).xyz;
        let inside = vessel_radius(index, q.y) - length(q.xz);
        let soft = SOFT_WALL * min(radius, outer);
        // Over the rim it is free, softly too.
        let free = smoothstep(-soft, soft, q.y - frame.vessels[index].rim);
        share *= max(smoothstep(0.0, soft, inside), free);
    }
    return share;
}

/// Light of a puff at a pixel, premultiplied, and what it lets through; `behind` is the view depth of what
/// is there.
fn puff_at(index: u32, eye: u32, pixel: vec2<i32>, behind: f32) -> vec4<f32> {
    let puff = puffs[index];
    let view = &frame.views[eye];
    let middle = (*view).clip_from_stage * vec4<f32>(puff.position, 1.0);
    // In the puff's plane across the eye's axis, in its radii.
    let seen = seen_along(eye, vec2<f32>(pixel) + 0.5);
    let place = (*view).eye + middle.w * seen;
    let at = (place - puff.position) / puff.radius;
    let soft = max(1.0 - dot(at, at), 0.0);
    if (soft == 0.0) { return vec4<f32>(0.0, 0.0, 0.0, 1.0); }
    // A ball's share before what is behind it, from its back to its front.
    let before = saturate(0.5 + 0.5 * (behind - middle.w) / puff.radius);
    // Over the disc (1 − ρ²)² is a third on the whole: the mean depth is the puff's.
    let depth = 3.0 * puff.depth * soft * soft * wisps(at, index) * before * within_glass(puff.position, place, puff.radius);
    let open = exp(-depth);
    let to_eye = -normalize(seen);
    let key = key_light(puff.position * frame.metres_per_unit);
    // Most of what is seen is from the front, the more the less is seen through it.
    let front = at + (1.0 - open) * sqrt(soft) * to_eye;
    let towards = dot(front, key.direction);
    let way = sqrt(max(towards * towards + 1.0 - dot(front, front), 0.0)) - towards;
    // The mean chord is 4/3 of the radius.
    let window = window_scattered(dot(to_eye, -key.direction), 0.75 * puff.depth * way);
    // What comes back out of it does so on the side that faces the window.
    let back = sent_back(2.0 * puff.depth) * saturate(0.5 + 0.5 * towards);
    let light = ambient_light(0.0) + (window + back) * key.light;
    return vec4<f32>(display(light) * (1.0 - open), open);
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
