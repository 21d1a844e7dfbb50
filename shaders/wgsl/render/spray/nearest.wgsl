//! The nearest drop of spray at each pixel, by two runs over them, as those over spheres are (`spheres/nearest.wgsl`): the first finds
//! its depth, the second its number.

//!include common/picture/sphere_marks.wgsl
//!include common/picture/spray_drops.wgsl

struct SprayRun {
    /// Whether this run finds numbers.
    numbers: u32,
}

var<immediate> run: SprayRun;

@group(0) @binding(1) var<storage, read> flights: array<Flight>;
@group(0) @binding(5) var<storage, read> flying: array<u32>;
/// Reversed depth; zero where there is none.
@group(0) @binding(2) var<storage, read_write> depths: array<atomic<u32>>;
/// The drop's number, of `MOST_DROPS` a flight, and one more; zero where there is none.
@group(0) @binding(3) var<storage, read_write> nearest: array<atomic<u32>>;

@compute @workgroup_size(FLIGHTS_GROUP)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let place = id.x / MOST_DROPS;
    let k = id.x % MOST_DROPS;
    if (place >= flying[FLYING - 1u]) { return; }
    let number = flying[FLYING + place];
    let eye = id.y;
    // The dispatch is as wide as the renderer; a frame may have fewer views.
    if (eye >= frame.view_count) { return; }
    let flight = flights[number];
    if (k >= flight.drops) { return; }
    let view = &frame.views[eye];
    let centre = drop_place(flight, number, k);
    let depth = ((*view).clip_from_stage * vec4<f32>(centre, 1.0)).w;
    if !(depth > (*view).near) { return; }
    let radius = drawn_drop(flight.radius, depth, (*view).focal).x;
    let s = silhouette_of(Ellipsoid(centre, 0.0, vec3<f32>(radius), 1.0, vec3<f32>(0.0)), eye);
    if (run.numbers == 0u) { mark_tiles(eye, s); }
    for (var y = s.low.y; y < s.high.y; y++) {
        for (var x = s.low.x; x < s.high.x; x++) {
            let reversed = entered_at(s, vec2<f32>(f32(x), f32(y)) + 0.5, (*view).near);
            if (reversed <= 0.0) { continue; }
            let bits = bitcast<u32>(reversed);
            let at = pixel_index(vec2<i32>(x, y), eye);
            if (run.numbers == 0u) {
                atomicMax(&depths[at], bits);
            } else if (atomicLoad(&depths[at]) == bits) {
                atomicMax(&nearest[at], number * MOST_DROPS + k + 1u);
            }
        }
    }
}
