//! The left eye's picture as large as a window wants it: each pixel is the mean light of what it covers.

//!include common/picture/encode.wgsl

struct MirrorDraw {
    /// Width and height of the eye's picture, in the upper left corner of its image, pixels.
    drawn: vec2<u32>,
    /// Width and height of the window's picture, pixels; at most those of the eye's.
    extent: vec2<u32>,
}

var<immediate> mirror: MirrorDraw;

/// A layer an eye, sRGB-encoded.
@group(0) @binding(0) var picture: texture_2d_array<f32>;
/// 0x00RRGGBB, row by row.
@group(0) @binding(1) var<storage, read_write> shrunk: array<u32>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id.xy >= mirror.extent)) { return; }
    let texels = vec2<f32>(mirror.drawn);
    let covered = texels / vec2<f32>(mirror.extent);
    let low = vec2<f32>(id.xy) * covered;
    let high = min(low + covered, texels);
    var light = vec3<f32>(0.0);
    var whole = 0.0;
    for (var y = floor(low.y); y < high.y; y += 1.0) {
        for (var x = floor(low.x); x < high.x; x += 1.0) {
            let at = vec2<f32>(x, y);
            // Of the texel, the part that lies within.
            let part = min(high, at + 1.0) - max(low, at);
            let weight = part.x * part.y;
            light += weight * decoded(textureLoad(picture, vec2<i32>(at), 0, 0).rgb);
            whole += weight;
        }
    }
    let code = vec3<u32>(round(255.0 * encoded(light / whole)));
    shrunk[id.y * mirror.extent.x + id.x] = (code.r << 16u) | (code.g << 8u) | code.b;
}
