// Particles that have more neighbours than the list has places. They exchange nothing, and their neighbours nothing with them: what they may
// exchange is bounded by the number of places, and among the long lists there may be none for them.
//!include common/liquid/particle.wgsl

/// Number of neighbours from which on a list counts as full: none does as long
/// as nothing overflowed.
fn full_from(overflows: u32) -> u32 {
    return select(0xffffffffu, LIST_CAPACITY + 1u, overflows > 0u);
}

/// 0 where neighbour j's list is full, else 1. `full` is [full_from]'s; while no list is, all ask
/// for the same word.
fn has_whole_list(j: u32, i: u32, full: u32) -> f32 {
    let asked = select(j, i, full == 0xffffffffu);
    return select(1.0, 0.0, list_counts[asked] >= full);
}
