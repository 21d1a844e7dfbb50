//! What an eye sees behind a vessel's wall: the ray is bent at the wall's outer face and at its inner one, so liquid is seen up to
//! the glass's own outline, where n · r of it is more than that of the glass; through an empty vessel's side the room is seen, bent at the far wall again.

//!include common/picture/frame.wgsl
//!include common/picture/tile_marks.wgsl
//!include common/picture/vessel_rays.wgsl

/// Refractive index of borosilicate glass.
const GLASS_INDEX = 1.47;

/// A ray in a vessel's glass.
struct Inside {
    /// The vessel, or as many as there are vessels.
    vessel: u32,
    /// In the stage: where it leaves the glass.
    point: vec3<f32>,
    /// Along which it goes in the glass; of length 1.
    direction: vec3<f32>,
    /// Whether it comes up through the base, whose underside has mirrored it.
    base: bool,
    /// View depth where it came into the glass.
    depth: f32,
}

/// The nearer way to a cylinder about y of that radius; negative where it is missed or behind.
fn to_cylinder(p: vec3<f32>, direction: vec3<f32>, radius: f32) -> f32 {
    let a = dot(direction.xz, direction.xz);
    let b = dot(p.xz, direction.xz);
    let c = dot(p.xz, p.xz) - radius * radius;
    let root = b * b - a * c;
    return select(-1.0, (-b - sqrt(max(root, 0.0))) / max(a, 1e-12), root > 0.0);
}

/// The way from within a cylinder about y of that radius out to it.
fn out_of_cylinder(p: vec3<f32>, direction: vec3<f32>, radius: f32) -> f32 {
    let a = max(dot(direction.xz, direction.xz), 1e-12);
    let b = dot(p.xz, direction.xz);
    let c = dot(p.xz, p.xz) - radius * radius;
    return max((sqrt(max(b * b - a * c, 0.0)) - b) / a, 0.0);
}

/// Outer radius of a vessel at a height of its frame: the edge of its base is a quarter of a circle.
fn outer_radius(index: u32, y: f32) -> f32 {
    let wall = frame.vessels[index].wall;
    let below = clamp(frame.vessels[index].inner_floor - y, 0.0, wall);
    return vessel_radius(index, y) + sqrt(wall * wall - below * below);
}

/// The outer surface's normal at p (vessel's frame), away from the glass.
fn outward(index: u32, p: vec3<f32>) -> vec3<f32> {
    let below = clamp((frame.vessels[index].inner_floor - p.y) / frame.vessels[index].wall, 0.0, 1.0);
    return normalize(-sqrt(1.0 - below * below) * inward(index, p) - vec3<f32>(0.0, below, 0.0));
}

/// Through the first wall of a vessel in `bits` that the ray through the middle of a pixel meets from outside, nearer than view depth `end`.
fn inside_of_wall(bits: u32, eye: u32, place: vec2<f32>, end: f32) -> Inside {
    let seen = seen_along(eye, place);
    var found = Inside(frame.blocker_count, vec3<f32>(0.0), normalize(seen), false, 0.0);
    var nearest = end;
    for (var rest = bits & MARK_VESSELS; rest != 0u; rest &= rest - 1u) {
        let index = firstTrailingBit(rest);
        // Shards hold nothing.
        if (index >= frame.blocker_count) { continue; }
        let m = frame.vessels[index].vessel_from_stage;
        let p = (m * vec4<f32>(frame.views[eye].eye, 1.0)).xyz;
        let direction = (m * vec4<f32>(seen, 0.0)).xyz;
        let wall = frame.vessels[index].wall;
        // As in `to_glass`: the cylinder of the height where the last one was met.
        var way = to_cylinder(p, direction, frame.vessels[index].outer);
        for (var n = 0; n < 2 && way > 0.0; n++) {
            way = to_cylinder(p, direction, outer_radius(index, p.y + way * direction.y));
        }
        let met = p + way * direction;
        // A steep cone may need more steps than that: what it shows is drawn as without a lens.
        if (abs(length(met.xz) - outer_radius(index, met.y)) > 0.25 * wall) { continue; }
        if (way <= frame.views[eye].near || way >= nearest || met.y < 0.0 || met.y > frame.vessels[index].rim) { continue; }
        var within = refract(normalize(direction), outward(index, met), 1.0 / GLASS_INDEX);
        let on = to_cylinder(met, within, vessel_radius(index, met.y));
        var inner = met + on * within;
        let floor = frame.vessels[index].inner_floor;
        let base = min(met.y, inner.y) < floor;
        if (base) {
            // Under it is air, which mirrors what comes so flat.
            if (within.y >= 0.0 || within.y * within.y > 1.0 - 1.0 / (GLASS_INDEX * GLASS_INDEX)) { continue; }
            within.y = -within.y;
            inner = vec3<f32>(met.x, floor, met.z) + (met.y + floor) / within.y * vec3<f32>(within.x, 0.0, within.z);
            if (length(inner.xz) > vessel_radius(index, floor)) { continue; }
        } else if (on <= 0.0 || on > 8.0 * wall) {
            continue;
        }
        let stage_from_vessel = transpose(mat3x3<f32>(m[0].xyz, m[1].xyz, m[2].xyz));
        nearest = way;
        found = Inside(index, stage_from_vessel * (inner - m[3].xyz), stage_from_vessel * within, base, way);
    }
    return found;
}

