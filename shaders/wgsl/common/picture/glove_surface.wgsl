//! A glove's surface: the smooth union of a hand's bones. Distances to it are bounds from below, so that a ray
//! may go as far as one says.
//!
//! Of all bones the two that are nearest count, so that their order does not: least and greatest of two numbers do
//! not depend on it, to the last bit, and a sum over all would.

//!include common/picture/bones.wgsl

/// A bone as rays meet it, in a frame whose origin is the eye.
struct Cone {
    /// The end of radius `radius`.
    end: vec3<f32>,
    radius: f32,
    /// Towards the other end, of length one.
    axis: vec3<f32>,
    /// To the other end.
    length: f32,
    /// What the radius loses along the axis, and that over its cosine: the sine and tangent of half the cone's angle.
    sine: f32,
    tangent: f32,
    /// The greater radius.
    greatest: f32,
}

/// Those of hands and tools, in the order of the bones, for the pixels of a workgroup.
var<workgroup> cones: array<Cone, 96>;

fn cone_of(bone: Bone, eye: vec3<f32>) -> Cone {
    let along = bone.b - bone.a;
    let apart = length(along);
    // Where one sphere nearly holds the other, the hull is hardly more than the greater one.
    let is_ball = abs(bone.radius_a - bone.radius_b) >= 0.99 * apart;
    let a_is_greater = bone.radius_a >= bone.radius_b;
    let sine = select((bone.radius_a - bone.radius_b) / apart, 0.0, is_ball);
    let greatest = max(bone.radius_a, bone.radius_b);
    return Cone(
        select(bone.b, bone.a, a_is_greater || !is_ball) - eye,
        select(bone.radius_a, greatest, is_ball),
        select(along / apart, vec3<f32>(1.0, 0.0, 0.0), is_ball),
        select(apart, 0.0, is_ball),
        sine,
        sine / sqrt(1.0 - sine * sine),
        greatest,
    );
}

/// From the axis's nearest sphere to `at`: the way, of which the length less the radius there is the distance.
struct Way {
    from_axis: vec3<f32>,
    distance: f32,
}

/// Spheres along the axis envelop the cone, and the one whose surface is nearest is where the sphere's radius
/// changes as the distance does.
fn way_from(cone: Cone, at: vec3<f32>) -> Way {
    let from_end = at - cone.end;
    let along = dot(from_end, cone.axis);
    let aside = length(from_end - along * cone.axis);
    let place = clamp(along - aside * cone.tangent, 0.0, cone.length);
    let from_axis = from_end - place * cone.axis;
    return Way(from_axis, length(from_axis) - (cone.radius - place * cone.sine));
}

/// The distance that two make together: I. Quilez's quadratic smooth minimum.
fn joined_at(nearest: f32, second: f32) -> f32 {
    let near = max(1.0 - (second - nearest) / run.joined, 0.0);
    return nearest - ADDED * run.joined * near * near;
}

/// Distance to a hand's surface, of those of its bones whose bits are set.
fn hand_distance(hand: u32, bits: u32, at: vec3<f32>) -> f32 {
    var nearest = 1e9;
    var second = 1e9;
    for (var rest = bits; rest != 0u; rest &= rest - 1u) {
        let distance = way_from(cones[BONES * hand + firstTrailingBit(rest)], at).distance;
        second = min(second, max(nearest, distance));
        nearest = min(nearest, distance);
    }
    return joined_at(nearest, second);
}

/// How far a ray may go.
struct Stride {
    /// Distance to the surface here.
    distance: f32,
    /// There is no surface before so far along the ray; 1e9 where there is none any more.
    free: f32,
    /// The surface is where that ends but for how distances curve on the way: nothing else made it shorter.
    is_straight: bool,
}

/// What a tangent says of where a falling distance is 0; 1e9 where it rises.
fn root_of(distance: f32, slope: f32) -> f32 {
    return select(1e9, distance / max(-slope, 1e-9), slope < 0.0);
}

/// A bone's distance (x), and its slope along a ray (y).
fn fall_to(cone: Cone, at: vec3<f32>, ray: vec3<f32>) -> vec2<f32> {
    let way = way_from(cone, at);
    return vec2<f32>(way.distance, dot(way.from_axis, ray) * inverseSqrt(dot(way.from_axis, way.from_axis)));
}

/// Where two that change along their tangents make together 0; 1e9 where they never do. The smooth minimum of two lines is concave,
/// so from above 0 it comes there once at most. There either one counts alone, or both do.
fn root_of_both(one: vec2<f32>, other: vec2<f32>) -> f32 {
    // With mean u and difference v it is u − k/4 − v²/4k, which is quadratic in the way; here 4k times that is c + b t − a t².
    let apart = other - one;
    let a = apart.y * apart.y;
    let b = 2.0 * (run.joined * (one.y + other.y) - apart.x * apart.y);
    let c = 2.0 * run.joined * (one.x + other.x) - run.joined * run.joined - apart.x * apart.x;
    let root = sqrt(max(b * b + 4.0 * a * c, 0.0));
    // The later one of two roots, without a difference of what is nearly the same.
    let together = select(2.0 * c / max(root - b, 1e-12), (root + b) / max(2.0 * a, 1e-12), b > 0.0);
    let alone = root_of(one.x, one.y);
    let other_alone = root_of(other.x, other.y);
    let free = select(max(together, 0.0), other_alone, one.x + one.y * other_alone >= run.joined);
    return select(free, alone, other.x + other.y * alone >= run.joined);
}

