//! One step of screen-space curvature flow (W. van der Laan, S. Green & M. Sainz, 2009), the
//! paper's filter: each depth moves by the mean curvature that the surface has there.
//!
//! With C = 1 / focal length in pixels, D = C²(z_x² + z_y²) + C⁴z² and their Eq. 6 for the
//! divergence of the unit normal. The time is measured in pixels of the surface, squared: a plane
//! that faces the eye then diffuses by `rate` a step, stable below a quarter, and as many steps
//! smooth over a length of the world and not of the picture.

//!include common/picture/at_glass.wgsl
//!include common/picture/tile_pixels.wgsl

/// Whether this is the last step.
override LAST: bool = false;
/// Steps in all.
override STEPS: f32 = 40.0;

/// Reversed depth of the liquid, 0 where there is none; zero outside of the listed tiles.
@group(0) @binding(2) var<storage, read> before: array<f32>;
@group(0) @binding(3) var<storage, read_write> after: array<f32>;

/// Standard deviation of the smoothing, in spacings.
const SMOOTHED = 0.8;
/// Depth difference to a neighbour, in spacings, at which the surface ends.
const EDGE = 2.0;

/// View depth at a pixel; that of the middle where there is another surface or none, so that
/// the derivative across the edge is zero.
fn depth(pixel: vec2<i32>, eye: u32, middle: f32) -> f32 {
    let reversed = before[pixel_index(within_picture(pixel), eye)];
    let z = frame.views[eye].near / max(reversed, 1e-9);
    return select(middle, z, abs(z - middle) < EDGE * frame.spacing);
}

/// The reversed depth of a pixel of liquid a step later.
fn smoothed(pixel: vec2<i32>, eye: u32, z: f32) -> f32 {
    let left = depth(pixel + vec2<i32>(-1, 0), eye, z);
    let right = depth(pixel + vec2<i32>(1, 0), eye, z);
    let above = depth(pixel + vec2<i32>(0, -1), eye, z);
    let below = depth(pixel + vec2<i32>(0, 1), eye, z);
    let corners = depth(pixel + vec2<i32>(1, 1), eye, z) + depth(pixel + vec2<i32>(-1, -1), eye, z)
        - depth(pixel + vec2<i32>(1, -1), eye, z) - depth(pixel + vec2<i32>(-1, 1), eye, z);
    let zx = 0.5 * (right - left);
    let zy = 0.5 * (below - above);
    let zxx = left + right - 2.0 * z;
    let zyy = above + below - 2.0 * z;
    let zxy = 0.25 * corners;

    // In units of the pixel's size on the surface at this depth, s = z / focal.
    let s = z / frame.views[eye].focal;
    let p = zx / s;
    let q = zy / s;
    // The divergence of (p, q) / √(1 + p² + q²): Eq. 6 without the terms by which a pixel's
    // size changes with depth, which are smaller by s / z.
    let slope = 1.0 + p * p + q * q;
    let curvature = ((1.0 + q * q) * zxx - 2.0 * p * q * zxy + (1.0 + p * p) * zyy)
        / (slope * sqrt(slope));
    let pixels = SMOOTHED * frame.spacing / s;
    let rate = min(0.5 * pixels * pixels / STEPS, 0.2);
    return frame.views[eye].near / (z + rate * curvature);
}

@compute @workgroup_size(32, 8)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_id) local: vec3<u32>) {
    let place = place_of(group, local);
    if (!place.inside) { return; }
    let at = pixel_index(place.pixel, place.eye);
    let middle = before[at];
    var reversed = 0.0;
    if (middle > 0.0) {
        reversed = smoothed(place.pixel, place.eye, frame.views[place.eye].near / middle);
        if (LAST) { reversed = at_glass(reversed, vec2<f32>(place.pixel) + 0.5, place.eye); }
    }
    after[at] = reversed;
}
