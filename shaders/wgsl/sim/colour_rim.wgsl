// Line 28, surface tension, 2 of 8: claims the blocks around those that hold liquid, since colour reaches further than where it
// is found. By block and not by particle, which would look each of them up a hundred times.
//!include common/liquid/claim_block.wgsl

@group(0) @binding(44) var<storage, read> colour: array<u32>;

/// The blocks with a node near one with colour, and those one node further: a bit each, x running fastest.
var<workgroup> near: atomic<u32>;
var<workgroup> reached: atomic<u32>;

/// Bits of the blocks before, at and after a block's node, the `place`th of four along an axis, that lie within `reach` of it;
/// `stride` bits apart.
fn along(place: u32, reach: u32, stride: u32) -> u32 {
    let before = select(0u, 1u, place < reach);
    let after = select(0u, 1u, place + reach > 3u);
    return before | (1u << stride) | (after << (2u * stride));
}

/// The same along all axes.
fn about(at: vec3<u32>, reach: u32) -> u32 {
    return along(at.x, reach, 1u) * along(at.y, reach, 3u) * along(at.z, reach, 9u);
}

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    if (local == 0u) {
        atomicStore(&near, 0u);
        atomicStore(&reached, 0u);
    }
    workgroupBarrier();
    // What this pass claims itself is counted in the first three.
    if (group.x == 0u && local < 3u) { atomicStore(&colour_args[4u + local], groups[local]); }
    let slot = colour_used[group.x];
    if (colour[slot * BLOCK_NODES + local] != 0u) {
        let at = vec3<u32>(node_of(local));
        atomicOr(&near, about(at, NEAR));
        atomicOr(&reached, about(at, NEAR + 1u));
    }
    workgroupBarrier();
    if (local >= 27u || (atomicLoad(&reached) & (1u << local)) == 0u) { return; }
    let own = colour_blocks[slot];
    let offset = vec3<i32>(vec3<u32>(local % 3u, (local / 3u) % 3u, local / 9u)) - vec3<i32>(1);
    let other = claim(own.xyz + offset, u32(own.w));
    if (other != NO_BLOCK && (atomicLoad(&near) & (1u << local)) != 0u) { atomicStore(&colour_keys[BLOCK_SLOTS + other], 1u); }
}
