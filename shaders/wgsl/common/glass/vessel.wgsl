// Vessels of revolution: their poses, radius lookup tables and volume maps.

/// Number of flasks.
override FLASKS: u32 = 0u;

/// Constant geometry of a flask, in its frame: y along the axis, origin at the
/// centre of the outer base; metres.
struct Flask {
    /// Height of the inner floor.
    floor: f32,
    /// Height of the rim.
    rim: f32,
    /// Inner radius at the rim.
    mouth: f32,
    /// Largest outer radius.
    outer: f32,
    /// Wall thickness.
    wall: f32,
    /// Heights per metre in the radius table.
    radius_scale: f32,
    /// First entry of the radius table.
    radius_first: u32,
    /// Entries of the radius table.
    radius_count: u32,
    /// First node of the map for particles inside.
    inside_first: u32,
    /// First node of the map for all others.
    outside_first: u32,
    /// First node of the distances for all others.
    distance_first: u32,
    /// Nodes in r.
    map_columns: u32,
    /// Nodes in y.
    map_rows: u32,
    /// Nodes per metre.
    map_scale: f32,
    /// Height of the first row.
    map_base: f32,
    /// Cosine of its contact angle.
    wetting: f32,
}

/// stage_from_flask.
struct FlaskPose {
    /// Origin of the flask in the stage; w unused.
    position: vec4<f32>,
    /// Unit quaternion, xyzw.
    orientation: vec4<f32>,
}

@group(0) @binding(20) var<storage, read> flasks: array<Flask>;
@group(0) @binding(21) var<storage, read> poses: array<FlaskPose>;
@group(0) @binding(22) var<storage, read> radii: array<f32>;
@group(0) @binding(23) var<storage, read> maps: array<vec4<f32>>;

fn rotate(q: vec4<f32>, v: vec3<f32>) -> vec3<f32> {
    let t = 2.0 * cross(q.xyz, v);
    return v + q.w * t + cross(q.xyz, t);
}

/// Position of a stage point in the frame of a flask.
fn flask_from_stage(pose: FlaskPose, point: vec3<f32>) -> vec3<f32> {
    return rotate(vec4<f32>(-pose.orientation.xyz, pose.orientation.w), point - pose.position.xyz);
}

fn stage_from_flask(pose: FlaskPose, point: vec3<f32>) -> vec3<f32> {
    return rotate(pose.orientation, point) + pose.position.xyz;
}

/// r_i(h) of section 5 by the lookup table; 0 below the floor, the mouth above the rim.
fn inner_radius(k: u32, y: f32) -> f32 {
    if (y < flasks[k].floor) { return 0.0; }
    let at = (y - flasks[k].floor) * flasks[k].radius_scale;
    let last = flasks[k].radius_count - 1u;
    let i = min(u32(at), last - 1u);
    let t = min(at - f32(i), 1.0);
    let first = flasks[k].radius_first + i;
    return mix(radii[first], radii[first + 1u], t);
}

/// Ω_in of Eq. 21 for a point in the flask's frame.
fn is_inside(k: u32, p: vec3<f32>) -> bool {
    let r = inner_radius(k, p.y);
    return p.y > flasks[k].floor && p.y < flasks[k].rim && dot(p.xz, p.xz) < r * r;
}

/// Whether a segment crosses the plane of the rim within the mouth.
fn crosses_mouth(k: u32, a: vec3<f32>, b: vec3<f32>) -> bool {
    let drop = b.y - a.y;
    if (drop == 0.0) { return false; }
    let p = mix(a, b, clamp((flasks[k].rim - a.y) / drop, 0.0, 1.0));
    return length(p.xz) < flasks[k].mouth;
}

/// A place in a flask's tables over (r, y): the lower of its four nodes and
/// the fractions of the way to the others.
struct MapPlace {
    node: u32,
    s: f32,
    t: f32,
    /// Distance to the tables, metres; 0 within them.
    away: f32,
}

fn map_place(k: u32, r: f32, y: f32) -> MapPlace {
    let columns = flasks[k].map_columns;
    let at = vec2<f32>(r, y - flasks[k].map_base) * flasks[k].map_scale;
    let last = vec2<f32>(f32(columns - 1u), f32(flasks[k].map_rows - 1u));
    let edge = clamp(at, vec2<f32>(0.0), last);
    let i = min(u32(edge.x), columns - 2u);
    let j = min(u32(edge.y), flasks[k].map_rows - 2u);
    let away = length(at - edge) / flasks[k].map_scale;
    return MapPlace(j * columns + i, edge.x - f32(i), edge.y - f32(j), away);
}

/// What a flask's volume map says of a place.
struct MapSample {
    /// Signed distance to the glass, metres.
    distance: f32,
    /// V.
    volume: f32,
    /// ∂V/∂r and ∂V/∂y, 1/m.
    slope: vec2<f32>,
}

/// The map at (r, y) by bilinear interpolation. Outside of it V is 0 and the distance a lower bound.
fn sample_map(k: u32, first: u32, r: f32, y: f32) -> MapSample {
    let place = map_place(k, r, y);
    let node = first + place.node;
    let above = node + flasks[k].map_columns;
    let low = mix(maps[node], maps[node + 1u], place.s);
    let high = mix(maps[above], maps[above + 1u], place.s);
    let value = mix(low, high, place.t);
    if (place.away > 0.0) { return MapSample(max(abs(value.x), place.away), 0.0, vec2<f32>(0.0)); }
    return MapSample(value.x, value.y, value.zw);
}

/// Whether what is at `from` in flask k's liquid space can act on what is at
/// `to` outside of it: only through the open top (flask's frame).
fn visible_from(k: u32, from_inside: vec3<f32>, to: vec3<f32>) -> bool {
    // One that is about to leave is over the rim already.
    if (from_inside.y >= flasks[k].rim) { return to.y >= flasks[k].rim || is_inside(k, to); }
    if (to.y < flasks[k].rim) { return is_inside(k, to); }
    return crosses_mouth(k, from_inside, to);
}
