// A workgroup's block and the 26 around it.
//!include common/liquid/find_block.wgsl

@group(0) @binding(41) var<storage, read> colour_used: array<u32>;
@group(0) @binding(42) var<storage, read> colour_blocks: array<vec4<i32>>;

/// Slots of the blocks around, x running fastest.
var<workgroup> around: array<u32, 27>;

/// Finds them; the workgroup's invocations together.
fn find_around(slot: u32, local: u32) {
    if (local < 27u) {
        let offset = vec3<i32>(vec3<u32>(local % 3u, (local / 3u) % 3u, local / 9u)) - vec3<i32>(1);
        let own = colour_blocks[slot];
        around[local] = find_block(own.xyz + offset, u32(own.w));
    }
    workgroupBarrier();
}

/// Place in all blocks' arrays of a node that lies `node` from the block's first, each of −4 to 7; NO_BLOCK where there is
/// none.
fn place_around(node: vec3<i32>) -> u32 {
    let block = (node >> vec3<u32>(2u)) + vec3<i32>(1);
    let slot = around[block.x + 3 * block.y + 9 * block.z];
    return select(slot * BLOCK_NODES + node_in_block(node), NO_BLOCK, slot == NO_BLOCK);
}

/// The `place`th of `edge`³ nodes that begin at `first`.
fn node_at(place: u32, edge: u32, first: i32) -> vec3<i32> {
    return vec3<i32>(vec3<u32>(place % edge, (place / edge) % edge, place / (edge * edge))) + vec3<i32>(first);
}
