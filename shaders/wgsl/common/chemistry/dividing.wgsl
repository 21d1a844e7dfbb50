// Which bubble divides into an empty place. For passes that bind `bubbles`.
//!include common/chemistry/bubble.wgsl
//!include common/chemistry/live_places.wgsl

/// The first bubble that divides of those whose half may come to a place, in the set of records from `first` on.
fn parent_of(slot: u32, first: u32) -> u32 {
    if (is_there(bubbles[first + slot])) { return NO_PARENT; }
    for (var n = 0u; n < HALVES; n++) {
        let parent = slot ^ (1u << n);
        if (parent < SLOTS && is_there(bubbles[first + parent]) && bubbles[first + parent].divides > 0.0) { return parent; }
    }
    return NO_PARENT;
}
