//! Depths at half the picture's resolution: of each two by two pixels the nearest that is seen.
//!
//! A runtime moves pixels by them to where the head is when the picture is seen. By the nearest one the ground next to a hand moves
//! with the hand, which is hardly seen; by any other the hand's edge would move with the ground, and tear off.

struct DepthSizes {
    /// Width and height of a view as drawn, pixels.
    drawn: vec2<u32>,
    /// The same of the array that holds it.
    held: vec2<u32>,
    /// The same of what is written.
    kept: vec2<u32>,
}

var<immediate> sizes: DepthSizes;

/// Reversed depths of all views' pixels, row by row, view by view.
@group(0) @binding(0) var<storage, read> depths: array<f32>;
@group(0) @binding(1) var<storage, read_write> halved: array<f32>;

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let count = (sizes.drawn + 1u) / 2u;
    if (any(id.xy >= count)) { return; }
    // Both cover the same field of view: of an odd number of pixels each has a little less than two.
    let first = id.xy * sizes.drawn / count;
    let end = ((id.xy + 1u) * sizes.drawn + count - 1u) / count;
    var nearest = 0.0;
    var hidden = true;
    for (var y = first.y; y < end.y; y++) {
        for (var x = first.x; x < end.x; x++) {
            let depth = depths[(id.z * sizes.held.y + y) * sizes.held.x + x];
            // What lenses hide has the near plane's, and is to move nothing that is seen.
            if (depth < 1.0) {
                nearest = max(nearest, depth);
                hidden = false;
            }
        }
    }
    halved[(id.z * sizes.kept.y + id.y) * sizes.kept.x + id.x] = select(nearest, 1.0, hidden);
}
