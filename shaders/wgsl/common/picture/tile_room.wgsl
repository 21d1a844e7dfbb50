//! What of the room the rays of a tile may meet. The software driver walks both sides of every branch, so a pipeline without the rest takes a
//! fraction of the time there; on an H100 it takes 0.285 ms for 0.336.

//!include common/picture/frame.wgsl
//!include common/picture/laboratory.wgsl

/// Pixels around a tile that count as its own: as far as an edge on the bench is soft (`LEAST_SLOPE` of `room.wgsl`). A board that
/// is seen flatter than 4° is softer aside, in the few rows of pixels that it has: what of that is in another tile may be missing.
const SOFT = 8.0;

/// The lists of tiles that have neither glass nor liquid: the table's top and nothing else; walls and what is along them, but not the table and what hangs
/// there; the same with the table and its fittings; and the others.
const BENCH_TILES = 14u;
const WALL_TILES = 15u;
const TABLE_TILES = 17u;
const ROOM_TILES = 2u;

/// The rays between two places of the picture, in metres.
struct Beam {
    origin: vec3<f32>,
    /// Along its corners, in order about it.
    corners: array<vec3<f32>, 4>,
    /// Of its sides, inwards.
    normals: array<vec3<f32>, 4>,
}

fn beam_between(eye: u32, low: vec2<f32>, high: vec2<f32>) -> Beam {
    let first = low - SOFT;
    let last = high + SOFT;
    let corners = array<vec3<f32>, 4>(
        seen_along(eye, first),
        seen_along(eye, vec2<f32>(last.x, first.y)),
        seen_along(eye, last),
        seen_along(eye, vec2<f32>(first.x, last.y)),
    );
    let middle = seen_along(eye, 0.5 * (first + last));
    var normals: array<vec3<f32>, 4>;
    for (var n = 0u; n < 4u; n++) {
        let normal = cross(corners[n], corners[(n + 1u) % 4u]);
        normals[n] = select(-normal, normal, dot(normal, middle) > 0.0);
    }
    return Beam(frame.views[eye].eye * frame.metres_per_unit, corners, normals);
}

/// False only where no ray meets the box.
fn may_meet(beam: Beam, low: vec3<f32>, high: vec3<f32>) -> bool {
    for (var n = 0u; n < 4u; n++) {
        let normal = beam.normals[n];
        if (dot(normal, select(low, high, normal > vec3<f32>(0.0)) - beam.origin) < 0.0) { return false; }
    }
    return true;
}

/// Whether all rays meet the top of the table.
fn is_on_bench(beam: Beam) -> bool {
    let low = frame.table_min * frame.metres_per_unit;
    let high = frame.table_max * frame.metres_per_unit;
    let down = high.y - beam.origin.y;
    if (high.y <= low.y || down >= 0.0) { return false; }
    for (var n = 0u; n < 4u; n++) {
        let corner = beam.corners[n];
        let at = beam.origin.xz + (down / corner.y) * corner.xz;
        if (corner.y >= 0.0 || any(at < low.xz) || any(at > high.xz)) { return false; }
    }
    return true;
}

fn may_see_fittings(beam: Beam) -> bool {
    if (!has_fittings()) { return false; }
    let low = frame.table_min * frame.metres_per_unit;
    let high = frame.table_max * frame.metres_per_unit;
    let sink = vec2<f32>(high.x, low.z) + vec2<f32>(-SINK_FROM_CORNER.x, SINK_FROM_CORNER.y);
    let sink_end = sink + SINK_SIZE + SINK_RIM;
    let tap_end = vec3<f32>(sink_end.x, high.y + 0.26, low.z + 0.15);
    if (may_meet(beam, vec3<f32>(sink.x - SINK_RIM, high.y, sink.y - SINK_RIM), vec3<f32>(sink_end.x, high.y, sink_end.y))) { return true; }
    if (may_meet(beam, vec3<f32>(sink.x, high.y, low.z), tap_end)) { return true; }
    let tray = low.xz + TRAY_FROM_CORNER - TRAY_SHADOW;
    let tray_end = low.xz + TRAY_FROM_CORNER + TRAY_SIZE + TRAY_SHADOW;
    return may_meet(beam, vec3<f32>(tray.x, high.y, tray.y), vec3<f32>(tray_end.x, high.y + TRAY_HEIGHT, tray_end.y));
}

fn may_see_furniture(beam: Beam) -> bool {
    if (frame.furnished == 0u) { return false; }
    let wall = frame.room_min.z * frame.metres_per_unit;
    if (may_meet(beam, vec3<f32>(HOOD_LOW, wall), vec3<f32>(HOOD_HIGH, HOOD_FRONT))) { return true; }
    if (may_meet(beam, vec3<f32>(SHELF_LOW, wall), vec3<f32>(SHELF_HIGH, SHELF_FRONT))) { return true; }
    if (may_meet(beam, vec3<f32>(POSTER, wall), vec3<f32>(POSTER + POSTER_CELL * POSTER_SIZE, wall))) { return true; }
    let signs = vec2<f32>(CORROSIVE.z);
    return may_meet(beam, vec3<f32>(EYE_WASH.xy - signs, wall), vec3<f32>(CORROSIVE.xy + signs, wall));
}

/// The list of the tile, of those of tiles without glass and liquid.
fn room_class(eye: u32, low: vec2<f32>, high: vec2<f32>) -> u32 {
    let beam = beam_between(eye, low, high);
    let fittings = may_see_fittings(beam);
    // What stands at the wall is behind the bench, and the eye may be over that.
    if (!fittings && is_on_bench(beam)) { return BENCH_TILES; }
    if (may_see_furniture(beam)) { return ROOM_TILES; }
    let bench = frame.table_max.y > frame.table_min.y
        && may_meet(beam, frame.table_min * frame.metres_per_unit, frame.table_max * frame.metres_per_unit);
    return select(WALL_TILES, TABLE_TILES, bench || fittings);
}
