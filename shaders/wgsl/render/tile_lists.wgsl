//! Lists the tiles of each class, from their marks, and writes the sizes of the dispatches over them.

//!include common/picture/frame.wgsl
//!include common/picture/hidden_area.wgsl
//!include common/picture/tile_marks.wgsl

@group(0) @binding(1) var<storage, read> tiles: array<u32>;
@group(0) @binding(2) var<storage, read_write> tile_lists: array<u32>;
/// Three workgroup counts for each class.
@group(0) @binding(3) var<storage, read_write> arguments: array<atomic<u32>>;

fn append(class_: u32, tile: u32, all: u32) {
    let place = atomicAdd(&arguments[3u * class_], 1u);
    tile_lists[class_ * all + place] = tile;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x < 7u) {
        atomicStore(&arguments[3u * id.x + 1u], 4u);
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
    let marks = select(tiles[id.x], 0u, is_all_hidden(low, high, eye));
    var class_ = 2u;
    if ((marks & MARK_VESSELS) != 0u) { class_ = 1u; }
    if ((marks & MARK_LIQUID) != 0u) { class_ = 0u; }
    append(class_, id.x, all);
    if ((marks & MARK_SPHERES) != 0u) { append(5u, id.x, all); }
    if ((marks & MARK_HANDS) != 0u) { append(6u, id.x, all); }
    if (marks != 0u) { append(select(3u, 4u, (marks & MARK_STEAM) != 0u), id.x, all); }
}
