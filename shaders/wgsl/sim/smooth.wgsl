// One pass of the filter over the flow: some of a particle's becomes the mean around it.
// `reference/eddies.rs` is the same in f64.
//!include common/chemistry/flow.wgsl
//!include common/liquid/awake.wgsl
//!include common/liquid/kernel.wgsl
//!include common/liquid/listed.wgsl
//!include common/liquid/particle.wgsl

/// Share of the mean.
override SHARE: f32 = 1.0;

@group(0) @binding(0) var<storage, read> position: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> list_counts: array<u32>;
@group(0) @binding(2) var<storage, read> list: array<vec4<u32>>;
@group(0) @binding(3) var<storage, read_write> smoothed: array<vec4<f32>>;

@compute @workgroup_size(GROUP)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x / LANES;
    let lane = id.x % LANES;
    if (i >= awake_count()) { return; }
    let x = position[i].xyz;
    let own = flow_at(i);
    var change = vec3<f32>(0.0);
    var rest = vec2<f32>(0.0);
    let listed = listed_of(i);
    for (var g = lane; g * 4u < listed.count; g += LANES) {
        let four = list[listed.first + g * listed.stride];
        for (var n = 0u; n < 4u; n++) {
            let j = four[n];
            let offset = x - position[j].xyz;
            // What fills up the last four is the particle itself.
            let weight = select(spline(length(offset) * INVERSE_SUPPORT), 0.0, j == i);
            let apart = flow_at(j) - own;
            change += apart.xyz * weight;
            rest += vec2<f32>(apart.w, 1.0) * weight;
        }
    }
    change = lane_sum3(change);
    let density = lane_sum(rest.x);
    let whole = spline(0.0) + lane_sum(rest.y);
    if (lane == 0u) { smoothed[i] = own + vec4<f32>(change, density) * (SHARE / whole); }
}
