//! Which puffs a tile has.

/// Words of a bit a puff: for 1024 puffs, as many as the solver keeps.
const PUFF_WORDS = 32u;