/// A ray that has left a vessel.
struct Passed {
    /// In the stage.
    point: vec3<f32>,
    /// Of length 1; zero where glass mirrors all.
    direction: vec3<f32>,
    /// How much further apart than without glass the rays of two pixels go.
    spread: f32,
}

/// By how much a level ray's way turns with its distance b from the axis at a face of radius `radius`: d asin(b/radius)/db − d asin(b/(n radius))/db, by
/// its cosines in air and in glass.
fn turns_with(radius: f32, in_air: f32, in_glass: f32) -> f32 {
    return (1.0 / max(in_air, 0.05) - 1.0 / (GLASS_INDEX * max(in_glass, 0.05))) / radius;
}

/// What a ray in the glass of a vessel without liquid there comes out as, on the far side. A wall is no pane: its faces' normals differ where a ray goes
/// along it, so what is behind is seen moved, and near the outline mirrored.
fn out_of_vessel(inside: Inside) -> Passed {
    let index = inside.vessel;
    let m = frame.vessels[index].vessel_from_stage;
    let stage_from_vessel = transpose(mat3x3<f32>(m[0].xyz, m[1].xyz, m[2].xyz));
    var at = (m * vec4<f32>(inside.point, 1.0)).xyz;
    var in_glass = (m * vec4<f32>(inside.direction, 0.0)).xyz;
    let inner = inward(index, at);
    let through = refract(in_glass, -inner, GLASS_INDEX);
    // Bouguer's law: n r sin of the angle is the same at both faces.
    let radius = vessel_radius(index, at.y);
    let outside = radius + frame.vessels[index].wall;
    let facing = abs(dot(in_glass, inner));
    let square = (1.0 - facing * facing) * radius * radius / (outside * outside);
    let outer_turns = turns_with(outside, sqrt(max(1.0 - GLASS_INDEX * GLASS_INDEX * square, 0.0)), sqrt(1.0 - square));
    // The inner face mirrors what comes so flat.
    in_glass = reflect(in_glass, inner);
    var turns = outer_turns + 1.0 / (GLASS_INDEX * max(facing, 0.05) * radius);
    if (any(through != vec3<f32>(0.0))) {
        let reach = to_glass(index, at, through);
        at += reach.x * through;
        // Through base or mouth it goes on as it is.
        if (reach.y < reach.x || at.y > frame.vessels[index].rim) { return Passed(inside.point, stage_from_vessel * through, 1.0); }
        in_glass = refract(through, inward(index, at), 1.0 / GLASS_INDEX);
        turns = turns_with(radius, dot(through, inner), facing) - outer_turns;
    }
    let outer = at + out_of_cylinder(at, in_glass, vessel_radius(index, at.y) + frame.vessels[index].wall) * in_glass;
    let out = refract(in_glass, inward(index, outer), GLASS_INDEX);
    // It turns as much at either wall.
    return Passed(stage_from_vessel * (outer - m[3].xyz), stage_from_vessel * out, 1.0 + 2.0 * inside.depth * abs(turns));
}
