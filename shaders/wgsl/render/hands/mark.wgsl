//! Marks the tiles that the hands are in: a workgroup a bone and eye.

//!include common/picture/bones.wgsl
//!include common/picture/tile_marks.wgsl

/// Marks of the tiles.
@group(0) @binding(3) var<storage, read_write> tiles: array<atomic<u32>>;

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let eye = group.y;
    if (group.x % BONES >= run.counts[group.x / BONES]) { return; }
    let seen = bone_seen(bones[group.x], eye, ADDED * run.joined);
    if (any(seen.high <= seen.low)) { return; }
    let first = vec2<u32>(seen.low) / TILE;
    let last = (vec2<u32>(seen.high) - 1u) / TILE;
    let columns = last.x - first.x + 1u;
    let count = columns * (last.y - first.y + 1u);
    for (var n = lane; n < count; n += 64u) {
        let tile = first + vec2<u32>(n % columns, n / columns);
        let low = vec2<f32>(TILE * tile);
        if (reaches(seen, low, low + f32(TILE))) {
            let index = (eye * frame.tile_rows + tile.y) * frame.tile_columns + tile.x;
            if ((atomicLoad(&tiles[index]) & MARK_HANDS) == 0u) { atomicOr(&tiles[index], MARK_HANDS); }
        }
    }
}
