//! Marks the tiles that a sphere is seen in.

//!include common/picture/silhouette.wgsl
//!include common/picture/tile_marks.wgsl

/// Marks of the tiles.
@group(0) @binding(4) var<storage, read_write> tiles: array<atomic<u32>>;

fn mark_tiles(eye: u32, s: Silhouette) {
    if (any(s.high <= s.low)) { return; }
    let first = s.low / i32(TILE);
    let last = (s.high - 1) / i32(TILE);
    for (var y = first.y; y <= last.y; y++) {
        for (var x = first.x; x <= last.x; x++) {
            let tile = (eye * frame.tile_rows + u32(y)) * frame.tile_columns + u32(x);
            if ((atomicLoad(&tiles[tile]) & MARK_SPHERES) == 0u) { atomicOr(&tiles[tile], MARK_SPHERES); }
        }
    }
}
