// The blocks, at most two along each axis, that 4 × 4 × 4 nodes about a particle lie in: each is looked up once, and not for each row
// of nodes. The including shader says by `block_slot` how.
//!include common/liquid/colour.wgsl
//!include common/liquid/lane_sums.wgsl

struct BlocksAbout {
    grid: u32,
    /// The first node's.
    low: vec3<i32>,
    /// Whether there are two: bits along x, y and z.
    two: u32,
}

fn blocks_about(grid: u32, first: vec3<i32>) -> BlocksAbout {
    let low = first >> vec3<u32>(2u);
    let two = select(vec3<u32>(0u), vec3<u32>(1u, 2u, 4u), ((first + vec3<i32>(3)) >> vec3<u32>(2u)) != low);
    return BlocksAbout(grid, low, two.x | two.y | two.z);
}

/// Slot of the block that lies `place` further, in bits along x, y and z.
fn slot_of_block(blocks: BlocksAbout, place: u32) -> u32 {
    return block_slot(blocks.low + vec3<i32>(vec3<u32>(place & 1u, (place >> 1u) & 1u, place >> 2u)), blocks.grid);
}

/// Slots by place. Where there is one block along an axis, it has both places.
fn slots_alone(blocks: BlocksAbout) -> array<u32, 8> {
    var slots: array<u32, 8>;
    for (var place = 0u; place < 8u; place++) {
        let own = place & blocks.two;
        if (own == place) { slots[place] = slot_of_block(blocks, own); } else { slots[place] = slots[own]; }
    }
    return slots;
}

/// The same by all lanes of a particle, each of which looks up some. `in_subgroup` is the invocation's number in its subgroup.
fn slots_together(blocks: BlocksAbout, lane: u32, in_subgroup: u32) -> array<u32, 8> {
    if (LANES == 1u) { return slots_alone(blocks); }
    var slots: array<u32, 8>;
    for (var first = 0u; first < 8u; first += LANES) {
        let own = slot_of_block(blocks, (first + lane) & blocks.two);
        for (var other = 0u; other < LANES; other++) {
            slots[first + other] = subgroupShuffle(own, in_subgroup - lane + other);
        }
    }
    return slots;
}

/// Place of the block that a row of nodes along x begins in, whose first node is `row`; `first` is the first of all.
fn place_of_row(first: vec3<i32>, row: vec3<i32>) -> u32 {
    let further = vec3<u32>((row >> vec3<u32>(2u)) - (first >> vec3<u32>(2u)));
    return (further.y << 1u) | (further.z << 2u);
}

/// Place of the block of its ith node.
fn place_in_row(row_place: u32, row: vec3<i32>, i: i32) -> u32 {
    return row_place + u32(((row.x & 3) + i) >> 2u);
}
