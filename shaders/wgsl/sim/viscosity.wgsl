// Line 27, XSPH viscosity (Eq. 16) as a velocity update between particles and
// with walls, and line 28, internal forces. Both read the state that lines 22
// to 25 left, so that one pass over the neighbours serves them. Within a frame
// it ends with the next substep's prediction, which saves another.
//!include common/particle.wgsl
//!include common/kernel.wgsl
//!include common/step.wgsl
//!include common/contact.wgsl
//!include common/forces.wgsl
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
@group(0) @binding(5) var<storage, read_write> velocity: array<vec4<f32>>;
/// (ω, |ω|), 1/s.
@group(0) @binding(6) var<storage, read> vorticity: array<vec4<f32>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x / LANES;
    let lane = id.x % LANES;
    if (i >= COUNT) { return; }
    let x = position[i].xyz;
    let own = new_velocity[i];
    var omega = vec4<f32>(0.0);
    if (CONFINEMENT > 0.0) { omega = vorticity[i]; }

    var drag = vec3<f32>(0.0);
    var eta = vec3<f32>(0.0);
    var attraction = vec3<f32>(0.0);
    if (VISCOUS || CONFINEMENT > 0.0 || COHESION > 0.0) {
        let count = list_counts[i];
        for (var k = lane; k < count; k += LANES) {
            let j = list[k * COUNT + i];
            let offset = x - position[j].xyz;
            let square = max(dot(offset, offset), 1e-12 * SUPPORT * SUPPORT);
            let per_distance = inverseSqrt(square);
            let q = square * per_distance / SUPPORT;
            if (VISCOUS) { drag += (new_velocity[j].xyz - own.xyz) * spline(q); }
            if (CONFINEMENT > 0.0) {
                eta += offset * ((vorticity[j].w - omega.w) * per_distance * spline_slope(q));
            }
            if (COHESION > 0.0) { attraction -= offset * (per_distance * cohesion(q)); }
        }
        if (VISCOUS) { drag = lane_sum3(drag) * weight_scale(); }
        if (CONFINEMENT > 0.0) { eta = lane_sum3(eta) * (weight_scale() / SUPPORT); }
        if (COHESION > 0.0) { attraction = lane_sum3(attraction); }
    }
    let tag = tags[i].x;
    var acceleration = attraction;
    if (VISCOUS || ADHESION > 0.0) {
        let walls = contact(tag, x, own.xyz, lane);
        if (VISCOUS) { drag += walls.drag; }
        if (ADHESION > 0.0) { acceleration += ADHESION * walls.pull; }
    }
    if (lane != 0u) { return; }

    if (CONFINEMENT > 0.0) { acceleration += confinement(eta, omega); }
    var v = own.xyz;
    if (VISCOUS) { v += step.viscosity * drag; }
    if (CONFINEMENT > 0.0 || COHESION > 0.0 || ADHESION > 0.0) { v += step.time * acceleration; }
    velocity[i] = vec4<f32>(v, own.w);
    if (PREDICT) { predict(i, x, v, tag, step.after, step.next); }
}
