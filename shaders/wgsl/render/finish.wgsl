//! Finishes the picture where it has edges or steam: smooths edges along their direction, after T. Lottes's FXAA
//! (2009, the short form): rims, silhouettes and the bench's edge, whatever they are of; and lays steam
//! over that, which has no edges.

//!include common/picture/encode.wgsl
//!include common/picture/steam_light.wgsl
//!include common/picture/tile_pixels.wgsl

/// Whether the class's tiles have steam.
override STEAM: bool = false;

@group(0) @binding(2) var drawn: texture_2d_array<f32>;
@group(0) @binding(3) var between: sampler;
@group(0) @binding(9) var finished: texture_storage_2d_array<rgba8unorm, write>;

/// Contrast below which there is no edge, encoded as the eye takes it.
const FAINTEST = 0.03;
/// Longest way along an edge, pixels.
const SPAN = 8.0;

/// Green alone stands for brightness.
fn brightness(pixel: vec2<i32>, eye: u32) -> f32 {
    return textureLoad(drawn, within_picture(pixel), eye, 0).g;
}

fn tap(place: vec2<f32>, eye: u32) -> vec3<f32> {
    let within = clamp(place, vec2<f32>(0.5), frame.extent - 0.5);
    return textureSampleLevel(drawn, between, within / frame.held, eye, 0.0).rgb;
}

fn smoothed(pixel: vec2<i32>, eye: u32) -> vec3<f32> {
    let here = textureLoad(drawn, pixel, eye, 0).rgb;
    let a = brightness(pixel + vec2<i32>(-1, -1), eye);
    let b = brightness(pixel + vec2<i32>(1, -1), eye);
    let c = brightness(pixel + vec2<i32>(-1, 1), eye);
    let d = brightness(pixel + vec2<i32>(1, 1), eye);
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
    if (STEAM) {
        let steam = steam_over(place.pixel, place.eye, place.tile);
        colour = encoded(steam.rgb + steam.a * decoded(colour)) + dither(vec2<f32>(place.pixel) + 0.5);
    }
    textureStore(finished, place.pixel, place.eye, vec4<f32>(colour, 1.0));
}
