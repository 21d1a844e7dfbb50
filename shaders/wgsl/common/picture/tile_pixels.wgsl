//! Passes over the pixels of the tiles of a class: four workgroups a tile, of eight rows each. The
//! tiles are listed, and the dispatch is as long as the list: a test in each pixel would cost the
//! software driver, which walks both sides of every branch, what it was to save.

//!include common/picture/frame.wgsl
//!include common/picture/tile_marks.wgsl

/// Whose list: 0 liquid; where every pixel is shaded 1 glass without liquid, 9 liquid, and of those that have neither 14 with the table's top alone, 15
/// with walls, 17 with walls, table and fittings, 16 with a panel, a sign or a pane, 2 the others; 3 edges to be smoothed, 4
/// those with steam over them; 5 coloured spheres or spray; 6 hands, likewise. Where blocks are shaded: 7 all, 8 those with steam; 10 liquid, 11
/// glass, 12 neither; 13 hands.
override CLASS: u32 = 0u;

/// For each class its tiles, counted row by row, eye by eye; `tile_lists.wgsl` writes them.
@group(0) @binding(1) var<storage, read> tile_lists: array<u32>;

/// The pixel of an invocation.
struct Place {
    pixel: vec2<i32>,
    eye: u32,
    /// Its tile.
    tile: u32,
    /// False beyond the picture's edge.
    inside: bool,
}

fn place_of(group: vec3<u32>, local: vec3<u32>) -> Place {
    let of_view = frame.tile_columns * frame.tile_rows;
    let tile = tile_lists[CLASS * frame.view_count * of_view + group.x];
    let eye = tile / of_view;
    let row = (tile - eye * of_view) / frame.tile_columns;
    let column = tile - eye * of_view - row * frame.tile_columns;
    let pixel = vec2<i32>(vec2<u32>(column, row) * TILE + vec2<u32>(local.x, 8u * group.y + local.y));
    return Place(pixel, eye, tile, all(pixel < vec2<i32>(frame.extent)));
}
