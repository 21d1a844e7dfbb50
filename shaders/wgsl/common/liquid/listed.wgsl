// Where a pass over neighbours finds those of a particle: in the particle's own place, or among the long lists if there are more than fit there.
// So both of a pair know it, and the pushes of a crowd balance.
//!include common/liquid/list_block.wgsl
//!include common/liquid/particle.wgsl

/// Fours that all long lists have asked for, and then the first of each particle's, behind all places.
@group(0) @binding(52) var<storage, read> long_lists: array<u32>;

/// A particle's neighbours: its fours lie `stride` apart from `first` on.
struct Listed {
    count: u32,
    first: u32,
    stride: u32,
}

fn listed_of(i: u32) -> Listed {
    let count = list_counts[i];
    let place = four_in_blocks(0u, i, LIST_CAPACITY / 4u);
    // Returns, and no variable that a branch changes: with that an H100 takes 1 % more of a frame.
    if (count > LIST_CAPACITY) {
        if (long_lists[0] <= LONG_FOURS) { return Listed(count, PLACES + long_lists[1u + i], 1u); }
        return Listed(LIST_CAPACITY, place, LIST_BLOCK);
    }
    return Listed(count, place, LIST_BLOCK);
}
