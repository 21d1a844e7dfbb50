//! The part of the picture that the headset's lenses hide.

//!include common/picture/frame.wgsl

/// A bit a pixel of the largest picture, row by row, each row in whole words; bits past a row's end are
/// set. One word of zero where nothing is hidden.
@group(0) @binding(4) var<storage, read> hidden_area: array<u32>;

/// The largest picture's pixel at a place of this one, where that is smaller.
fn in_mask(place: vec2<f32>) -> vec2<u32> {
    return vec2<u32>(clamp(floor(place * frame.held / frame.extent), vec2<f32>(0.0), frame.held - 1.0));
}

fn hidden_word(column: u32, y: u32, eye: u32) -> u32 {
    let held = vec2<u32>(frame.held);
    let index = (eye * held.y + y) * ((held.x + 31u) / 32u) + column;
    return hidden_area[select(0u, index, frame.hides != 0u)];
}

fn is_hidden(pixel: vec2<i32>, eye: u32) -> bool {
    let at = in_mask(vec2<f32>(pixel) + 0.5);
    return ((hidden_word(at.x / 32u, at.y, eye) >> (at.x & 31u)) & 1u) != 0u;
}

/// Whether all pixels from the first to before the second are.
fn is_all_hidden(low: vec2<u32>, high: vec2<u32>, eye: u32) -> bool {
    let first = in_mask(vec2<f32>(low) + 0.5);
    let last = in_mask(vec2<f32>(high) - 0.5);
    var hidden = frame.hides != 0u;
    for (var column = first.x / 32u; column <= last.x / 32u; column++) {
        // Bits of the word before the first pixel, and after the last.
        let before = select(0u, (1u << (first.x & 31u)) - 1u, column == first.x / 32u);
        let after = select(0u, ~(0xffffffffu >> (31u - (last.x & 31u))), column == last.x / 32u);
        for (var y = first.y; y <= last.y; y++) {
            hidden = hidden && (hidden_word(column, y, eye) | before | after) == 0xffffffffu;
        }
    }
    return hidden;
}
