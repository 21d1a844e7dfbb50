// The colour function: the share of space that liquid fills, on nodes half a support radius apart. Nodes exist in blocks of
// 4 × 4 × 4 about the liquid, found by an open hash table. Each flask's inside has nodes of its own, as what is inside
// does not feel what is beyond the glass; all else shares one grid.
//!include common/liquid/kernel.wgsl

/// Slots of the table, a power of two.
override BLOCK_SLOTS: u32 = 64u;

/// Distance between nodes, metres.
override NODE: f32 = 1.0;

/// What a node that is full counts: sums of shares are of integers.
const COLOUR_FULL: f32 = 16777216.0;

/// Slot of a block that does not exist.
const NO_BLOCK: u32 = 0xffffffffu;

/// Nodes of a block.
const BLOCK_NODES: u32 = 64u;

/// Blocks about a block and itself.
const AROUND: u32 = 27u;

/// How far, in nodes, the colour of a node acts: a filter, and the cells about a node. What is solid is asked for one filter
/// further.
const NEAR: u32 = 2u;

// What a particle feels reaches from 4 nodes before the one below it to 5 beyond: its own colour reaches 2, either filter 1,
// and either difference ½. `colour_rim` claims the blocks of all of them.

/// Neighbours below which a particle has no surface to speak of. One alone would only claim blocks: with more asked for, what
/// leaves a drop is let go of for good, and puddles fall apart.
const FEWEST: u32 = 1u;

/// Where a block lies: its first node's indices, and its grid (0: outside of all flasks; k + 1: in flask k).
fn pack_block(block: vec3<i32>, grid: u32) -> vec4<i32> {
    return vec4<i32>(block, i32(grid));
}

/// The block's key, which repeats after 512 blocks (5 m at d = 2.5 mm); never 0.
fn block_key(block: vec3<i32>, grid: u32) -> u32 {
    let wrapped = vec3<u32>(block & vec3<i32>(511));
    return (wrapped.x | (wrapped.y << 9u) | (wrapped.z << 18u) | ((grid & 15u) << 27u)) + 1u;
}

/// First slot to look for a key in.
fn slot_of(key: u32) -> u32 {
    var bits = key * 0x9e3779b1u;
    bits = (bits ^ (bits >> 15u)) * 0x85ebca77u;
    return (bits ^ (bits >> 13u)) & (BLOCK_SLOTS - 1u);
}

/// A node's place in its block.
fn node_in_block(node: vec3<i32>) -> u32 {
    let at = vec3<u32>(node & vec3<i32>(3));
    return at.x + 4u * at.y + 16u * at.z;
}

/// The node of this place in a block, from the block's first.
fn node_of(place: u32) -> vec3<i32> {
    return vec3<i32>(vec3<u32>(place & 3u, (place >> 2u) & 3u, place >> 4u));
}

/// Rows of four nodes along x that a particle's volume is spread over.
const ROWS: u32 = 16u;

/// First node of a row about a particle whose lower node this is.
fn first_of_row(node: vec3<i32>, row: u32) -> vec3<i32> {
    return node + vec3<i32>(0, i32(row & 3u), i32(row >> 2u)) - vec3<i32>(1);
}

/// Cubic B-spline of a distance in nodes.
fn spread(distance: f32) -> f32 {
    let t = abs(distance);
    let far = max(2.0 - t, 0.0);
    return select(far * far * far / 6.0, 2.0 / 3.0 - t * t + 0.5 * t * t * t, t < 1.0);
}

/// Its slope.
fn spread_slope(distance: f32) -> f32 {
    let t = abs(distance);
    let far = max(2.0 - t, 0.0);
    return sign(distance) * select(-0.5 * far * far, 1.5 * t * t - 2.0 * t, t < 1.0);
}
