//! Bench, floor and walls in daylight, with the soft shadows of the vessels.
//!
//! They are boxes, and each pixel's ray is traced against them, as those that liquid refracts are.
//! So nothing of them reaches out of the frustum: Mesa's software driver (22.3) loses triangles
//! that it clips, in every view but the first.

//!include common/bench.wgsl

/// Two triangles over the whole picture, at the near plane: nothing they show is nearer.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let right = index == 1u || index == 2u || index == 4u;
    let low = index == 2u || index == 4u || index == 5u;
    let corner = select(vec2<f32>(-1.0), vec2<f32>(1.0), vec2<bool>(right, low));
    return vec4<f32>(corner, 1.0, 1.0);
}

/// ±0.5 of an 8-bit step of the sRGB encoding, so that the walls' slow gradients do not band;
/// interleaved gradient noise (J. Jimenez, 2014).
fn dither(pixel: vec2<f32>, light: vec3<f32>) -> vec3<f32> {
    let noise = fract(52.9829189 * fract(dot(pixel, vec2<f32>(0.06711056, 0.00583715)))) - 0.5;
    // The encoding's slope, about 1 / (2√light).
    return light + noise * (2.0 / 255.0) * sqrt(light);
}

struct Pixel {
    @location(0) colour: vec4<f32>,
    @builtin(frag_depth) depth: f32,
}

@fragment
@early_depth_test(less_equal)
fn fragment(@builtin(position) place: vec4<f32>, @builtin(view_index) eye: u32) -> Pixel {
    // Of view depth 1, so that ways along it are depths.
    let ray = seen_along(eye, place.xy);
    let met = room_meets(frame.views[eye].eye, ray);
    if met.way <= frame.views[eye].near {
        discard;
    }
    let position = frame.views[eye].eye + met.way * ray;
    let light = display(bench_light(position, met.normal, met.material));
    return Pixel(vec4<f32>(dither(place.xy, light), 1.0), frame.views[eye].near / met.way);
}
