//! Lists the tiles of each class, from their marks, and writes the sizes of the dispatches over them.

//!include common/picture/fovea.wgsl
//!include common/picture/frame.wgsl
//!include common/picture/hidden_area.wgsl
//!include common/picture/tile_marks.wgsl

@group(0) @binding(1) var<storage, read> tiles: array<u32>;
@group(0) @binding(2) var<storage, read_write> tile_lists: array<u32>;
/// Three workgroup counts for each class.
@group(0) @binding(3) var<storage, read_write> arguments: array<atomic<u32>>;

/// Lists, of which the last is of hands in coarse tiles, as `tiles.rs` numbers them.
const LISTS = 14u;

fn append(class_: u32, tile: u32, all: u32) {
    let place = atomicAdd(&arguments[3u * class_], 1u);
    tile_lists[class_ * all + place] = tile;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x < LISTS) {
        atomicStore(&arguments[3u * id.x + 1u], select(4u, 1u, id.x == LISTS - 1u));
        atomicStore(&arguments[3u * id.x + 2u], 1u);
    }
    let of_view = frame.tile_columns * frame.tile_rows;
    let all = frame.view_count * of_view;
    if (id.x >= all) { return; }
    let eye = id.x / of_view;
    let tile = id.x - eye * of_view;
    let row = tile / frame.tile_columns;
    let column = tile - row * frame.tile_columns;
    let low = vec2<u32>(column, row) * TILE;
    let high = min(low + TILE, vec2<u32>(frame.extent));
    // What no eye sees is only made black.
    let hidden = is_all_hidden(low, high, eye);
    let marks = select(tiles[id.x], 0u, hidden);
    let has_liquid = (marks & MARK_LIQUID) != 0u;
    let has_glass = (marks & MARK_VESSELS) != 0u;
    let has_steam = (marks & MARK_STEAM) != 0u;
    // Its surface is found at each pixel.
    if (has_liquid) { append(0u, id.x, all); }
    if ((marks & MARK_SPHERES) != 0u) { append(5u, id.x, all); }
    var side = 1u;
    if (!hidden) { side = block_side(eye, low, high, marks); }
    if ((marks & MARK_HANDS) != 0u) { append(select(6u, 13u, side != 1u), id.x, all); }
    if (side == 1u) {
        append(select(select(2u, 1u, has_glass), 9u, has_liquid), id.x, all);
        if (marks != 0u) { append(select(3u, 4u, has_steam), id.x, all); }
    } else {
        // As `common/picture/coarse_blocks.wgsl` reads it.
        let entry = 2u * id.x + select(0u, 1u, side == 4u);
        append(select(select(12u, 11u, has_glass), 10u, has_liquid), entry, all);
        append(select(7u, 8u, has_steam), entry, all);
    }
}
