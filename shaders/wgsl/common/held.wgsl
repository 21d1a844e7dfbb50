//! Blocks of four pixels that hold a thickness: it is smooth.

//!include common/frame.wgsl

/// Parts of a spacing that thickness is counted in: 4096 spacings fit.
const PARTS = 1048576.0;

fn blocks() -> vec2<u32> {
    return (vec2<u32>(frame.extent) + 1u) / 2u;
}

fn block_index(block: vec2<i32>, eye: u32) -> u32 {
    let count = blocks();
    return (eye * count.y + u32(block.y)) * count.x + u32(block.x);
}
