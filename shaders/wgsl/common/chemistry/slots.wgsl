/// Places for bubbles, in groups of 64.
override SLOTS: u32 = 64u;
/// Whether what bubbles throw up is followed.
override SPRAY: bool = false;

/// Where in `claims`, behind the places, the size of the dispatch of `sim/live.wgsl` is: 0 while there is nothing to be listed. What claims
/// a place wakes it, and `sim/vent.wgsl` puts it to sleep.
const LIVE_GROUPS: u32 = 0u;
/// Where behind the places the size of the dispatch of `sim/census_bubbles.wgsl` is: 0 while there was nothing since the last look. What claims
/// a place wakes it, and `sim/census.wgsl` puts it to sleep.
const LOOK_GROUPS: u32 = 4u;
