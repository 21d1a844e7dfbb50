//! What an eye sees of the liquid behind a vessel's wall: the ray is bent at the wall's outer face and at its inner one, so liquid is seen up to
//! the glass's own outline, where n · r of it is more than that of the glass.

//!include common/picture/frame.wgsl
//!include common/picture/tile_marks.wgsl
//!include common/picture/vessel_rays.wgsl

/// Refractive index of borosilicate glass.
const GLASS_INDEX = 1.47;

/// Where a ray comes out of a vessel's wall, into its inside.
struct Inside {
    /// The vessel, or as many as there are vessels.
    vessel: u32,
    /// In the stage.
    point: vec3<f32>,
    /// Along which it goes in the glass; of length 1.
    direction: vec3<f32>,
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

/// Through the first wall of a vessel in `bits` that the ray through the middle of a pixel meets from outside, nearer than view depth `end`.
fn inside_of_wall(bits: u32, eye: u32, place: vec2<f32>, end: f32) -> Inside {
    let seen = seen_along(eye, place);
    var found = Inside(frame.blocker_count, vec3<f32>(0.0), normalize(seen));
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
            way = to_cylinder(p, direction, vessel_radius(index, p.y + way * direction.y) + wall);
        }
        let met = p + way * direction;
        // A steep cone may need more steps than that: what it shows is drawn as without a lens.
        if (abs(length(met.xz) - vessel_radius(index, met.y) - wall) > 0.25 * wall) { continue; }
        if (way <= frame.views[eye].near || way >= nearest || met.y < 0.0 || met.y > frame.vessels[index].rim) { continue; }
        let within = refract(normalize(direction), -inward(index, met), 1.0 / GLASS_INDEX);
        let on = to_cylinder(met, within, vessel_radius(index, met.y));
        let inner = met + on * within;
        if (on <= 0.0 || on > 8.0 * wall || inner.y < frame.vessels[index].inner_floor) { continue; }
        let stage_from_vessel = transpose(mat3x3<f32>(m[0].xyz, m[1].xyz, m[2].xyz));
        nearest = way;
        found = Inside(index, stage_from_vessel * (inner - m[3].xyz), stage_from_vessel * within);
    }
    return found;
}
