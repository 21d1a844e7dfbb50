//! Finishes the picture where it has edges or steam: smooths edges along their direction, after T. Lottes's FXAA
//! (2009, the short form): rims, silhouettes and the bench's edge, whatever they are of; and lays steam
//! over that, which has no edges.

//!include common/picture/tile_pixels.wgsl
//!include common/picture/under_steam.wgsl

/// Whether the class's tiles have steam.
override STEAM: bool = false;

@group(0) @binding(2) var drawn: texture_2d_array<f32>;
@group(0) @binding(3) var between: sampler;
@group(0) @binding(9) var finished: texture_storage_2d_array<rgba8unorm, write>;

/// Contrast below which there is no edge, encoded as the eye takes it.
const FAINTEST = 0.03;
/// Longest way along an edge, pixels.
const SPAN = 8.0;

/// Green alone stands for brightness (x); and alpha.
fn brightness(pixel: vec2<i32>, eye: u32) -> vec2<f32> {
    return textureLoad(drawn, within_picture(pixel), eye, 0).ga;
}

fn tap(place: vec2<f32>, eye: u32) -> vec4<f32> {
    let within = clamp(place, vec2<f32>(0.5), frame.extent - 0.5);
    return textureSampleLevel(drawn, between, within / frame.held, eye, 0.0);
}

fn smoothed(pixel: vec2<i32>, eye: u32) -> vec4<f32> {
    let here = textureLoad(drawn, pixel, eye, 0);
    let at_a = brightness(pixel + vec2<i32>(-1, -1), eye);
    let at_b = brightness(pixel + vec2<i32>(1, -1), eye);
    let at_c = brightness(pixel + vec2<i32>(-1, 1), eye);
    let at_d = brightness(pixel + vec2<i32>(1, 1), eye);
    // Within the panel edges are those of its text.
    if (here.a + at_a.y + at_b.y + at_c.y + at_d.y == 0.0) { return here; }
    let a = at_a.x;
    let b = at_b.x;
    let c = at_c.x;
    let d = at_d.x;
    let least = min(here.g, min(min(a, b), min(c, d)));
    let most = max(here.g, max(max(a, b), max(c, d)));
    if most - least < FAINTEST {
        return here;
    }
    // Along the edge: at right angles to the gradient.
    var along = vec2<f32>(c + d - a - b, a + c - b - d);
    let blur = max((a + b + c + d) * 0.03, 1.0 / 128.0);
    along = clamp(along / (min(abs(along.x), abs(along.y)) + blur), vec2<f32>(-SPAN), vec2<f32>(SPAN));
    let place = vec2<f32>(pixel) + 0.5;
    let near = 0.5 * (tap(place - along / 6.0, eye) + tap(place + along / 6.0, eye));
    let wide = 0.5 * near + 0.25 * (tap(place - 0.5 * along, eye) + tap(place + 0.5 * along, eye));
    return select(wide, near, wide.g < least || wide.g > most);
}

@compute @workgroup_size(32, 8)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_id) local: vec3<u32>) {
    let place = place_of(group, local);
    if (!place.inside) { return; }
    var colour = smoothed(place.pixel, place.eye);
    if (STEAM) { colour = under_steam(colour, place); }
    textureStore(finished, place.pixel, place.eye, colour);
}
