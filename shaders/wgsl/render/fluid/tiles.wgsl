//! Marks the tiles of the picture that liquid may be in, for each eye: the passes over pixels
//! draw these and no other.

//!include common/frame.wgsl
//!include common/ellipsoid.wgsl

struct TileCount {
    /// Number of particles.
    count: u32,
    /// Number of eyes.
    views: u32,
}

var<immediate> marked: TileCount;

@group(0) @binding(1) var<storage, read> ellipsoids: array<Ellipsoid>;
/// 1 where there is liquid, row by row, eye by eye.
@group(0) @binding(2) var<storage, read_write> tiles: array<u32>;

/// Pixels along a tile's edge.
const TILE = 32.0;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x >= marked.count) { return; }
    let e = ellipsoids[id.x];
    if !(e.visible > 0.0) { return; }
    // The trace bounds the greatest half axis.
    let radius = dot(e.diagonal, vec3<f32>(1.0));
    for (var eye = 0u; eye < marked.views; eye++) {
        let view = &frame.views[eye];
        let clip = (*view).clip_from_stage * vec4<f32>(e.centre, 1.0);
        // Behind the eye even at its nearest, or not a number.
        if !(clip.w > -radius) { continue; }
        // Close by, or around the eye, it may be anywhere.
        let close = clip.w < 4.0 * radius + (*view).near;
        let depth = max(clip.w, 1e-20);
        let middle = (0.5 + 0.5 * clip.xy / depth) * frame.extent;
        // By 1.2 for what perspective adds to the side, up to a field of 120°.
        let across = 2.0 * radius * (*view).focal / depth + 1.0;
        let last = vec2<f32>(f32(frame.tile_columns), f32(frame.tile_rows)) - 1.0;
        let low = floor((middle - across) / TILE);
        let high = floor((middle + across) / TILE);
        let first = select(max(low, vec2<f32>(0.0)), vec2<f32>(0.0), close);
        let end = select(min(high, last), last, close);
        for (var y = i32(first.y); y <= i32(end.y); y++) {
            for (var x = i32(first.x); x <= i32(end.x); x++) {
                tiles[(eye * frame.tile_rows + u32(y)) * frame.tile_columns + u32(x)] = 1u;
            }
        }
    }
}
