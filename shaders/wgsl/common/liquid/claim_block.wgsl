// Claiming blocks of colour's nodes.
//!include common/liquid/colour.wgsl

/// Blocks from which on the table is full, and tension is left out.
override MOST_BLOCKS: u32 = 48u;

/// Keys by slot, and after them whether the slot's block lies near colour.
@group(0) @binding(40) var<storage, read_write> colour_keys: array<atomic<u32>>;
@group(0) @binding(41) var<storage, read_write> colour_used: array<u32>;
@group(0) @binding(42) var<storage, read_write> colour_blocks: array<vec4<i32>>;
/// Blocks claimed: the dispatch size of the passes over them. Then that of the passes over those with a particle's nodes.
@group(0) @binding(43) var<storage, read_write> colour_args: array<atomic<u32>>;

/// Slot of the block, which is made where there is none yet.
fn claim(block: vec3<i32>, grid: u32) -> u32 {
    let key = block_key(block, grid);
    var slot = slot_of(key);
    for (var tries = 0u; tries < BLOCK_SLOTS; tries++) {
        let seen = atomicLoad(&colour_keys[slot]);
        if (seen == key) { return slot; }
        if (seen == 0u) {
            if (atomicLoad(&colour_args[0]) >= MOST_BLOCKS) { return NO_BLOCK; }
            let old = atomicCompareExchangeWeak(&colour_keys[slot], 0u, key).old_value;
            if (old == 0u) {
                colour_used[atomicAdd(&colour_args[0], 1u)] = slot;
                colour_blocks[slot] = pack_block(block, grid);
                return slot;
            }
            if (old == key) { return slot; }
        }
        slot = (slot + 1u) & (BLOCK_SLOTS - 1u);
    }
    return NO_BLOCK;
}
