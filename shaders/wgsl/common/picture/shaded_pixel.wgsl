//! Which pixel of a block is shaded.

//!include common/picture/frame.wgsl

/// That of a block of `side` by `side` pixels with its upper left one there; at the picture's edge the last one of it.
fn shaded_in(low: vec2<i32>, side: i32) -> vec2<i32> {
    return min(low + side / 2, vec2<i32>(frame.extent) - 1);
}
