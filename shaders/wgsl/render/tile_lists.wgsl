//! Lists the tiles of each class, from their marks, and writes the sizes of the dispatches over them.

//!include common/picture/fovea.wgsl
//!include common/picture/frame.wgsl
//!include common/picture/hidden_area.wgsl
//!include common/picture/tile_marks.wgsl
//!include common/picture/tile_room.wgsl

@group(0) @binding(1) var<storage, read> tiles: array<u32>;
@group(0) @binding(2) var<storage, read_write> tile_lists: array<u32>;
/// Three workgroup counts for each class.
@group(0) @binding(3) var<storage, read_write> arguments: array<atomic<u32>>;

/// Lists, as `tiles.rs` numbers them.
const LISTS = 18u;
/// That of hands in coarse tiles, which a workgroup has all of.
const COARSE_HANDS = 13u;
/// That of tiles without glass and liquid that have a panel, a sign or a pane.
const SHEET_TILES = 16u;

fn append(class_: u32, tile: u32, all: u32) {
    let place = atomicAdd(&arguments[3u * class_], 1u);
    tile_lists[class_ * all + place] = tile;
}

/// Whether anything flat may be seen between two places of the picture.
fn may_show_sheets(eye: u32, low: vec2<f32>, high: vec2<f32>) -> bool {
    return may_show(frame.panel_from_stage, eye, low, high) || may_show(frame.sign_from_stage, eye, low, high)
        || may_show(frame.pane_from_stage, eye, low, high);
}

fn plain_class(eye: u32, low: vec2<f32>, high: vec2<f32>) -> u32 {
    if (may_show_sheets(eye, low - SOFT, high + SOFT)) { return SHEET_TILES; }
    return room_class(eye, low, high);
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x < LISTS) {
        atomicStore(&arguments[3u * id.x + 1u], select(4u, 1u, id.x == COARSE_HANDS));
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
    if ((marks & MARK_HANDS) != 0u) { append(select(6u, COARSE_HANDS, side != 1u), id.x, all); }
    if (side == 1u) {
        var class_ = select(1u, 9u, has_liquid);
        if (!has_glass && !has_liquid) { class_ = plain_class(eye, vec2<f32>(low), vec2<f32>(high)); }
        append(class_, id.x, all);
        if (marks != 0u) { append(select(3u, 4u, has_steam), id.x, all); }
    } else {
        // As `common/picture/coarse_blocks.wgsl` reads it.
        let entry = 2u * id.x + select(0u, 1u, side == 4u);
        append(select(select(12u, 11u, has_glass), 10u, has_liquid), entry, all);
        append(select(7u, 8u, has_steam), entry, all);
    }
}
