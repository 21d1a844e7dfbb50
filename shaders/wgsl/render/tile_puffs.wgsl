//! Which puffs of steam are in which tile.

//!include common/chemistry/puff.wgsl
//!include common/picture/frame.wgsl
//!include common/picture/tile_marks.wgsl

struct PuffCount {
    /// Number of puffs.
    count: u32,
}

var<immediate> steam: PuffCount;

@group(0) @binding(1) var<storage, read> puffs: array<Puff>;
/// Zero at first.
@group(0) @binding(2) var<storage, read_write> puffs_in_tiles: array<atomic<u32>>;
@group(0) @binding(3) var<storage, read_write> tiles: array<atomic<u32>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let eye = id.y;
    if (id.x >= steam.count) { return; }
    let puff = puffs[id.x];
    let view = &frame.views[eye];
    let middle = (*view).clip_from_stage * vec4<f32>(puff.position, 1.0);
    // Nothing of a puff around the eye: it would fill the picture.
    if !(puff.radius > 0.0 && puff.depth > 0.0 && middle.w > puff.radius + (*view).near) { return; }
    let at = (0.5 + 0.5 * middle.xy / middle.w) * frame.extent;
    let radius = puff.radius * (*view).focal / middle.w + 1.0;
    let end = vec2<f32>(f32(frame.tile_columns), f32(frame.tile_rows)) - 1.0;
    let first = vec2<i32>(max(floor((at - radius) / f32(TILE)), vec2<f32>(0.0)));
    let last = vec2<i32>(min(floor((at + radius) / f32(TILE)), end));
    for (var y = first.y; y <= last.y; y++) {
        for (var x = first.x; x <= last.x; x++) {
            let tile = (eye * frame.tile_rows + u32(y)) * frame.tile_columns + u32(x);
            atomicOr(&puffs_in_tiles[tile * PUFF_WORDS + id.x / 32u], 1u << (id.x & 31u));
            atomicOr(&tiles[tile], MARK_STEAM);
        }
    }
}
