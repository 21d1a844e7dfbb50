// Rows of a block's four nodes along x, and a filter of ¼, ½, ¼ along each axis. An invocation has a row, which it loads at once, and no
// two invocations have to wait for each other.
//!include common/liquid/blocks_around.wgsl

/// Rows of a block: along y, then along z.
const BLOCK_ROWS: u32 = 16u;

/// Values of a row's nodes, and of those before and after it.
struct Row {
    nodes: vec4<f32>,
    before: f32,
    after: f32,
}

/// Places, in rows, of the row at (y, z) of the block, each of −1 to 4, and of those before and after it.
fn rows_around(slot: u32, at: vec2<i32>) -> vec3<u32> {
    let block = vec2<u32>((at >> vec2<u32>(2u)) + vec2<i32>(1));
    let first = slot * AROUND + 3u * block.x + 9u * block.y;
    let within = vec2<u32>(at & vec2<i32>(3));
    let row = within.x + 4u * within.y;
    let slots = vec3<u32>(colour_around[first], colour_around[first + 1u], colour_around[first + 2u]);
    return select(slots * BLOCK_ROWS + row, vec3<u32>(NO_BLOCK), slots == vec3<u32>(NO_BLOCK));
}

/// The filter across rows: of the row `here`, between two others.
fn filtered(before: Row, here: Row, after: Row) -> Row {
    return Row(
        0.25 * (before.nodes + after.nodes) + 0.5 * here.nodes,
        0.25 * (before.before + after.before) + 0.5 * here.before,
        0.25 * (before.after + after.after) + 0.5 * here.after);
}

/// The filter along a row.
fn filtered_along(row: Row) -> vec4<f32> {
    let before = vec4<f32>(row.before, row.nodes.xyz);
    let after = vec4<f32>(row.nodes.yzw, row.after);
    return 0.25 * (before + after) + 0.5 * row.nodes;
}
