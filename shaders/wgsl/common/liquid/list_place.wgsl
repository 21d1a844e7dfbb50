// The solver's own place of a particle's neighbours.
//!include common/liquid/list_block.wgsl
//!include common/liquid/particle.wgsl

/// Place of fours `g` of particle i among all fours.
fn place_of_four(g: u32, i: u32) -> u32 {
    return four_in_blocks(g, i, LIST_CAPACITY / 4u);
}
