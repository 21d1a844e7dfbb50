// What of the liquid flies against a pane stays before it.
//!include common/glass/pane.wgsl
//!include common/liquid/particle.wgsl
//!include common/liquid/velocity.wgsl

/// d, m.
override SPACING: f32 = 0.0025;

@group(0) @binding(0) var<storage, read> position: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read_write> velocity: array<vec4<f32>>;
/// (membership, identity)
@group(0) @binding(2) var<storage, read> tags: array<vec2<u32>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x;
    if (i >= COUNT) { return; }
    // A flask is not stopped by it, and so its liquid is not.
    if (tags[i].x != NOBODYS) { return; }
    let v = velocity[i];
    velocity[i] = pack_velocity(stopped(position[i].xyz, v.xyz, pane.half + 0.5 * SPACING), carried_by(v));
}
