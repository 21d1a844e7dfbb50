//! What a tile of the picture has in it, as bits.

/// Pixels along a tile's edge.
const TILE = 32u;

/// Bit v: vessel or shard v. Liquid:
const MARK_LIQUID = 0x80000000u;
/// An edge that is neither liquid's nor a vessel's.
const MARK_EDGE = 0x40000000u;
const MARK_STEAM = 0x20000000u;
/// Particles as coloured spheres.
const MARK_SPHERES = 0x10000000u;
const MARK_HANDS = 0x08000000u;
const MARK_VESSELS = 0xffffffu;

/// Words of a tile's bits for puffs of steam, a bit a puff: for 1024 puffs, as many as the solver keeps.
const PUFF_WORDS = 32u;
