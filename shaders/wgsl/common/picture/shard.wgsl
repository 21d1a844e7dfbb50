//! Which glass of a broken vessel a shard is: its base, or a third of the wall over that. Cracks run in zigzags, the same for both sides of one.

//!include common/picture/frame.wgsl

/// Of a turn, which each shard of the wall takes up, rad.
const THIRD = 2.0943951;
/// How far a crack goes up and down in a round of zigzags, over the vessel's outer radius, and to both sides, rad.
const RAGGED = vec2<f32>(0.10, 0.16);

/// From −1 to 1 and back, once for each whole of t.
fn zigzag(t: f32) -> f32 {
    return 4.0 * abs(fract(t) - 0.5) - 1.0;
}

/// Where the crack between two of the wall's shards is beside its straight line, rad, at height y.
fn strays(index: u32, crack: u32, y: f32) -> f32 {
    let turns = y / frame.vessels[index].outer;
    return RAGGED.y * (zigzag(1.3 * turns + 0.37 * f32(crack)) + 0.4 * zigzag(4.1 * turns + 0.71 * f32(crack)));
}

/// How far within shard `index` a place of its vessel's glass is (vessel's frame), along the wall; negative beside it.
fn within_shard(index: u32, p: vec3<f32>) -> f32 {
    let piece = frame.vessels[index].piece;
    if (piece == 0u) { return 1e9; }
    let angle = atan2(p.z, p.x);
    let outer = frame.vessels[index].outer;
    let turn = angle / (3.0 * THIRD);
    let up = p.y - frame.vessels[index].base - RAGGED.x * outer * (zigzag(5.0 * turn) + 0.5 * zigzag(13.0 * turn));
    if (piece == 1u) { return -up; }
    let wall = piece - 2u;
    // From the shard's middle, within half a turn.
    let aside = angle - (f32(wall) + 0.5) * THIRD;
    let middle = aside - 3.0 * THIRD * round(aside / (3.0 * THIRD));
    let low = middle + 0.5 * THIRD - strays(index, wall, p.y);
    let high = 0.5 * THIRD + strays(index, (wall + 1u) % 3u, p.y) - middle;
    return min(up, length(p.xz) * min(low, high));
}
