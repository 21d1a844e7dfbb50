//! Smooths edges of the finished picture along their direction, after T. Lottes's FXAA (2009, the
//! short form): rims, silhouettes and the bench's edge, whatever pass they are of.

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    /// Place in the picture, 0 to 1.
    @location(0) place: vec2<f32>,
}

@group(0) @binding(0) var drawn: texture_2d_array<f32>;
@group(0) @binding(1) var between: sampler;

/// Contrast below which there is no edge, in light that is encoded as the eye takes it.
const FAINTEST = 0.03;
/// Longest way along an edge, pixels.
const SPAN = 6.0;

/// One triangle over the whole picture.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Varyings {
    let corner = vec2<f32>(f32((index << 1u) & 2u), f32(index & 2u));
    return Varyings(vec4<f32>(2.0 * corner - 1.0, 0.0, 1.0), corner);
}

/// Encoded brightness; green alone stands for it. A square root is near enough to sRGB's curve.
fn brightness(colour: vec3<f32>) -> f32 {
    return sqrt(colour.g);
}

@fragment
fn fragment(in: Varyings, @builtin(view_index) eye: u32) -> @location(0) vec4<f32> {
    let pixel = vec2<i32>(in.clip.xy);
    let size = vec2<f32>(textureDimensions(drawn).xy);
    let last = vec2<i32>(size) - 1;
    let here = textureLoad(drawn, pixel, eye, 0);
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
    let near = 0.5 * (textureSampleLevel(drawn, between, in.place - along / 6.0, eye, 0.0)
        + textureSampleLevel(drawn, between, in.place + along / 6.0, eye, 0.0));
    let wide = 0.5 * near + 0.25 * (textureSampleLevel(drawn, between, in.place - 0.5 * along, eye, 0.0)
        + textureSampleLevel(drawn, between, in.place + 0.5 * along, eye, 0.0));
    let light = brightness(wide.rgb);
    return select(wide, near, light < least || light > most);
}
