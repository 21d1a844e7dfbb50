//! Splashes of acid on the user's goggles: too near the eye to be sharp, and where no one looks straight through.

//!include common/picture/frame.wgsl

const SPLASHES = 6u;
/// Where they are, from the outer edge of an eye's picture to its nose and from its top down, over width and height; and their
/// radii over the height. Ours.
const SPLASHED = array<vec3<f32>, 6>(
    vec3<f32>(0.24, 0.22, 0.11),
    vec3<f32>(0.80, 0.70, 0.13),
    vec3<f32>(0.14, 0.62, 0.14),
    vec3<f32>(0.62, 0.14, 0.09),
    vec3<f32>(0.38, 0.82, 0.12),
    vec3<f32>(0.90, 0.34, 0.10),
);
/// What their middle lets through of red, green and blue: charred plastic. Ours.
const LETS_THROUGH = vec3<f32>(0.34, 0.22, 0.11);

/// The share of red, green and blue light that comes through the goggles at a place of the picture (pixels).
fn through_goggles(eye: u32, at: vec2<f32>) -> vec3<f32> {
    if (frame.goggles <= 0.0) { return vec3<f32>(1.0); }
    let part = frame.views[eye].in_picture;
    var place = part.xy + part.zw * (at / frame.extent);
    // The right eye's goggles are the left one's mirror image.
    if (eye == 1u) { place.x = 1.0 - place.x; }
    let aspect = (frame.extent.x / frame.extent.y) * (part.w / part.z);
    var open = vec3<f32>(1.0);
    for (var n = 0u; n < SPLASHES; n++) {
        let splash = SPLASHED[n];
        let there = saturate(frame.goggles * f32(SPLASHES) - f32(n));
        let apart = length((place - splash.xy) * vec2<f32>(aspect, 1.0)) / splash.z;
        open *= mix(vec3<f32>(1.0), LETS_THROUGH, there * smoothstep(1.0, 0.35, apart));
    }
    return open;
}
