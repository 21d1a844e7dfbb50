//! Rays in a vessel's liquid: where they meet the glass.

//!include common/picture/frame.wgsl

/// Inner radius of a vessel at a height of its frame.
fn vessel_radius(index: u32, y: f32) -> f32 {
    let vessel = &frame.vessels[index];
    let at = 15.0 * saturate((y - (*vessel).inner_floor) / ((*vessel).rim - (*vessel).inner_floor));
    let low = min(u32(at), 14u);
    let a = (*vessel).radii[low / 4u][low % 4u];
    let b = (*vessel).radii[(low + 1u) / 4u][(low + 1u) % 4u];
    return mix(a, b, at - f32(low));
}

/// The vessel that `point` (stage) is in; as many as there are for none.
fn vessel_around(point: vec3<f32>) -> u32 {
    var found = frame.blocker_count;
    for (var index = 0u; index < frame.blocker_count; index++) {
        let p = (frame.vessels[index].vessel_from_stage * vec4<f32>(point, 1.0)).xyz;
        let reach = vessel_radius(index, p.y) + frame.spacing;
        let high = p.y > 0.0 && p.y < frame.vessels[index].rim + frame.spacing;
        if high && dot(p.xz, p.xz) < reach * reach { found = index; }
    }
    return found;
}

/// The inner surface's normal at p (vessel's frame), towards the axis, by the profile's slope.
fn inward(index: u32, p: vec3<f32>) -> vec3<f32> {
    let step = (frame.vessels[index].rim - frame.vessels[index].inner_floor) / 15.0;
    let slope = (vessel_radius(index, p.y + step) - vessel_radius(index, p.y - step)) / (2.0 * step);
    let out = p.xz / max(length(p.xz), 1e-9);
    return normalize(vec3<f32>(-out.x, slope, -out.y));
}

/// Distance along a ray from p (vessel's frame, in the liquid) to the side wall (x) and to the
/// inner floor (y).
fn to_glass(index: u32, p: vec3<f32>, direction: vec3<f32>) -> vec2<f32> {
    let down = select(1e9, (frame.vessels[index].inner_floor - p.y) / direction.y, direction.y < -1e-6);
    let a = max(dot(direction.xz, direction.xz), 1e-9);
    let b = dot(p.xz, direction.xz) / a;
    let c = dot(p.xz, p.xz);
    var t = 0.0;
    // A vessel's radius changes slowly with height: the cylinder of the height where the
    // last one was met.
    for (var step = 0; step < 3; step++) {
        let radius = vessel_radius(index, p.y + t * direction.y);
        t = max(sqrt(max(b * b - (c - radius * radius) / a, 0.0)) - b, 0.0);
    }
    return vec2<f32>(t, max(down, 0.0));
}
