//! Gloves, what hands point with and hold on to, and tools, as bones: round cones, each the convex hull of two spheres; and where one is seen.

//!include common/picture/frame.wgsl

/// One bone.
struct Bone {
    /// One end's middle, in the stage, in the scene's unit.
    a: vec3<f32>,
    /// Radius there.
    radius_a: f32,
    /// The other end's middle.
    b: vec3<f32>,
    /// Radius there.
    radius_b: f32,
    /// Reflectance of red, green and blue.
    tint: vec3<f32>,
    /// How much it shines by itself instead, 0 to 1.
    glow: f32,
}

struct HandsRun {
    /// Bones of the left hand, of the right one, and of tools.
    counts: vec3<u32>,
    /// Distance over which bones of one hand join smoothly, in the scene's unit.
    joined: f32,
    /// Whether coloured spheres were drawn before.
    over: u32,
    /// The least radius of all bones.
    thinnest: f32,
    /// Which of the tools' bones is a thermometer's stem; one that there is not, for none.
    scale_bone: u32,
    /// How far its lowest mark is from its first end's middle, and one degree's length, in the scene's unit.
    scale_from: f32,
    scale_degree: f32,
    /// Its lowest and highest mark, and what it shows, °C.
    scale_low: f32,
    scale_high: f32,
    reading: f32,
}

var<immediate> run: HandsRun;

/// Most bones of a hand, and of tools; the right one's begin behind so many, and the tools' behind these.
const BONES = 32u;
/// The hands, and the tools, of which one joins another as a hand's bones do.
const GROUPS = 3u;

/// The left hand's bones, then the right one's, then the tools'.
@group(0) @binding(2) var<storage, read> bones: array<Bone>;

/// What the smooth union of two surfaces adds to them at most, over the distance of joining (`joined_at`).
const ADDED = 0.25;
/// How far a bone has an effect on the surface of its hand, over that distance: where another is nearer by
/// more than that distance, it has none, and that one's surface is no further than what is added.
const EFFECT = 1.25;

/// What of the picture a bone may cover.
struct Seen {
    /// The pixels from the first to before the second; none where that is no greater.
    low: vec2<f32>,
    high: vec2<f32>,
    /// It is within this distance of the line from the one place to the other, pixels.
    from_: vec2<f32>,
    to: vec2<f32>,
    reach: f32,
}

/// Least and greatest slope of what a sphere covers along an axis of the picture. `aside` is where its middle is along that
/// axis, `depth` along the eye's.
fn slopes(aside: f32, depth: f32, radius: f32) -> vec2<f32> {
    let root = radius * sqrt(max(aside * aside + depth * depth - radius * radius, 0.0));
    return (vec2<f32>(-root, root) + aside * depth) / (depth * depth - radius * radius);
}

/// What a sphere covers. Its middle is `at` from the eye, `depth` along its axis.
fn sphere_seen(eye: u32, at: vec3<f32>, depth: f32, radius: f32) -> Seen {
    let view = &frame.views[eye];
    let pitch = vec2<f32>(length((*view).across), length((*view).down));
    let right = (*view).across / pitch.x;
    let below = (*view).down / pitch.y;
    let first = vec2<f32>(dot((*view).corner, right), dot((*view).corner, below));
    let aside = vec2<f32>(dot(at, right), dot(at, below));
    let x = slopes(aside.x, depth, radius);
    let y = slopes(aside.y, depth, radius);
    // It is an ellipse whose longer axis points to the middle of the picture.
    let away = length(aside);
    let long = slopes(away, depth, radius);
    let middle = (0.5 * (long.x + long.y) * aside / max(away, 1e-12) - first) / pitch;
    return Seen(
        (vec2<f32>(x.x, y.x) - first) / pitch,
        (vec2<f32>(x.y, y.y) - first) / pitch,
        middle,
        middle,
        0.5 * (long.y - long.x) / min(pitch.x, pitch.y),
    );
}

/// What a bone covers that is `grown` thicker.
fn bone_seen(bone: Bone, eye: u32, grown: f32) -> Seen {
    let view = &frame.views[eye];
    let depth_a = ((*view).clip_from_stage * vec4<f32>(bone.a, 1.0)).w;
    let depth_b = ((*view).clip_from_stage * vec4<f32>(bone.b, 1.0)).w;
    let radius_a = bone.radius_a + grown;
    let radius_b = bone.radius_b + grown;
    // The comparison fails for NaN.
    if !(max(depth_a + radius_a, depth_b + radius_b) > (*view).near) {
        return Seen(vec2<f32>(0.0), vec2<f32>(0.0), vec2<f32>(0.0), vec2<f32>(0.0), 0.0);
    }
    // What reaches through the near plane may be anywhere.
    if (min(depth_a - radius_a, depth_b - radius_b) < (*view).near) {
        return Seen(vec2<f32>(0.0), frame.extent, vec2<f32>(0.0), vec2<f32>(0.0), 1e9);
    }
    let a = sphere_seen(eye, bone.a - (*view).eye, depth_a, radius_a);
    let b = sphere_seen(eye, bone.b - (*view).eye, depth_b, radius_b);
    return Seen(
        clamp(floor(min(a.low, b.low)), vec2<f32>(0.0), frame.extent),
        clamp(ceil(max(a.high, b.high)), vec2<f32>(0.0), frame.extent),
        a.from_,
        b.from_,
        max(a.reach, b.reach) + 1.0,
    );
}

/// Whether what is seen there may reach the pixels from `low` to before `high`.
fn reaches(seen: Seen, low: vec2<f32>, high: vec2<f32>) -> bool {
    let middle = 0.5 * (low + high) - seen.from_;
    let along = seen.to - seen.from_;
    let share = saturate(dot(middle, along) / max(dot(along, along), 1e-12));
    let apart = length(middle - share * along) - 0.5 * length(high - low);
    return all(seen.low < high) && all(low < seen.high) && apart < seen.reach;
}
