//! The part of the picture that the headset's lenses hide.

//!include common/frame.wgsl

/// A bit a pixel, row by row, each row in whole words; bits past a row's end are set. One word of
/// zero where nothing is hidden.
@group(0) @binding(4) var<storage, read> hidden_area: array<u32>;

/// Bits of the 32 pixels from 32 `column` on.
fn hidden_word(column: u32, y: u32, eye: u32) -> u32 {
    let index = (eye * u32(frame.extent.y) + y) * frame.tile_columns + column;
    return hidden_area[select(0u, index, frame.hides != 0u)];
}

fn is_hidden(pixel: vec2<i32>, eye: u32) -> bool {
    let x = u32(pixel.x);
    return ((hidden_word(x / 32u, u32(pixel.y), eye) >> (x & 31u)) & 1u) != 0u;
}
