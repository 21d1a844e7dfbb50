//! Blocks of pixels in the tiles away from the fovea: each is shaded in one place, the middle of a pixel of it.

//!include common/picture/hidden_area.wgsl
//!include common/picture/shaded_pixel.wgsl
//!include common/picture/tile_pixels.wgsl

/// The block of an invocation, of 8 by 8 in a workgroup: a quarter of a tile, or all of one with blocks of four by four pixels.
struct CoarseBlock {
    /// The pixel that is shaded.
    place: Place,
    /// Its upper left pixel.
    low: vec2<i32>,
    /// Pixels along its sides.
    side: i32,
}

/// The first pixel of a tile counted row by row, eye by eye; and its eye (z).
fn corner_of(tile: u32) -> vec3<u32> {
    let of_view = frame.tile_columns * frame.tile_rows;
    let eye = tile / of_view;
    let row = (tile - eye * of_view) / frame.tile_columns;
    return vec3<u32>(vec2<u32>(tile - eye * of_view - row * frame.tile_columns, row) * TILE, eye);
}

/// A coarse tile in a list.
struct CoarseTile {
    tile: u32,
    /// Pixels along its blocks' sides.
    side: u32,
}

fn coarse_tile(index: u32) -> CoarseTile {
    let entry = tile_lists[CLASS * frame.view_count * frame.tile_columns * frame.tile_rows + index];
    return CoarseTile(entry / 2u, select(2u, 4u, (entry & 1u) != 0u));
}

/// Whether a workgroup of four a tile has any: blocks of four by four pixels of a tile are all the first one's.
fn has_blocks(side: i32, group: vec3<u32>) -> bool {
    return side == 2 || group.y == 0u;
}

fn block_of(group: vec3<u32>, local: vec3<u32>) -> CoarseBlock {
    let shaded_tile = coarse_tile(group.x);
    let corner = corner_of(shaded_tile.tile);
    let quarter = (TILE / 2u) * vec2<u32>(group.y & 1u, group.y >> 1u);
    let low = vec2<i32>(corner.xy + quarter + shaded_tile.side * local.xy);
    let inside = all(low < vec2<i32>(frame.extent)) && has_blocks(i32(shaded_tile.side), group);
    let place = Place(shaded_in(low, i32(shaded_tile.side)), corner.z, shaded_tile.tile, inside);
    return CoarseBlock(place, low, i32(shaded_tile.side));
}

/// Whether no eye sees any of it, as its corners tell.
fn is_block_hidden(block: CoarseBlock) -> bool {
    if (frame.hides == 0u) { return false; }
    let eye = block.place.eye;
    let high = min(block.low + block.side, vec2<i32>(frame.extent)) - 1;
    return is_hidden(block.low, eye) && is_hidden(high, eye)
        && is_hidden(vec2<i32>(high.x, block.low.y), eye) && is_hidden(vec2<i32>(block.low.x, high.y), eye);
}
