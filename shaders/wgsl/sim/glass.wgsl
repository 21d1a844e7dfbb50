// What the liquid did to the glass in a frame: its rings warm, conduct and lose heat to the air. One workgroup
// a flask. `chemistry/wall_heat.rs` is the same in f64.
//!include common/chemistry/compensated.wgsl
//!include common/glass/glass_rings.wgsl

/// Δt_f, s.
override FRAME_TIME: f32 = 0.0111;
/// T of what is around, °C.
override AMBIENT: f32 = 20.0;

/// T (°C) of each ring, and what it lacks by rounding.
@group(0) @binding(0) var<storage, read_write> glass: array<vec2<f32>>;
/// Quanta of heat that the liquid took from it.
@group(0) @binding(1) var<storage, read_write> glass_taken: array<atomic<i32>>;

var<workgroup> temperatures: array<f32, GLASS_RINGS>;

@compute @workgroup_size(32)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(local_invocation_index) k: u32) {
    let own = glass[id.x];
    temperatures[k] = own.x;
    workgroupBarrier();
    let ring = glass_rings[id.x];
    var power = ring.to_air * (AMBIENT - own.x) + ring.heated;
    if (k + 1u < GLASS_RINGS) { power += ring.upwards * (temperatures[k + 1u] - own.x); }
    if (k > 0u) { power += glass_rings[id.x - 1u].upwards * (temperatures[k - 1u] - own.x); }
    let given = -f32(atomicExchange(&glass_taken[id.x], 0)) * ring.quantum;
    let sum = compensated(Compensated(own.x, own.y), (given + FRAME_TIME * power) / ring.capacity);
    glass[id.x] = vec2<f32>(sum.value, sum.lacking);
}
