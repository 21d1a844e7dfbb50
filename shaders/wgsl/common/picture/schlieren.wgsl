//! Schlieren: where acid and water mix, the index of the liquid changes from place to place, and what is behind is seen bent. That is what a
//! chemist sees of two clear liquids that mix.
//!
//! A ray through a liquid of index n turns by ∫ ∇n ds / n, of ∇n the part across it. Along an eye's straight ray the sums of thickness have the
//! acid's column, so its share a is a mean along that ray, and what ∫ ∇n ds is across it: n's slope with acid, times the thickness, times
//! the slope of a over the picture. The share and not the column: of a column the liquid's own outline makes a slope too, which is the
//! surface's to refract. Of a liquid that is mixed all shares are the same, and nothing is bent, however its particles lie.

//!include common/picture/frame.wgsl
//!include common/picture/thickness_sums.wgsl

/// What acid adds to the refractive index by its mass: sulfuric acid of 98 % has 1.4305, water at 20 °C 1.333.
const INDEX_OF_ACID = 0.0995;
/// How far to either side shares are compared, in spacings: what is finer than the mean distance of particles is their grain.
const STRIA = 1.0;
/// The same in pixels, at least: a block of the sums has two.
const FINEST_STRIA = 2.0;
/// Thickness there over that here, the less over the more, from which on a place counts, and does so wholly: else it is another body of
/// liquid, or this one's outline.
const SAME_BODY = vec2<f32>(0.4, 0.7);
/// Shares of acid in which a difference is looked for.
const MIXED = vec2<f32>(0.002, 0.998);

/// What a way through a mixing liquid has of a slope of its acid's share.
struct Striae {
    /// Across an eye's ray, in the stage.
    slope: vec3<f32>,
    /// How long it is in the liquid.
    way: f32,
}

/// The acid's share at a place, less `share`; 0 where it is no place of a liquid that is `here` thick.
fn difference_at(place: vec2<f32>, eye: u32, here: f32, share: f32) -> f32 {
    let there = thickness_near(place, eye);
    let alike = min(there.x, here) / max(max(there.x, here), 1e-9);
    return smoothstep(SAME_BODY.x, SAME_BODY.y, alike) * (there.y / max(there.x, 1e-9) - share);
}

/// The slope at a place (pixels) where thickness and acid are `here`, behind the view depth `depth`, and `way` of liquid.
fn striae_at(place: vec2<f32>, eye: u32, here: vec2<f32>, depth: f32, way: f32) -> Striae {
    let share = here.y / max(here.x, 1e-9);
    if (share < MIXED.x || share > MIXED.y) { return Striae(vec3<f32>(0.0), way); }
    let middle = depth + 0.5 * here.x;
    let step = max(STRIA * frame.spacing * frame.views[eye].focal / middle, FINEST_STRIA);
    // At the corners of a square: each difference is between means of two.
    let a = difference_at(place + vec2<f32>(step, step), eye, here.x, share);
    let b = difference_at(place + vec2<f32>(-step, -step), eye, here.x, share);
    let c = difference_at(place + vec2<f32>(step, -step), eye, here.x, share);
    let d = difference_at(place + vec2<f32>(-step, step), eye, here.x, share);
    let per_pixel = vec2<f32>(a - b + c - d, a - b - c + d) / (4.0 * step);
    return Striae(slope_across(per_pixel, seen_along(eye, place), middle, eye), way);
}

/// A slope in the stage from what is gained per pixel to the right and down, at a view depth: along the ray (of view depth 1)
/// nothing is.
fn slope_across(per_pixel: vec2<f32>, along: vec3<f32>, depth: f32, eye: u32) -> vec3<f32> {
    let across = frame.views[eye].across;
    let down = frame.views[eye].down;
    let rightwards = cross(down, along);
    let downwards = cross(along, across);
    return (per_pixel.x * rightwards + per_pixel.y * downwards) / (depth * dot(across, rightwards));
}

/// By what a ray of unit length in a liquid of that share and index turns, in the stage.
///
/// Where the index changes along one axis, n cos θ is kept. So a ray that grazes a layer turns by √(2 Δn/n) at most, however sharp that
/// is: then it has left it. There is no more of Δn than what is left to pure acid.
fn turned_by(striae: Striae, direction: vec3<f32>, acid: f32, index: f32) -> vec3<f32> {
    let across = striae.slope - dot(striae.slope, direction) * direction;
    let turn = INDEX_OF_ACID * striae.way / index * across;
    let most = 2.0 * INDEX_OF_ACID * (1.0 - acid) / index;
    let square = dot(turn, turn) / max(most, 1e-9);
    // Less by 1.5 % at half of the bound.
    return turn * inverseSqrt(sqrt(1.0 + square * square));
}
