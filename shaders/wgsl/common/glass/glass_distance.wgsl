// The distance to a vessel's glass, from a table over (r, y).
//!include common/glass/vessel.wgsl

/// Signed distances to the glass, of the maps for particles outside.
@group(0) @binding(25) var<storage, read> distances: array<f32>;

/// The way to a flask's glass.
struct Gap {
    /// Direction in which the distance grows fastest.
    normal: vec3<f32>,
    /// Metres, positive on either side of the glass; beyond the map a lower bound.
    distance: f32,
}

/// One sample gives both: on a software driver, gathers are what this costs.
fn glass(k: u32, p: vec3<f32>) -> Gap {
    let r = length(p.xz);
    let place = map_place(k, r, p.y);
    let node = flasks[k].distance_first + place.node;
    let above = node + flasks[k].map_columns;
    let a = distances[node];
    let b = distances[node + 1u];
    let c = distances[above];
    let d = distances[above + 1u];
    let slope = vec2<f32>(mix(b - a, d - c, place.t), mix(c - a, d - b, place.s));
    let out = p.xz / max(r, 1e-9);
    let normal = vec3<f32>(out.x * slope.x, slope.y, out.y * slope.x);
    let value = mix(mix(a, b, place.s), mix(c, d, place.s), place.t);
    let distance = select(value, max(abs(value), place.away), place.away > 0.0);
    return Gap(normal / max(length(normal), 1e-12), distance);
}
