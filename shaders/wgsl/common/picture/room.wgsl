//! Bench, floor and walls: their light, and what of them a ray meets.

//!include common/picture/daylight.wgsl
//!include common/picture/frame.wgsl
//!include common/picture/laboratory.wgsl
//!include common/picture/room_parts.wgsl

const MATERIAL_TABLE = 0u;
const MATERIAL_FLOOR = 1u;
const MATERIAL_WALL = 2u;

/// Share of the sky's light that a vessel keeps from where it hides all of the sky: clear glass and water send most of it on.
const HIDES_SKY = 0.2;
/// How far the dark line about a foot reaches, m, and the share of the sky that is hidden there: a foot is round at its edge and of thick glass, which
/// shows the dark under it. Ours.
const CONTACT = 0.0022;
const CONTACT_HIDES = 0.45;
/// No vessel, for `Through`.
const NO_VESSEL = 0xffffffffu;

/// What the bench is seen through.
struct Through {
    /// A vessel, which keeps nothing away from what is under it, or `NO_VESSEL`.
    vessel: u32,
    /// The share of the window's light that comes down through its liquid.
    window: f32,
}

/// The share of the hemisphere's light (x) and of the window's (y) that reaches `position`; the vessel `under` keeps none away: what is
/// under it is lit through it.
fn shadow(position: vec3<f32>, normal: vec3<f32>, to_window: vec3<f32>, under: u32) -> vec2<f32> {
    var share = vec2<f32>(1.0);
    for (var index = 0u; index < frame.blocker_count; index++) {
        if (index == under) { continue; }
        let blocker = frame.blockers[index];
        let axis = blocker.top - blocker.foot;
        let from_foot = position - blocker.foot;
        let axis_squared = max(dot(axis, axis), 1e-12);
        let along_axis = dot(from_foot, axis);

        // Ambient: the nearest sphere of the capsule hides cosθ·(r/l)² of the hemisphere.
        let to_sphere = axis * saturate(along_axis / axis_squared) - from_foot;
        let gap = max(length(to_sphere), blocker.radius);
        let ratio = blocker.radius / gap;
        let hidden = saturate(dot(to_sphere, normal) / gap) * ratio * ratio;
        share.x *= 1.0 - HIDES_SKY * hidden;

        // Where it stands: what is close to its foot sees little but glass.
        let lowest = blocker.foot.y - 0.5 * blocker.radius - position.y;
        let beside = (length(from_foot.xz) - blocker.radius) * frame.metres_per_unit / CONTACT;
        share.x *= 1.0 - CONTACT_HIDES * saturate(1.0 - lowest * frame.metres_per_unit / CONTACT) / (1.0 + beside * beside);

        // Window: the strip that the blocker hides of it, as angles seen from here, and the strip's length.
        let ray_foot = dot(from_foot, to_window);
        let ray_axis = dot(to_window, axis);
        let across = max(axis_squared - ray_axis * ray_axis, 1e-12);
        let on_axis = saturate((along_axis - ray_foot * ray_axis) / across);
        let on_ray = max(dot(blocker.foot + axis * on_axis - position, to_window), 1e-6);
        let miss = length(blocker.foot + axis * on_axis - position - to_window * on_ray);
        let strip = vec2<f32>(miss - blocker.radius, miss + blocker.radius) / on_ray;
        let sides = smoothstep(vec2<f32>(-WINDOW_ANGLE), vec2<f32>(WINDOW_ANGLE), strip);
        let long = (sqrt(axis_squared) + 2.0 * blocker.radius) / (2.0 * WINDOW_ANGLE * on_ray);
        share.y *= 1.0 - blocker.opacity * (sides.y - sides.x) * min(long, 1.0);
    }
    return share;
}

/// Downward part of a ray from which on edges on the bench are no softer: seen so flat they are soft over 8 pixels to the side (`SOFT` of `tile_room.wgsl`).
const LEAST_SLOPE = 0.0625;
const WORKTOP = vec3<f32>(0.30, 0.33, 0.35);
/// Light that the table sends back from `at` (metres) where `position` is that place in the scene's unit.
fn table_light(ray: Sight, position: vec3<f32>, at: vec3<f32>, way: f32, normal: vec3<f32>, through: Through) -> vec3<f32> {
    let key = key_light(at);
    let share = vec2<f32>(1.0, through.window) * shadow(position, normal, key.direction, through.vessel);
    let sharp = max(-ray.direction.y, LEAST_SLOPE) / max(way * ray.fine, 1e-6);
    var top = Top(WORKTOP, vec3<f32>(0.0));
    if (normal.y > 0.5) { top = top_at(at.xz, sharp, WORKTOP); }
    let comes = share.x * ambient_light(normal.y) + share.y * max(dot(normal, key.direction), 0.0) * key.light;
    let light = top.albedo * comes + top.glow;
    let far = at.z - frame.table_min.z * frame.metres_per_unit;
    // Further from the far edge nothing of sink, tray or tap is seen, from where a user may be.
    if (!sees(SEES_FITTINGS) || far > 0.45 || normal.y < 0.5 || !has_fittings()) { return light; }
    let fitted_ = fitted(ray, at, sharp, light, share);
    let metal = tap(ray, way);
    return mix(fitted_, metal.light, metal.share);
}

