// Where the neighbour list has a particle's neighbours: in fours, the first fours of the particles of a block side by side, and then their
// next. So a processor reads a block's list on through memory, which its caches foresee, and a GPU 512 bytes at a time. With the
// fours of all particles side by side each load of a processor would be far from the one before.

/// Particles of a block. With 8, a million particles take 3 % longer on an H100.
const LIST_BLOCK: u32 = 32u;

/// Place of fours `g` of particle i among all fours, where each particle has room for `most`.
fn four_in_blocks(g: u32, i: u32, most: u32) -> u32 {
    return (i / LIST_BLOCK * most + g) * LIST_BLOCK + i % LIST_BLOCK;
}

/// Fours of all particles' places, and those behind them for the lists that are longer. If the long lists ask for more in all, none of them has any,
/// because the order in which they ask is one of chance.
override PLACES: u32 = 0u;
override LONG_FOURS: u32 = 0u;
