//! Marks what each tile of each eye's picture has in it, so that passes over pixels have those
//! of their kind and no other.

//!include common/picture/ellipsoid.wgsl
//!include common/picture/frame.wgsl
//!include common/picture/tile_marks.wgsl

struct TileCount {
    /// Number of particles.
    count: u32,
}

var<immediate> marked: TileCount;

@group(0) @binding(1) var<storage, read> ellipsoids: array<Ellipsoid>;
/// Marks, row by row, eye by eye.
@group(0) @binding(2) var<storage, read_write> tiles: array<atomic<u32>>;

/// Marks all tiles between two places in the picture (pixels).
fn mark(eye: u32, low: vec2<f32>, high: vec2<f32>, bits: u32) {
    let columns = frame.tile_columns;
    let end = vec2<f32>(f32(columns), f32(frame.tile_rows)) - 1.0;
    let first = vec2<i32>(max(floor(low / f32(TILE)), vec2<f32>(0.0)));
    let last = vec2<i32>(min(floor(high / f32(TILE)), end));
    for (var y = first.y; y <= last.y; y++) {
        for (var x = first.x; x <= last.x; x++) {
            let tile = (eye * frame.tile_rows + u32(y)) * columns + u32(x);
            // Most are marked already, and to look is cheaper than to write.
            if ((atomicLoad(&tiles[tile]) & bits) != bits) { atomicOr(&tiles[tile], bits); }
        }
    }
}

fn mark_particle(eye: u32, e: Ellipsoid) {
    // The trace bounds the greatest half axis.
    let radius = dot(e.diagonal, vec3<f32>(1.0));
    let view = &frame.views[eye];
    let clip = (*view).clip_from_stage * vec4<f32>(e.centre, 1.0);
    // Behind the eye even at its nearest, or not a number.
    if !(clip.w > -radius) { return; }
    // Close by, or around the eye, it may be anywhere.
    let close = clip.w < 4.0 * radius + (*view).near;
    let depth = max(clip.w, 1e-20);
    let middle = (0.5 + 0.5 * clip.xy / depth) * frame.extent;
    // Twice, for what perspective adds to the side, up to a field of 120°.
    let across = 2.0 * radius * (*view).focal / depth + 1.0;
    mark(
        eye,
        select(middle - across, vec2<f32>(0.0), close),
        select(middle + across, frame.extent, close),
        MARK_LIQUID,
    );
}

/// The box around the corners of a vessel's own, in the picture.
fn mark_vessel(eye: u32, index: u32) {
    let m = frame.vessels[index].vessel_from_stage;
    let stage_from_vessel = transpose(mat3x3<f32>(m[0].xyz, m[1].xyz, m[2].xyz));
    var low = frame.extent;
    var high = vec2<f32>(0.0);
    var behind = 0u;
    for (var corner = 0u; corner < 8u; corner++) {
        let up = select(0.0, frame.vessels[index].rim, (corner & 4u) != 0u);
        let aside = select(vec2<f32>(-1.0), vec2<f32>(1.0), (vec2<u32>(corner) & vec2<u32>(1u, 2u)) != vec2<u32>(0u));
        let p = vec3<f32>(aside.x, 0.0, aside.y) * frame.vessels[index].outer + vec3<f32>(0.0, up, 0.0);
        let clip = frame.views[eye].clip_from_stage * vec4<f32>(stage_from_vessel * (p - m[3].xyz), 1.0);
        let near = clip.w < frame.views[eye].near;
        let at = (0.5 + 0.5 * clip.xy / max(clip.w, 1e-9)) * frame.extent;
        low = select(min(low, at), vec2<f32>(0.0), near);
        high = select(max(high, at), frame.extent, near);
        behind += select(0u, 1u, near);
    }
    if (behind == 8u) { return; }
    mark(eye, low - 2.0, high + 2.0, 1u << index);
}

/// A place on the edge of the table's top, `index` of 128.
fn mark_table(eye: u32, index: u32) {
    let along = f32(index % 32u) / 31.0;
    let side = index / 32u;
    let far = select(0.0, 1.0, (side & 1u) != 0u);
    let share = select(vec2<f32>(far, along), vec2<f32>(along, far), side < 2u);
    let at = mix(frame.table_min.xz, frame.table_max.xz, share);
    let clip = frame.views[eye].clip_from_stage * vec4<f32>(at.x, frame.table_max.y, at.y, 1.0);
    if (clip.w < frame.views[eye].near || frame.table_max.y <= frame.table_min.y) { return; }
    let middle = (0.5 + 0.5 * clip.xy / clip.w) * frame.extent;
    // As far as half of the way to the next place.
    let gap = max(frame.table_max.x - frame.table_min.x, frame.table_max.z - frame.table_min.z) / 62.0;
    let across = select(vec2<f32>(2.0), vec2<f32>(gap * frame.views[eye].focal / clip.w, 2.0), side < 2u);
    mark(eye, middle - across, middle + across, MARK_EDGE);
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    for (var eye = 0u; eye < frame.view_count; eye++) {
        if (id.x < marked.count) {
            let e = ellipsoids[id.x];
            if (e.visible > 0.0) { mark_particle(eye, e); }
        }
        if (id.x < frame.glass_count) { mark_vessel(eye, id.x); }
        if (id.x < 128u) { mark_table(eye, id.x); }
    }
}