/// Where a ray meets the room.
struct Meeting {
    /// In lengths of the ray's direction; 0 for nowhere.
    way: f32,
    normal: vec3<f32>,
    material: u32,
}

/// What a ray from `origin` within the room meets first: table, floor, walls or ceiling.
fn room_meets(origin: vec3<f32>, direction: vec3<f32>) -> Meeting {
    if (SEES == SEES_BENCH) { return Meeting((frame.table_max.y - origin.y) * (1.0 / direction.y), vec3<f32>(0.0, 1.0, 0.0), MATERIAL_TABLE); }
    let steep = select(vec3<f32>(-1e-6), vec3<f32>(1e-6), direction >= vec3<f32>(0.0));
    let inverse = 1.0 / select(steep, direction, abs(direction) > vec3<f32>(1e-6));
    let walls = (select(frame.room_min, frame.room_max, inverse > vec3<f32>(0.0)) - origin) * inverse;
    var way = max(min(walls.x, min(walls.y, walls.z)), 0.0);
    var normal = -sign(inverse) * select(vec3<f32>(0.0), vec3<f32>(1.0), walls <= vec3<f32>(way));
    var material = select(MATERIAL_WALL, MATERIAL_FLOOR, normal.y > 0.5);
    if !(frame.room_max.y > frame.room_min.y) { way = 0.0; }

    if (!sees(SEES_BENCH)) { return Meeting(way, normal, material); }
    let low = (frame.table_min - origin) * inverse;
    let high = (frame.table_max - origin) * inverse;
    let enter = min(low, high);
    let leave = max(low, high);
    let near = max(enter.x, max(enter.y, enter.z));
    let far = min(leave.x, min(leave.y, leave.z));
    if near > 0.0 && near < far && (near < way || way == 0.0) {
        way = near;
        normal = -sign(inverse) * select(vec3<f32>(0.0), vec3<f32>(1.0), enter >= vec3<f32>(near));
        material = MATERIAL_TABLE;
    }
    return Meeting(way, normal, material);
}

/// The light of what a ray from `origin` meets there, and how far that is; `fine` is a pixel's width over the way.
fn room_light(origin: vec3<f32>, direction: vec3<f32>, met: Meeting, through: Through, fine: f32) -> Far {
    let start = origin * frame.metres_per_unit;
    if (met.way == 0.0) { return Far(mix(ambient_light(direction.y), pane_light(), panes_seen(start, direction)), 0.0, 0.0); }
    let steep = select(vec3<f32>(-1e-6), vec3<f32>(1e-6), direction >= vec3<f32>(0.0));
    let ray = Sight(start, direction, 1.0 / select(steep, direction, abs(direction) > vec3<f32>(1e-6)), fine);
    let way = met.way * frame.metres_per_unit;
    var seen: Far;
    if (SEES == SEES_BENCH || (sees(SEES_BENCH) && met.material == MATERIAL_TABLE)) {
        seen = Far(table_light(ray, origin + met.way * direction, start + way * direction, way, met.normal, through), way, 0.0);
    } else {
        seen = laboratory(ray, way, met.normal);
    }
    return Far(seen.light, seen.way / frame.metres_per_unit, 0.0);
}

/// What a mirror at `origin` sees along `direction`: the room without shadows of vessels and small things, and the window.
fn mirrored_light(origin: vec3<f32>, direction: vec3<f32>) -> vec3<f32> {
    let met = room_meets(origin, direction);
    let start = origin * frame.metres_per_unit;
    if (met.way == 0.0) { return mix(ambient_light(direction.y), pane_light(), panes_seen(start, direction)); }
    let at = start + met.way * frame.metres_per_unit * direction;
    if (met.material == MATERIAL_TABLE) { return lit(WORKTOP, at, met.normal, 1.0); }
    return mirrored_laboratory(at, met.normal);
}
