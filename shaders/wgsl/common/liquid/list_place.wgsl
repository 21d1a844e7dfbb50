// Where the neighbour list has a particle's neighbours: in fours, the fours of eight particles side by side, and then the next fours of
// the same eight. So a vector of eight invocations reads on through memory, which a processor's caches foresee; with the fours of all
// particles side by side each of its loads would be far from the one before.
//!include common/liquid/particle.wgsl

/// Particles whose fours lie side by side: the invocations of a software driver's vector. In hardware 128 bytes, a line of its cache.
const LIST_BLOCK: u32 = 8u;

/// Place of fours `g` of particle i among all fours.
fn place_of_four(g: u32, i: u32) -> u32 {
    return (i / LIST_BLOCK * (LIST_CAPACITY / 4u) + g) * LIST_BLOCK + i % LIST_BLOCK;
}
