//! How much liquid each ray passes through, and how much of that is acid, as `render/fluid/thickness.wgsl` adds them up.

//!include common/picture/frame.wgsl
//!include common/picture/pixel_blocks.wgsl

/// Thickness and acid of each block.
@group(0) @binding(3) var<storage, read> sums: array<vec2<u32>>;

/// Thickness (in the scene's unit) and its part that is acid, over some four by four blocks between which it is
/// interpolated: finer than that is the grain of particles.
fn thickness_at(place: vec2<f32>, eye: u32) -> vec2<f32> {
    let at = 0.5 * place - 0.5;
    let first = vec2<i32>(floor(at)) - 1;
    let share = fract(at);
    let last = vec2<i32>(blocks()) - 1;
    var sum = vec2<f32>(0.0);
    for (var y = 0; y < 4; y++) {
        for (var x = 0; x < 4; x++) {
            let block = clamp(first + vec2<i32>(x, y), vec2<i32>(0), last);
            // Linear between blocks, at a block to either side.
            let odd = vec2<bool>((x & 1) == 1, (y & 1) == 1);
            let weight = select(1.0 - share, share, odd);
            sum += weight.x * weight.y * vec2<f32>(sums[block_index(block, eye)]);
        }
    }
    return (0.25 * frame.spacing / PARTS) * sum;
}

/// The same over two by two blocks: with all of the grain, to compare places that are further apart.
fn thickness_near(place: vec2<f32>, eye: u32) -> vec2<f32> {
    let at = 0.5 * place - 0.5;
    let first = vec2<i32>(floor(at));
    let share = fract(at);
    let last = vec2<i32>(blocks()) - 1;
    var sum = vec2<f32>(0.0);
    for (var n = 0; n < 4; n++) {
        let step = vec2<i32>(n & 1, n >> 1u);
        let block = clamp(first + step, vec2<i32>(0), last);
        let weight = select(1.0 - share, share, step == vec2<i32>(1));
        sum += weight.x * weight.y * vec2<f32>(sums[block_index(block, eye)]);
    }
    return (frame.spacing / PARTS) * sum;
}
