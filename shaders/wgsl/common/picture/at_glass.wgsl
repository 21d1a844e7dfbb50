//! Where a surface that reaches into a vessel's wall ends: at the glass.
//!
//! What lies at a wall is drawn reaching a little into it, and cut here by the vessel's own inner
//! surface. So wetted glass is as smooth as glass is, and so is the liquid's outline in it.

//!include common/picture/vessel_rays.wgsl

/// Reversed depth of the surface that is at `reversed` on a pixel's ray, once cut; 0 where
/// nothing is left.
fn at_glass(reversed: f32, place: vec2<f32>, eye: u32) -> f32 {
    if (reversed <= 0.0) { return 0.0; }
    let ray = seen_along(eye, place);
    let depth = frame.views[eye].near / reversed;
    let point = frame.views[eye].eye + depth * ray;
    var further = 0.0;
    for (var index = 0u; index < frame.blocker_count; index++) {
        let m = frame.vessels[index].vessel_from_stage;
        let p = (m * vec4<f32>(point, 1.0)).xyz;
        let wall = frame.vessels[index].wall;
        let inner_floor = frame.vessels[index].inner_floor;
        let r = length(p.xz);
        let beyond = r - vessel_radius(index, p.y);
        let below = inner_floor - p.y;
        // In the wall or the base. What clings to the outside has its face in the air.
        let in_wall = max(beyond, below) > 0.0 && beyond < wall && below < wall
            && p.y < frame.vessels[index].rim;
        if (in_wall) {
            let direction = (m * vec4<f32>(ray, 0.0)).xyz;
            further = into_liquid(index, p, direction);
        }
    }
    return select(frame.views[eye].near / (depth + further), 0.0, further < 0.0);
}

/// How far (in lengths of `direction`) a ray from p in a vessel's glass has to its inner space;
/// negative where it does not get there.
fn into_liquid(index: u32, p: vec3<f32>, direction: vec3<f32>) -> f32 {
    let floor = frame.vessels[index].inner_floor;
    let a = max(dot(direction.xz, direction.xz), 1e-9);
    let b = dot(p.xz, direction.xz) / a;
    let c = dot(p.xz, p.xz);
    var t = 0.0;
    var inside = true;
    for (var step = 0; step < 2; step++) {
        let radius = vessel_radius(index, p.y + t * direction.y);
        let outside = (c - radius * radius) / a;
        let root = b * b - outside;
        t = select(0.0, -b - sqrt(max(root, 0.0)), outside > 0.0);
        inside = outside <= 0.0 || (root > 0.0 && b < 0.0);
    }
    let up = select(-1.0, (floor - p.y) / direction.y, direction.y > 1e-6);
    let low = p.y + t * direction.y < floor;
    // Up through the base, or nowhere.
    let entered = select(t, up, low);
    return select(-1.0, entered, inside && entered >= 0.0);
}
