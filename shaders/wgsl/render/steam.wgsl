//! Steam: round puffs that face the eye, drawn over the finished picture from a buffer, far and
//! near as they come. Their colours are premultiplied by their opacity, and that is low, so their
//! order hardly shows; where one meets glass or liquid it fades, over its own radius, and is not
//! cut off.

//!include common/frame.wgsl
//!include common/daylight.wgsl
//!include common/puff.wgsl

@group(0) @binding(1) var<storage, read> puffs: array<Puff>;
@group(0) @binding(2) var depth: texture_depth_2d_array;

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    /// Place in the puff, in its radii.
    @location(0) place: vec2<f32>,
    /// View depth of the middle, radius, opacity.
    @location(1) @interpolate(flat) puff: vec3<f32>,
    @location(2) @interpolate(flat) light: vec3<f32>,
}

/// Share of the light that falls on a puff which it sends to the eye, on the whole: it scatters
/// nearly all, forwards more than back.
const WHITENESS = 0.85;

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(view_index) eye: u32) -> Varyings {
    let puff = puffs[index / 6u];
    let corner = index % 6u;
    let right = corner == 1u || corner == 2u || corner == 4u;
    let low = corner == 2u || corner == 4u || corner == 5u;
    let place = select(vec2<f32>(-1.0), vec2<f32>(1.0), vec2<bool>(right, low));
    let view = &frame.views[eye];
    let middle = (*view).clip_from_stage * vec4<f32>(puff.position, 1.0);
    var out = Varyings(vec4<f32>(2.0, 2.0, 2.0, 1.0), place, vec3<f32>(0.0), vec3<f32>(0.0));
    // Nothing of a puff around the eye: it would fill the picture.
    if !(puff.radius > 0.0 && puff.depth > 0.0 && middle.w > puff.radius + (*view).near) {
        return out;
    }
    let x_axis = normalize((*view).across);
    let y_axis = normalize((*view).down);
    let at = puff.position + puff.radius * (place.x * x_axis + place.y * y_axis);
    out.clip = (*view).clip_from_stage * vec4<f32>(at, 1.0);
    out.puff = vec3<f32>(middle.w, puff.radius, 1.0 - exp(-puff.depth));
    let key = key_light(puff.position * frame.metres_per_unit);
    out.light = WHITENESS * (ambient_light(0.0) + 0.5 * key.light);
    return out;
}

@fragment
fn fragment(in: Varyings, @builtin(view_index) eye: u32) -> @location(0) vec4<f32> {
    let square = dot(in.place, in.place);
    let behind = frame.views[eye].near / max(textureLoad(depth, vec2<i32>(in.clip.xy), eye, 0), 1e-9);
    // A ball's share before what is behind it, from its back to its front.
    let before = saturate(0.5 + 0.5 * (behind - in.puff.x) / in.puff.y);
    let soft = max(1.0 - square, 0.0);
    let opacity = in.puff.z * soft * soft * before;
    return vec4<f32>(display(in.light) * opacity, opacity);
}
