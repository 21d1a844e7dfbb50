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
    cuff: f32,
}

/// Those of both hands, in the order of the bones, for the pixels of a workgroup.
var<workgroup> cones: array<Cone, 56>;

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
        bone.cuff,
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

/// Where two that fall along their tangents make together 0, at the earliest; `near` is the nearer one.
fn root_of_both(near: vec2<f32>, far: vec2<f32>) -> f32 {
    let effect = EFFECT * run.joined;
    let apart = far.x - near.x;
    if (apart >= run.joined) {
        let alone = min(root_of(near.x, near.y), root_of(far.x - effect, far.y));
        return select(root_of(near.x, min(near.y, far.y)), alone, far.x > effect);
    }
    // With mean u and difference v, the smooth minimum is u − k/4 − v²/4k, which is quadratic in the way.
    let v = far.y - near.y;
    let b = 2.0 * apart * v - 2.0 * run.joined * (near.y + far.y);
    let c = 4.0 * run.joined * max(joined_at(near.x, far.x), 0.0);
    return 2.0 * c / max(b + sqrt(b * b + 4.0 * v * v * c), 1e-12);
}

/// As `hand_distance`, and how far the ray may go from there: further than the distance, by the slopes.
///
/// The distance to a bone is convex along a ray, so it stays above its tangent, and two joined stay above what their
/// tangents make together. That holds for each pair of the three nearest. Of the others one that is not close has no effect
/// before its tangent says that it may; with one that is close, all together fall no faster than the steepest. So a
/// ray that meets the surface is there after a few strides, and one that passes by it closely knows it as soon as
/// the distances rise.
fn stride_at(hand: u32, bits: u32, at: vec3<f32>, ray: vec3<f32>) -> Stride {
    if (bits == 0u) { return Stride(1e9, 1e9); }
    let effect = EFFECT * run.joined;
    let close = effect + ADDED * run.joined;
    var a = vec2<f32>(1e9, 0.0);
    var b = a;
    var c = a;
    var is_crowded = false;
    var steepest = 0.0;
    var free = 1e9;
    for (var rest = bits; rest != 0u; rest &= rest - 1u) {
        let fall = fall_to(cones[BONES * hand + firstTrailingBit(rest)], at, ray);
        let before_a = fall.x < a.x;
        let before_b = fall.x < b.x;
        let before_c = fall.x < c.x;
        let other = select(fall, c, before_c);
        c = select(c, select(fall, b, before_b), before_c);
        b = select(b, select(fall, a, before_a), before_b);
        a = select(a, fall, before_a);
        if (other.x > close) {
            free = min(free, root_of(other.x - effect, other.y));
        } else {
            is_crowded = true;
            steepest = min(steepest, other.y);
        }
    }
    let distance = joined_at(a.x, b.x);
    free = min(free, root_of_both(a, b));
    if (c.x > close) {
        free = min(free, root_of(c.x - effect, c.y));
    } else {
        free = min(free, min(root_of_both(a, c), root_of_both(b, c)));
    }
    if (is_crowded) { free = min(free, root_of(distance, min(min(steepest, a.y), min(b.y, c.y)))); }
    return Stride(distance, max(free, distance));
}

/// A place of the surface.
struct GlovePlace {
    normal: vec3<f32>,
    /// How much of it is cuff, 0 to 1.
    cuff: f32,
}

/// How far a bone has an effect on how the surface next to it is lit, over the distance of joining: further than on its
/// shape, so that palm and back are even.
const EVEN = 1.75;
/// Parts of one in the sums, which are of integers, so that the bones' order does not matter.
const PARTS = 1048576.0;

/// The surface's normal and kind at a place on it: of all bones that are near.
fn hand_place(hand: u32, bits: u32, at: vec3<f32>) -> GlovePlace {
    var sums = vec4<i32>(0);
    var all = 0;
    for (var rest = bits; rest != 0u; rest &= rest - 1u) {
        let cone = cones[BONES * hand + firstTrailingBit(rest)];
        let way = way_from(cone, at);
        let near = saturate(1.0 - way.distance / (EVEN * run.joined));
        let share = near * near * PARTS;
        sums += vec4<i32>(round(share * vec4<f32>(normalize(way.from_axis), cone.cuff)));
        all += i32(round(share));
    }
    return GlovePlace(normalize(vec3<f32>(sums.xyz)), f32(sums.w) / f32(max(all, 1)));
}
