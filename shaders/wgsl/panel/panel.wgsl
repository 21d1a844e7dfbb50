//! Triangles of a user interface, textured and cut to a rectangle. Colours are sRGB-encoded and
//! premultiplied and blended so, as the interface's own texts are made for.

struct PanelDraw {
    /// Rectangle that is drawn within: left, upper, right, lower edge, pixels.
    clip: vec4<f32>,
    /// Width and height of the picture, pixels.
    size: vec2<f32>,
    /// Width and height of the texture.
    texels: vec2<u32>,
}

var<immediate> panel: PanelDraw;

/// Five words a vertex: place (pixels), place in the texture (0 to 1), colour (RGBA, 8 bits each).
@group(0) @binding(0) var<storage, read> vertices: array<u32>;
/// RGBA, 8 bits each, row by row.
@group(0) @binding(1) var<storage, read> texture: array<u32>;

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) place: vec2<f32>,
    @location(1) colour: vec4<f32>,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Varyings {
    let first = 5u * index;
    let at = vec2<f32>(bitcast<f32>(vertices[first]), bitcast<f32>(vertices[first + 1u]));
    let place = vec2<f32>(bitcast<f32>(vertices[first + 2u]), bitcast<f32>(vertices[first + 3u]));
    let clip = 2.0 * at / panel.size - 1.0;
    return Varyings(vec4<f32>(clip, 0.0, 1.0), place, unpack4x8unorm(vertices[first + 4u]));
}

fn texel(at: vec2<i32>) -> vec4<f32> {
    let last = vec2<i32>(panel.texels) - 1;
    let inside = vec2<u32>(clamp(at, vec2<i32>(0), last));
    return unpack4x8unorm(texture[inside.y * panel.texels.x + inside.x]);
}

@fragment
fn fragment(in: Varyings) -> @location(0) vec4<f32> {
    let at = in.clip.xy;
    if any(at < panel.clip.xy) || any(at > panel.clip.zw) {
        discard;
    }
    let place = in.place * vec2<f32>(panel.texels) - 0.5;
    let low = floor(place);
    let part = place - low;
    let first = vec2<i32>(low);
    let upper = mix(texel(first), texel(first + vec2<i32>(1, 0)), part.x);
    let lower = mix(texel(first + vec2<i32>(0, 1)), texel(first + vec2<i32>(1, 1)), part.x);
    return in.colour * mix(upper, lower, part.y);
}
