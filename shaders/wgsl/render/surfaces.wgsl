//! Bench, floor and walls in daylight, with the soft shadows of the vessels.

//!include common/mesh.wgsl
//!include common/bench.wgsl

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) @interpolate(flat) material: u32,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(view_index) eye: u32) -> Varyings {
    let corner = vertices[index];
    return Varyings(
        frame.views[eye].clip_from_stage * vec4<f32>(corner.position, 1.0),
        corner.position,
        corner.normal,
        corner.material,
    );
}

/// ±0.5 of an 8-bit step of the sRGB encoding, so that the walls' slow gradients do not band;
/// interleaved gradient noise (J. Jimenez, 2014).
fn dither(pixel: vec2<f32>, light: vec3<f32>) -> vec3<f32> {
    let noise = fract(52.9829189 * fract(dot(pixel, vec2<f32>(0.06711056, 0.00583715)))) - 0.5;
    // The encoding's slope, about 1 / (2√light).
    return light + noise * (2.0 / 255.0) * sqrt(light);
}

@fragment
fn fragment(in: Varyings) -> @location(0) vec4<f32> {
    let light = display(bench_light(in.position, in.normal, in.material));
    return vec4<f32>(dither(in.clip.xy, light), 1.0);
}
