//! The nearest ellipsoid at each pixel, as reversed depth: its bits are ordered as the numbers are.

//!include common/picture/splats.wgsl

/// Zero where there is none.
@group(0) @binding(2) var<storage, read_write> depth: array<atomic<u32>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = invocation(id);
    let particle = index / LANES;
    let eye = id.y;
    if (particle >= splats.count) { return; }
    let e = ellipsoids[particle];
    // What lies deep in the liquid is never seen, and most of it does.
    if !(e.visible > 0.0) { return; }
    let s = silhouette_of(e, eye);
    let near = frame.views[eye].near;
    let lane = vec2<i32>(i32(index % 8u), i32(index % LANES / 8u));
    for (var y = s.low.y + lane.y; y < s.high.y; y += i32(LANES / 8u)) {
        for (var x = s.low.x + lane.x; x < s.high.x; x += 8) {
            let reversed = entered_at(s, vec2<f32>(f32(x), f32(y)) + 0.5, near);
            if (reversed > 0.0) {
                atomicMax(&depth[pixel_index(vec2<i32>(x, y), eye)], bitcast<u32>(reversed));
            }
        }
    }
}
