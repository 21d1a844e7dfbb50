// A block and the 26 around it, whose slots `colour_walls` leaves: each pass over nodes would have to look them up anew.
//!include common/liquid/colour.wgsl

@group(0) @binding(41) var<storage, read> colour_used: array<u32>;
/// By block: slots of those around it, x running fastest.
@group(0) @binding(42) var<storage, read> colour_around: array<u32>;

/// Place in all blocks' arrays of a node that lies `node` from the block's first, each of −4 to 7; NO_BLOCK where there is
/// none.
fn place_around(slot: u32, node: vec3<i32>) -> u32 {
    let block = vec3<u32>((node >> vec3<u32>(2u)) + vec3<i32>(1));
    let other = colour_around[slot * AROUND + block.x + 3u * block.y + 9u * block.z];
    return select(other * BLOCK_NODES + node_in_block(node), NO_BLOCK, other == NO_BLOCK);
}
