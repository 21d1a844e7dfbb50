// Line 28, first half: ω = ∇ × v of each particle (Macklin & Müller 2013,
// Eq. 15), of the velocities before viscosity. A pass of its own: confinement
// needs the neighbours' ω.
//!include common/liquid/awake.wgsl
//!include common/liquid/kernel.wgsl
//!include common/liquid/listed.wgsl
//!include common/liquid/particle.wgsl
//!include common/liquid/vorticity.wgsl

@group(0) @binding(0) var<storage, read> position: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> new_velocity: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> list_counts: array<u32>;
@group(0) @binding(3) var<storage, read> list: array<vec4<u32>>;
@group(0) @binding(4) var<storage, read_write> vorticity: array<vec4<f32>>;

@compute @workgroup_size(GROUP)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x / LANES;
    let lane = id.x % LANES;
    if (i >= awake_count()) { return; }
    let x = position[i].xyz;
    let own = new_velocity[i].xyz;
    var sum = vec3<f32>(0.0);
    let listed = listed_of(i);
    for (var g = lane; g * 4u < listed.count; g += LANES) {
        let four = list[listed.first + g * listed.stride];
        for (var n = 0u; n < 4u; n++) {
            let j = four[n];
            let offset = x - position[j].xyz;
            let square = max(dot(offset, offset), 1e-12 * SUPPORT * SUPPORT);
            let per_distance = inverseSqrt(square);
            let slope = per_distance * spline_slope(square * per_distance * INVERSE_SUPPORT);
            sum += cross(offset, new_velocity[j].xyz - own) * slope;
        }
    }
    let omega = lane_sum3(sum) * (weight_scale() / SUPPORT);
    if (lane == 0u) { vorticity[i] = pack_vorticity(omega); }
}
