//! How much liquid each ray passes through, and how much of that is acid, added up.
//!
//! A particle spreads its volume d³ over the disc of its silhouette with the weight 1 − ρ²: the
//! sum over the picture is the liquid's true volume whatever the ellipsoids' sizes, and no pixel
//! sees where one begins. (Chords of the ellipsoids would count each overlap twice.) Sums are of
//! whole numbers, so that their order does not show.

//!include common/picture/pixel_blocks.wgsl
//!include common/picture/splats.wgsl

/// Thickness, and its part that is acid, of each block of four pixels, in parts of a spacing.
@group(0) @binding(2) var<storage, read_write> sums: array<atomic<u32>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = invocation(id);
    let particle = index / LANES;
    let eye = id.y;
    if (particle >= splats.count) { return; }
    let e = ellipsoids[particle];
    if !(e.visible >= 0.0) { return; }
    let s = silhouette_of(e, eye);
    // In the sphere's space a ray at ρ goes 2κq/(1 − κ²q²) of its way to the silhouette's plane
    // through the sphere, κ = 1/|o|, q² = 1 − ρ²; that way has the view depth of the plane, near
    // enough that of the centre. 4/3 (1 − ρ²) has the integral of q over the disc.
    let centre = frame.views[eye].clip_from_stage * vec4<f32>(e.centre, 1.0);
    let d = frame.spacing;
    let volume = d * d * d / (4.18879 * max(s.determinant, 1e-30));
    let middle = 2.6666667 * inverseSqrt(s.beyond + 1.0) * centre.w * volume / d * PARTS;
    let lane = vec2<i32>(i32(index % 8u), i32(index % LANES / 8u));
    let low = s.low / 2;
    let high = (s.high + 1) / 2;
    for (var y = low.y + lane.y; y < high.y; y += i32(LANES / 8u)) {
        for (var x = low.x + lane.x; x < high.x; x += 8) {
            let ray = ray_at(s, 2.0 * (vec2<f32>(f32(x), f32(y)) + 0.5));
            // ρ² = tan² of the angle to the centre over tan² of the silhouette's.
            let share = 1.0 - ray.miss * s.beyond / (ray.towards * ray.towards);
            if (share > 0.0 && ray.towards > 0.0) {
                let block = 2u * block_index(vec2<i32>(x, y), eye);
                atomicAdd(&sums[block], u32(middle * share));
                if (e.acid > 0.0) { atomicAdd(&sums[block + 1u], u32(middle * share * e.acid)); }
            }
        }
    }
}
