// Where a pass over neighbours finds those of a particle: in the particle's own place, or among the long lists if there are more than fit there.
// So both of a pair know it, however dense a crowd is, and pushes balance.
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
    var own = Listed(count, four_in_blocks(0u, i, LIST_CAPACITY / 4u), LIST_BLOCK);
    // A loop, because a software driver jumps over one that nobody enters, and walks a branch.
    for (var is_long = count > LIST_CAPACITY; is_long; is_long = false) {
        let fit = long_lists[0] <= LONG_FOURS;
        own.count = select(LIST_CAPACITY, count, fit);
        own.first = select(own.first, PLACES + long_lists[1u + i], fit);
        own.stride = select(LIST_BLOCK, 1u, fit);
    }
    return own;
}
