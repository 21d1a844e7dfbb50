//! How the picture is kept: in the sRGB encoding (IEC 61966-2-1), eight bits a channel. An image that a
//! compute shader writes cannot do it by itself.

/// `light` is linear, 0 to 1.
fn encoded(light: vec3<f32>) -> vec3<f32> {
    let curve = 1.055 * pow(max(light, vec3<f32>(0.0031308)), vec3<f32>(1.0 / 2.4)) - 0.055;
    return select(curve, 12.92 * light, light < vec3<f32>(0.0031308));
}

fn decoded(code: vec3<f32>) -> vec3<f32> {
    return select(pow((code + 0.055) / 1.055, vec3<f32>(2.4)), code / 12.92, code < vec3<f32>(0.04045));
}

/// ±0.5 of a step of eight bits, so that the walls' slow gradients do not band; interleaved gradient
/// noise (J. Jimenez, 2014).
fn dither(pixel: vec2<f32>) -> f32 {
    return (fract(52.9829189 * fract(dot(pixel, vec2<f32>(0.06711056, 0.00583715)))) - 0.5) / 255.0;
}
