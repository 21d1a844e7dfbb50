//! The panel's image, and the light of a place on it.

//!include common/picture/encode.wgsl

/// sRGB-encoded.
@group(0) @binding(12) var panel: texture_2d_array<f32>;
@group(0) @binding(13) var between: sampler;

/// Places in a pixel that are sampled: each filters over two texels, so that up to four texels a pixel count.
const TAPS = array<vec2<f32>, 4>(
    vec2<f32>(0.125, 0.375),
    vec2<f32>(-0.375, 0.125),
    vec2<f32>(-0.125, -0.375),
    vec2<f32>(0.375, -0.125),
);

/// The panel's light, as displayed; `at` is from its middle to the right and up, over half its sides.
fn panel_light(at: vec2<f32>) -> vec3<f32> {
    let place = vec2<f32>(0.5, 0.5) + vec2<f32>(0.5, -0.5) * at;
    return decoded(textureSampleLevel(panel, between, place, 0u, 0.0).rgb);
}
