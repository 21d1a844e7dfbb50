// Line 27: XSPH viscosity (Eq. 16) as a velocity update, between particles and
// with walls (whose velocity is line 3's, divided by the time). Within a frame
// it ends with the next substep's prediction, which saves a pass.
//!include common/particle.wgsl
//!include common/kernel.wgsl
//!include common/step.wgsl
//!include common/vessel.wgsl
//!include common/ground.wgsl
//!include common/predict.wgsl

/// Whether the next substep is predicted here.
override PREDICT: bool = false;
/// Whether the liquid has any viscosity.
override VISCOUS: bool = true;

@group(0) @binding(0) var<storage, read> position: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> new_velocity: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> tags: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read> list_counts: array<u32>;
@group(0) @binding(4) var<storage, read> list: array<u32>;
@group(0) @binding(5) var<storage, read> boundary: array<vec4<f32>>;
@group(0) @binding(6) var<storage, read_write> velocity: array<vec4<f32>>;

/// Velocity of flask k's glass at x.
fn wall_velocity(k: u32, x: vec3<f32>) -> vec3<f32> {
    let local = flask_from_stage(poses[step.after + k], x);
    return (x - stage_from_flask(poses[step.before + k], local)) / step.time;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x / LANES;
    let lane = id.x % LANES;
    if (i >= COUNT) { return; }
    let x = position[i].xyz;
    let own = new_velocity[i];
    var sum = vec3<f32>(0.0);
    if (VISCOUS) {
        let count = list_counts[i];
        for (var k = lane; k < count; k += LANES) {
            let j = list[k * COUNT + i];
            let offset = x - position[j].xyz;
            sum += (new_velocity[j].xyz - own.xyz) * spline(sqrt(dot(offset, offset)) / SUPPORT);
        }
        sum = lane_sum3(sum) * weight_scale();
    }
    if (lane != 0u) { return; }
    let tag = tags[i].x;
    var v = own.xyz;
    if (VISCOUS) {
        let solid = boundary[i].w;
        if (solid > 0.0) {
            var wall = vec3<f32>(0.0);
            if (FLASKS > 0u) {
                if (tag != NOBODYS && tag != REMOVED) { wall = wall_velocity(tag - 1u, x); }
            }
            sum += solid * (wall - own.xyz);
        }
        v += step.viscosity * sum;
    }
    velocity[i] = vec4<f32>(v, own.w);
    if (PREDICT) { predict(i, x, v, tag, step.after, step.next); }
}