/// What a stride is made of: distances and slopes of the three nearest bones, and what the others say.
struct Falls {
    nearest: vec2<f32>,
    second: vec2<f32>,
    third: vec2<f32>,
    /// Of the others that are close the least distance and the steepest slope.
    others: vec2<f32>,
    /// Where the first of those that are not may begin to have an effect.
    effect: f32,
    /// Where the first bone of all may be so close that what is added may bring the surface there.
    within_added: f32,
}

/// How close a bone must be, over the distance of joining, to be looked at together with others.
const CROWD = 1.5;

fn with_fall(before: Falls, fall: vec2<f32>) -> Falls {
    var falls = before;
    let is_nearest = fall.x < before.nearest.x;
    let is_second = fall.x < before.second.x;
    let is_third = fall.x < before.third.x;
    let other = select(fall, before.third, is_third);
    falls.third = select(before.third, select(fall, before.second, is_second), is_third);
    falls.second = select(before.second, select(fall, before.nearest, is_nearest), is_second);
    falls.nearest = select(before.nearest, fall, is_nearest);
    // One that rises is nearly never there.
    let added = max(fall.x - ADDED * run.joined, 0.0) / max(-fall.y, 1e-9);
    let effect = (other.x - EFFECT * run.joined) / max(-other.y, 1e-9);
    let is_close = other.x < CROWD * run.joined;
    falls.within_added = min(before.within_added, added);
    falls.effect = min(before.effect, select(effect, 1e9, is_close));
    falls.others = min(before.others, select(vec2<f32>(1e9, 0.0), other, is_close));
    return falls;
}

/// As `hand_distance`, and how far the ray may go from there: further than the distance, by the slopes.
///
/// The distance to a bone is convex along a ray, so it stays above its tangent. What two make together falls with each of them, so
/// it stays above what their tangents make, and the surface is no nearer than the first root of any two of those. Of the
/// three nearest bones each two are looked at. The others that are close count as one, which is as near as the nearest of them and falls as
/// the steepest; those that are not close count from where they have an effect. None of these matters before
/// some bone is so close that what is added may bring the surface. So a ray that meets the surface is there after a few strides,
/// in creases too, and one that passes by it closely knows it as soon as the distances rise.
fn stride_at(hand: u32, bits: u32, at: vec3<f32>, ray: vec3<f32>) -> Stride {
    if (bits == 0u) { return Stride(1e9, 1e9, false); }
    let none = vec2<f32>(1e9, 0.0);
    var falls = Falls(none, none, none, none, 1e9, 1e9);
    for (var rest = bits; rest != 0u; rest &= rest - 1u) {
        falls = with_fall(falls, fall_to(cones[BONES * hand + firstTrailingBit(rest)], at, ray));
    }
    let nearest = falls.nearest;
    let second = falls.second;
    let third = falls.third;
    let others = falls.others;
    let close = CROWD * run.joined;
    var straight = root_of_both(nearest, second);
    var free = falls.effect;
    if (third.x < close) {
        straight = min(straight, min(root_of_both(nearest, third), root_of_both(second, third)));
    } else {
        free = min(free, root_of(third.x - EFFECT * run.joined, third.y));
    }
    if (others.x < close) {
        free = min(free, min(root_of_both(nearest, others), root_of_both(second, others)));
        free = min(free, min(root_of_both(third, others), root_of(others.x - ADDED * run.joined, others.y)));
    }
    free = max(free, falls.within_added);
    let distance = joined_at(nearest.x, second.x);
    return Stride(distance, max(min(straight, free), distance), straight <= free);
}

/// A place of the surface.
struct GlovePlace {
    normal: vec3<f32>,
    /// What it is of, and how much it shines by itself.
    tint: vec3<f32>,
    glow: f32,
}

/// How far a bone has an effect on how the surface next to it is lit, over the distance of joining: further than on its
/// shape, so that palm and back are even.
const EVEN = 1.75;
/// Parts of one in the sums, which are of integers, so that the bones' order does not matter.
const PARTS = 1048576.0;

/// The surface's normal and kind at a place on it: of all bones that are near.
fn hand_place(hand: u32, bits: u32, at: vec3<f32>) -> GlovePlace {
    var sums = vec3<i32>(0);
    var tints = vec4<i32>(0);
    var all = 0;
    for (var rest = bits; rest != 0u; rest &= rest - 1u) {
        let n = BONES * hand + firstTrailingBit(rest);
        let way = way_from(cones[n], at);
        let near = saturate(1.0 - way.distance / (EVEN * run.joined));
        let share = near * near * PARTS;
        sums += vec3<i32>(round(share * normalize(way.from_axis)));
        tints += vec4<i32>(round(share * vec4<f32>(bones[n].tint, bones[n].glow)));
        all += i32(round(share));
    }
    let tint = vec4<f32>(tints) / f32(max(all, 1));
    return GlovePlace(normalize(vec3<f32>(sums)), tint.rgb, tint.a);
}
