//! Finishes the picture away from the fovea: between the pixels that were shaded colours go over from one to the next, so that
//! no block is seen; and lays steam over that.

//!include common/picture/coarse_blocks.wgsl
//!include common/picture/under_steam.wgsl

/// Whether the class's tiles have steam.
override STEAM: bool = false;

@group(0) @binding(2) var drawn: texture_2d_array<f32>;
@group(0) @binding(9) var finished: texture_storage_2d_array<rgba8unorm, write>;

/// What was shaded of the block with its low corner there; of one that no eye sees, `own` of the block next to it.
fn shaded(low: vec2<i32>, side: i32, eye: u32, own: vec4<f32>) -> vec4<f32> {
    let pixel = max(shaded_in(low, side), vec2<i32>(0));
    if (frame.hides != 0u && is_hidden(pixel, eye)) { return own; }
    return textureLoad(drawn, pixel, eye, 0);
}

fn spread(pixel: vec2<i32>, eye: u32, side: i32) -> vec4<f32> {
    let own = textureLoad(drawn, shaded_in(side * (pixel / side), side), eye, 0);
    let place = vec2<f32>(pixel - side / 2) / f32(side);
    let first = floor(place);
    let low = vec2<i32>(first) * side;
    let share = place - first;
    let above = mix(shaded(low, side, eye, own), shaded(low + vec2<i32>(side, 0), side, eye, own), share.x);
    let below = mix(
        shaded(low + vec2<i32>(0, side), side, eye, own),
        shaded(low + vec2<i32>(side, side), side, eye, own),
        share.x,
    );
    // Alpha is for the panel, of which no block has any.
    return vec4<f32>(mix(above, below, share.y).rgb, own.a);
}

@compute @workgroup_size(32, 8)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_id) local: vec3<u32>) {
    let shaded_tile = coarse_tile(group.x);
    let corner = corner_of(shaded_tile.tile);
    let pixel = vec2<i32>(corner.xy + vec2<u32>(local.x, 8u * group.y + local.y));
    if (any(pixel >= vec2<i32>(frame.extent))) { return; }
    let eye = corner.z;
    var colour = vec4<f32>(0.0, 0.0, 0.0, 1.0);
    if (frame.hides == 0u || !is_hidden(pixel, eye)) {
        colour = spread(pixel, eye, i32(shaded_tile.side));
        if (STEAM) { colour = under_steam(colour, Place(pixel, eye, shaded_tile.tile, true)); }
    }
    textureStore(finished, pixel, eye, colour);
}
