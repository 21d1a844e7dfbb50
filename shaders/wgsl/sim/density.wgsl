// The density of each particle as a fraction of the rest density, for reports.
//!include common/chemistry/bulk.wgsl
//!include common/chemistry/features.wgsl
//!include common/glass/boundary.wgsl
//!include common/liquid/kernel.wgsl
//!include common/liquid/listed.wgsl
//!include common/liquid/particle.wgsl
//!include common/liquid/step.wgsl

@group(0) @binding(0) var<storage, read> position: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> tags: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> list_counts: array<u32>;
@group(0) @binding(3) var<storage, read> list: array<vec4<u32>>;
@group(0) @binding(4) var<storage, read_write> density: array<f32>;
@group(0) @binding(5) var<storage, read> bulk: array<vec4<f32>>;

@compute @workgroup_size(GROUP)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x / LANES;
    let lane = id.x % LANES;
    if (i >= COUNT) { return; }
    let x = position[i].xyz;
    let tag = tags[i].x;
    var sum = 0.0;
    let listed = listed_of(i);
    for (var g = lane; g * 4u < listed.count; g += LANES) {
        let four = list[listed.first + g * listed.stride];
        for (var n = 0u; n < 4u; n++) {
            let j = four[n];
            let offset = x - position[j].xyz;
            var weight = spline(sqrt(dot(offset, offset)) * INVERSE_SUPPORT);
            if (DENSITY) { weight *= unpack_bulk(bulk[j]).volume; }
            // What fills up the last four is the particle itself.
            sum += select(weight, 0.0, j == i);
        }
    }
    var self_weight = spline(0.0);
    if (DENSITY) { self_weight *= unpack_bulk(bulk[i]).volume; }
    sum = (lane_sum(sum) + self_weight) * weight_scale();
    let wall = boundary_volume(tag, x, step.after, lane);
    if (lane == 0u) { density[i] = select(sum + wall_volume(wall), 0.0, tag == REMOVED); }
}
