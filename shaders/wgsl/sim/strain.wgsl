// The eddies that the next frame's liquid mixes by: Smagorinsky's, of the filtered flow's rate of strain and
// stratification. `reference/eddies.rs` and `chemistry/eddies.rs` are the same in f64.
//!include common/chemistry/bubbled.wgsl
//!include common/chemistry/bulk.wgsl
//!include common/chemistry/eddies.wgsl
//!include common/chemistry/features.wgsl
//!include common/chemistry/flow.wgsl
//!include common/chemistry/turnover_plan.wgsl
//!include common/liquid/awake.wgsl
//!include common/liquid/kernel.wgsl
//!include common/liquid/listed.wgsl
//!include common/liquid/particle.wgsl

override GRAVITY_X: f32 = 0.0;
override GRAVITY_Y: f32 = -9.81;
override GRAVITY_Z: f32 = 0.0;
/// Least part of a full neighbourhood's first moment by which a gradient is normalised: a level surface's.
const LEAST_MOMENT: f32 = 0.6;

@group(0) @binding(0) var<storage, read> position: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> list_counts: array<u32>;
@group(0) @binding(2) var<storage, read> list: array<vec4<u32>>;
@group(0) @binding(3) var<storage, read_write> eddies: array<vec2<f32>>;

@group(0) @binding(40) var<storage, read> tags: array<vec2<u32>>;
@group(0) @binding(41) var<storage, read> bubbled: array<vec4<i32>>;

/// Eddies of bubbles over void fraction, diameter and speed (Sato and Sekoguchi 1975).
const BUBBLE_EDDIES: f32 = 0.6;

/// K of the bubbles that rise past a particle, m²/s: its gas is a share of its volume.
fn stirred_by_bubbles(i: u32) -> f32 {
    if (!BUBBLES) { return 0.0; }
    let swept = f32(bubbled[BUBBLED_VECTORS * tags[i].y + 1u].w) * STIRRING_QUANTUM;
    return BUBBLE_EDDIES / SCHMIDT * swept / unpack_bulk(bulk[i]).volume;
}

@compute @workgroup_size(GROUP)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x / LANES;
    let lane = id.x % LANES;
    if (i >= awake_count()) { return; }
    let x = position[i].xyz;
    let own = flow_at(i);
    // ∇v by its diagonal and what mirrors itself across it, ∇ρ, and the first moment.
    var along = vec3<f32>(0.0);
    var across = vec3<f32>(0.0);
    var density = vec3<f32>(0.0);
    var moment = 0.0;
    let listed = listed_of(i);
    for (var g = lane; g * 4u < listed.count; g += LANES) {
        let four = list[listed.first + g * listed.stride];
        for (var n = 0u; n < 4u; n++) {
            let j = four[n];
            let offset = x - position[j].xyz;
            let square = max(dot(offset, offset), 1e-12 * SUPPORT * SUPPORT);
            let per_distance = inverseSqrt(square);
            let slope = per_distance * spline_slope(square * per_distance * INVERSE_SUPPORT);
            let change = flow_at(j) - own;
            along += change.xyz * offset * slope;
            across += (change.yzx * offset.zxy + change.zxy * offset.yzx) * slope;
            density += offset * (slope * change.w);
            moment -= slope * dot(offset, offset);
        }
    }
    let scale = weight_scale() / SUPPORT;
    moment = lane_sum(moment) * scale / 3.0;
    let per_moment = scale / max(moment, LEAST_MOMENT);
    along = lane_sum3(along) * per_moment;
    across = lane_sum3(across) * per_moment;
    density = lane_sum3(density) * per_moment;
    if (lane != 0u) { return; }
    // Without what expands.
    along -= vec3<f32>((along.x + along.y + along.z) / 3.0);
    // 2 S:S, where an element beside the diagonal is half of `across` and is there twice.
    let strain = 2.0 * dot(along, along) + dot(across, across);
    let buoyancy = dot(vec3<f32>(GRAVITY_X, GRAVITY_Y, GRAVITY_Z), density) / own.w;
    let rate = sqrt(max(strain - buoyancy / SCHMIDT, 0.0));
    let diffusivity = EDDY_AREA * rate + stirred_by_bubbles(i);
    if (DORMANT_TURNOVER) { note_eddies(diffusivity); }
    eddies[i] = pack_eddies(Eddies(diffusivity, unpack_eddies(eddies[i]).variance));
}
