//! The solver's neighbour list, for tests that read or write it.

/// Number of particles in a block.
const BLOCK: usize = 32;

/// Words of the list of `count` particles, each of which has room for `capacity` neighbours.
pub fn words(count: usize, capacity: usize) -> usize {
    count.next_multiple_of(BLOCK) * capacity
}

/// The word that has neighbour k of a particle: in fours, the first fours of a block's particles side by side, and then their next.
pub fn place(particle: usize, k: usize, capacity: usize) -> usize {
    let (block, within) = (particle / BLOCK, particle % BLOCK);
    ((block * (capacity / 4) + k / 4) * BLOCK + within) * 4 + k % 4
}
