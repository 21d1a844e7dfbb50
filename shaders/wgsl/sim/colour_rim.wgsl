// Line 28, surface tension, 2 of 7: claims the blocks around those that hold liquid, since colour reaches further than where it
// is found. By block and not by particle, which would look each of them up a hundred times.
//!include common/liquid/claim_block.wgsl

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    if (local >= 27u) { return; }
    let own = colour_blocks[colour_used[group.x]];
    let offset = vec3<i32>(vec3<u32>(local % 3u, (local / 3u) % 3u, local / 9u)) - vec3<i32>(1);
    claim(own.xyz + offset, u32(own.w));
}
