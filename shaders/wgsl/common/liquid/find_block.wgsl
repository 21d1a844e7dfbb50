// Finding a block of colour's nodes that was claimed before.
//!include common/liquid/colour.wgsl

/// Keys by slot, and after them whether the slot's block lies near colour.
@group(0) @binding(40) var<storage, read> colour_keys: array<u32>;

/// Whether a block has a node that colour acts on. The others are there for what is solid of them.
fn is_near_colour(slot: u32) -> bool {
    return colour_keys[BLOCK_SLOTS + slot] != 0u;
}

/// Slot of the block, or NO_BLOCK.
fn find_block(block: vec3<i32>, grid: u32) -> u32 {
    let key = block_key(block, grid);
    var slot = slot_of(key);
    for (var tries = 0u; tries < BLOCK_SLOTS; tries++) {
        let seen = colour_keys[slot];
        if (seen == key) { return slot; }
        if (seen == 0u) { return NO_BLOCK; }
        slot = (slot + 1u) & (BLOCK_SLOTS - 1u);
    }
    return NO_BLOCK;
}
