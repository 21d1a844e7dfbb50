//! Blocks of four pixels that hold a thickness: it is smooth.

//!include common/picture/frame.wgsl

/// Parts of a spacing that thickness is counted in: 4096 spacings fit.
const PARTS = 1048576.0;

/// How many the picture has.
fn blocks() -> vec2<u32> {
    return (vec2<u32>(frame.extent) + 1u) / 2u;
}

/// Where a block is in arrays of all eyes' blocks.
fn block_index(block: vec2<i32>, eye: u32) -> u32 {
    let count = (vec2<u32>(frame.held) + 1u) / 2u;
    return (eye * count.y + u32(block.y)) * count.x + u32(block.x);
}
