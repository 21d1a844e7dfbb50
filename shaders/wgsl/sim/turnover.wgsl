// Line 26 of the physical chemistry, before its exchange: what each particle may keep of the exchange that
// eddies and molecules ask for, so that it swaps no more than all that it has (`chemistry/transport.rs`).
//
// No scene needs it, and still each substep asks unless all eddies are slow (`common/chemistry/turnover_plan.wgsl`). Where the glass
// leaves the liquid behind after a stall, a turnover that is small in a frame's first substep passes 1 in its others, and without this
// particles would get colder than all there was.
//!include common/chemistry/eddies.wgsl
//!include common/chemistry/heat.wgsl
//!include common/chemistry/transport.wgsl
//!include common/liquid/awake.wgsl
//!include common/liquid/counters.wgsl
//!include common/liquid/full_list.wgsl
//!include common/liquid/kernel.wgsl
//!include common/liquid/listed.wgsl
//!include common/liquid/particle.wgsl
//!include common/liquid/step.wgsl

@group(0) @binding(0) var<storage, read> position: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> list_counts: array<u32>;
@group(0) @binding(2) var<storage, read> list: array<vec4<u32>>;
@group(0) @binding(3) var<storage, read> heat: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read> eddies: array<vec2<f32>>;
/// 1 where the turnover is at most 1, else its inverse; 0 of a particle whose list is full, which exchanges nothing.
@group(0) @binding(5) var<storage, read_write> kept: array<f32>;
@group(0) @binding(6) var<storage, read_write> counters: Counters;

@compute @workgroup_size(GROUP)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x / LANES;
    let lane = id.x % LANES;
    if (i >= awake_count()) { return; }
    let full = full_from(atomicLoad(&counters.list_overflows));
    let is_full = list_counts[i] >= full;
    let x = position[i].xyz;
    let own = unpack_potential(heat[i]);
    let stirred = unpack_eddies(eddies[i]).diffusivity;
    let listed = listed_of(i);
    let count = select(listed.count, 0u, is_full);
    var swapped = vec2<f32>(0.0);
    for (var g = lane; g * 4u < count; g += LANES) {
        let four = list[listed.first + g * listed.stride];
        for (var n = 0u; n < 4u; n++) {
            let j = four[n];
            let offset = x - position[j].xyz;
            let q = sqrt(dot(offset, offset)) * INVERSE_SUPPORT;
            let other = unpack_potential(heat[j]);
            let mean = 0.5 * (stirred + unpack_eddies(eddies[j]).diffusivity);
            swapped += swapped_by(q, own, other, has_whole_list(j, i, full)) * fastest_of(mean);
        }
    }
    swapped = vec2<f32>(lane_sum(swapped.x), lane_sum(swapped.y));
    if (lane != 0u) { return; }
    let shares = swapped / max(own.mass * vec2<f32>(1.0, own.capacity), vec2<f32>(1e-12));
    let turnover = max(shares.x, shares.y);
    kept[i] = select(1.0 / max(turnover, 1.0), 0.0, is_full);
}
