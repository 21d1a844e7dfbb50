//! Smooths edges of the finished picture along their direction, after T. Lottes's FXAA (2009, the
//! short form): rims, silhouettes and the bench's edge, whatever pass they are of. It works in
//! the tiles that have any, into a second image, from which they go back.

//!include common/tile.wgsl

/// Whether it only copies.
override COPY: bool = false;

struct Varyings {
    @builtin(position) clip: vec4<f32>,
}

@group(0) @binding(2) var drawn: texture_2d_array<f32>;
@group(0) @binding(3) var between: sampler;

struct EdgeDraw {
    /// Number of eyes.
    views: u32,
}

var<immediate> edges: EdgeDraw;

/// Contrast below which there is no edge, in light that is encoded as the eye takes it.
const FAINTEST = 0.03;
/// Longest way along an edge, pixels.
const SPAN = 8.0;

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(view_index) eye: u32) -> Varyings {
    return Varyings(tile_corner(index, edges.views + eye));
}

/// Encoded brightness; green alone stands for it. A square root is near enough to sRGB's curve.
fn brightness(colour: vec3<f32>) -> f32 {
    return sqrt(colour.g);
}

@fragment
fn fragment(in: Varyings, @builtin(view_index) eye: u32) -> @location(0) vec4<f32> {
    let pixel = vec2<i32>(in.clip.xy);
    let here = textureLoad(drawn, pixel, eye, 0);
    if COPY {
        return here;
    }
    let size = frame.extent;
    let place = in.clip.xy / size;
    let last = vec2<i32>(size) - 1;
    let low = max(pixel - 1, vec2<i32>(0));
    let high = min(pixel + 1, last);
    let a = brightness(textureLoad(drawn, vec2<i32>(low.x, low.y), eye, 0).rgb);
    let b = brightness(textureLoad(drawn, vec2<i32>(high.x, low.y), eye, 0).rgb);
    let c = brightness(textureLoad(drawn, vec2<i32>(low.x, high.y), eye, 0).rgb);
    let d = brightness(textureLoad(drawn, vec2<i32>(high.x, high.y), eye, 0).rgb);
    let m = brightness(here.rgb);
    let least = min(m, min(min(a, b), min(c, d)));
    let most = max(m, max(max(a, b), max(c, d)));
    if most - least < FAINTEST {
        return here;
    }
    // Along the edge: at right angles to the gradient.
    var along = vec2<f32>(c + d - a - b, a + c - b - d);
    let blur = max((a + b + c + d) * 0.03, 1.0 / 128.0);
    along = clamp(along / (min(abs(along.x), abs(along.y)) + blur), vec2<f32>(-SPAN), vec2<f32>(SPAN)) / size;
    let near = 0.5 * (textureSampleLevel(drawn, between, place - along / 6.0, eye, 0.0)
        + textureSampleLevel(drawn, between, place + along / 6.0, eye, 0.0));
    let wide = 0.5 * near + 0.25 * (textureSampleLevel(drawn, between, place - 0.5 * along, eye, 0.0)
        + textureSampleLevel(drawn, between, place + 0.5 * along, eye, 0.0));
    let light = brightness(wide.rgb);
    return select(wide, near, light < least || light > most);
}
