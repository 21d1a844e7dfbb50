//! Passes over the pixels of marked tiles: two triangles a tile.

//!include common/frame.wgsl

@group(0) @binding(1) var<storage, read> tiles: array<u32>;

/// Pixels along a tile's edge.
const TILE = 32.0;

/// Corner `index` of all tiles' triangles in clip space, at the near plane; one point for a tile
/// that is not marked, so that it has no area and need not be clipped. `eye` counts on behind the
/// eyes' liquid to their edges.
fn tile_corner(index: u32, eye: u32) -> vec4<f32> {
    let tile = index / 6u;
    let of_view = frame.tile_columns * frame.tile_rows;
    if (tiles[eye * of_view + tile] == 0u) { return vec4<f32>(0.0, 0.0, 0.0, 1.0); }
    let corner = index % 6u;
    let right = corner == 1u || corner == 2u || corner == 4u;
    let low = corner == 2u || corner == 4u || corner == 5u;
    let at = vec2<f32>(f32(tile % frame.tile_columns), f32(tile / frame.tile_columns))
        + select(vec2<f32>(0.0), vec2<f32>(1.0), vec2<bool>(right, low));
    // The last ones end with the picture, so that nothing has to be clipped.
    return vec4<f32>(min(2.0 * TILE * at / frame.extent, vec2<f32>(2.0)) - 1.0, 1.0, 1.0);
}
