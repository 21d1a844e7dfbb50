//! The narrow-range filter (N. Truong & C. Yuksel, 2018) of reversed depth: a Gaussian that
//! leaves out what is nearer by more than a threshold, and takes what is further for little
//! further, so that bodies of liquid in front of each other stay apart. Two passes along rows and
//! columns, and a small one over a square.
//!
//! Over theirs: it runs on reversed depth, near / z, of which a plane's is linear in the picture
//! as its distance is not; so a plane that slants keeps its place exactly. And a pair of pixels,
//! right and left, counts only if both have liquid, so that silhouettes do not pull.

//!include common/picture/at_glass.wgsl
//!include common/picture/tile_pixels.wgsl

/// 0: along rows; 1: along columns; 2: over a square; 3: no filter.
override PASS: u32 = 0u;
/// Whether this is the last pass.
override LAST: bool = false;

/// Reversed depth of the liquid, 0 where there is none; zero outside of the listed tiles.
@group(0) @binding(2) var<storage, read> before: array<f32>;
@group(0) @binding(3) var<storage, read_write> after: array<f32>;

/// How far the filter reaches, in spacings.
const REACH = 2.0;
/// Pairs of samples at most: further apart than neighbouring pixels if it reaches further.
const PAIRS = 24.0;
/// Depth difference, in spacings, beyond which something is in front; and how much further,
/// in spacings, what is behind is taken to be. Theirs are 10.5 and 1 particle radii (6.5 and 0.62
/// spacings): where liquid boils, so wide a range draws combs across its waves.
const THRESHOLD = 1.2;
const BEHIND = 0.6;

fn load(pixel: vec2<i32>, eye: u32) -> f32 {
    return before[pixel_index(within_picture(pixel), eye)];
}

var<private> sum: f32;
var<private> weights: f32;
var<private> nearest: f32;
var<private> furthest: f32;

/// Adds a pair at `offset` pixels to either side.
fn add_pair(pixel: vec2<i32>, eye: u32, offset: vec2<i32>, middle: f32, width: f32, behind: f32, weight: f32) {
    let a = load(pixel + offset, eye);
    let b = load(pixel - offset, eye);
    let fits = min(a, b) > 0.0 && max(a, b) <= nearest;
    let kept = select(vec2<f32>(behind), vec2<f32>(a, b), vec2<f32>(a, b) >= vec2<f32>(furthest));
    let w = select(0.0, weight, fits);
    sum += w * (kept.x + kept.y);
    weights += 2.0 * w;
    // The range follows the surface as it walks along it.
    nearest = select(nearest, max(nearest, max(kept.x, kept.y) + width), fits);
    furthest = select(furthest, min(furthest, min(kept.x, kept.y) - width), fits);
}

/// The smoothed reversed depth of a pixel of liquid.
fn smoothed(pixel: vec2<i32>, eye: u32, middle: f32) -> f32 {
    if (PASS == 3u) { return middle; }
    let near = frame.views[eye].near;
    // A difference of view depth as one of reversed depth: near/z² of it.
    let per_length = middle * middle / near;
    let width = THRESHOLD * frame.spacing * per_length;
    let behind = middle - BEHIND * frame.spacing * per_length;
    nearest = middle + width;
    furthest = middle - width;
    sum = middle;
    weights = 1.0;
    let reach = REACH * frame.spacing * frame.views[eye].focal * middle / near;
    if (PASS == 2u) {
        // Half of the square: each pair once.
        add_pair(pixel, eye, vec2<i32>(1, 0), middle, width, behind, 0.6);
        add_pair(pixel, eye, vec2<i32>(0, 1), middle, width, behind, 0.6);
        add_pair(pixel, eye, vec2<i32>(1, 1), middle, width, behind, 0.36);
        add_pair(pixel, eye, vec2<i32>(1, -1), middle, width, behind, 0.36);
    } else {
        let pairs = clamp(reach, 1.0, PAIRS);
        let stride = max(reach / pairs, 1.0);
        for (var k = 1.0; k <= pairs; k += 1.0) {
            let step = i32(k * stride + 0.5);
            let x = f32(step) / max(reach, 1.0);
            // A Gaussian whose second moment is a ninth of the reach's square.
            let weight = exp2(-6.5 * x * x);
            let offset = select(vec2<i32>(step, 0), vec2<i32>(0, step), PASS == 1u);
            add_pair(pixel, eye, offset, middle, width, behind, weight);
        }
    }
    return sum / weights;
}

@compute @workgroup_size(32, 8)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_id) local: vec3<u32>) {
    let place = place_of(group, local);
    if (!place.inside) { return; }
    let middle = load(place.pixel, place.eye);
    var reversed = 0.0;
    if (middle > 0.0) {
        reversed = smoothed(place.pixel, place.eye, middle);
        if (LAST) { reversed = at_glass(reversed, vec2<f32>(place.pixel) + 0.5, place.eye); }
    }
    after[pixel_index(place.pixel, place.eye)] = reversed;
}
