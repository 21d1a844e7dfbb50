//! The left eye's picture, or a screen's, as large as a window wants it: each pixel is the mean light of what it covers. A screen's window
//! that is larger than its picture samples the panel once, from its own image, where the picture's alpha leaves it to a layer under it
//! (`common/picture/panel.wgsl`): so text is as sharp as the window.

//!include common/picture/panel_light.wgsl

struct MirrorDraw {
    /// Width and height of the eye's picture, in the upper left corner of its image, pixels.
    drawn: vec2<u32>,
    /// Width and height of the window's picture, pixels.
    extent: vec2<u32>,
    /// From a place in the picture, (x, y, 1) with x and y from 0 to 1 from its upper left, to the place on the panel that is seen there:
    /// from its middle to the right and up, over half its sides, both times the third component. All 0 where the picture shows the panel.
    panel_from_picture: mat4x4<f32>,
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
    var is_panel = any(mirror.panel_from_picture[2] != vec4<f32>(0.0));
    for (var y = floor(low.y); y < high.y; y += 1.0) {
        for (var x = floor(low.x); x < high.x; x += 1.0) {
            let at = vec2<f32>(x, y);
            // Of the texel, the part that lies within.
            let part = min(high, at + 1.0) - max(low, at);
            let weight = part.x * part.y;
            let texel = textureLoad(picture, vec2<i32>(at), 0, 0);
            light += weight * decoded(texel.rgb);
            whole += weight;
            is_panel = is_panel && texel.a == 0.0;
        }
    }
    if (is_panel) {
        light = vec3<f32>(0.0);
        whole = 4.0;
        for (var n = 0u; n < 4u; n++) {
            let place = (vec2<f32>(id.xy) + 0.5 + TAPS[n]) / vec2<f32>(mirror.extent);
            let met = mirror.panel_from_picture * vec4<f32>(place, 1.0, 0.0);
            light += panel_light(met.xy / met.z);
        }
    }
    let code = vec3<u32>(round(255.0 * encoded(light / whole)));
    shrunk[id.y * mirror.extent.x + id.x] = (code.r << 16u) | (code.g << 8u) | code.b;
}
