//! The nearest of all coloured spheres at each pixel, by two runs over them: the first finds its reversed
//! depth, whose bits are ordered as the numbers are, the second its number. One pipeline does both, so
//! that both find the same bits.

//!include common/liquid/position.wgsl
//!include common/picture/lanes.wgsl
//!include common/picture/sphere_marks.wgsl

struct SphereRun {
    /// Number of particles.
    count: u32,
    /// Invocations that share one: rows of eight.
    lanes: u32,
    /// Radius as drawn, in the scene's unit.
    radius: f32,
    /// Whether this run finds numbers.
    numbers: u32,
}

var<immediate> run: SphereRun;

@group(0) @binding(1) var<storage, read> positions: array<vec4<f32>>;
/// Zero where there is none.
@group(0) @binding(2) var<storage, read_write> depths: array<atomic<u32>>;
/// The sphere's number and one more; zero where there is none.
@group(0) @binding(3) var<storage, read_write> nearest: array<atomic<u32>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = invocation(id);
    let particle = index / run.lanes;
    let lane = index % run.lanes;
    let eye = id.y;
    if (particle >= run.count) { return; }
    let place = positions[particle];
    if (is_taken_out(place)) { return; }
    let ball = Ellipsoid(place.xyz, 0.0, vec3<f32>(run.radius), 1.0, vec3<f32>(0.0));
    let s = silhouette_of(ball, eye);
    if (lane == 0u && run.numbers == 0u) { mark_tiles(eye, s); }
    let near = frame.views[eye].near;
    for (var y = s.low.y + i32(lane / 8u); y < s.high.y; y += i32(run.lanes / 8u)) {
        for (var x = s.low.x + i32(lane % 8u); x < s.high.x; x += 8) {
            let reversed = entered_at(s, vec2<f32>(f32(x), f32(y)) + 0.5, near);
            if (reversed > 0.0) {
                let bits = bitcast<u32>(reversed);
                let at = pixel_index(vec2<i32>(x, y), eye);
                if (run.numbers == 0u) {
                    atomicMax(&depths[at], bits);
                } else if (atomicLoad(&depths[at]) == bits) {
                    // Of two at the same place the later one, whatever the order of invocations.
                    atomicMax(&nearest[at], particle + 1u);
                }
            }
        }
    }
}
