// The flow that is filtered at a frame's end: velocity (m/s), and density of the liquid over the rest density. Gas is left out:
// bubbles slip through the liquid, and a foam does not damp eddies as heavy liquid under light does.
//!include common/chemistry/bulk.wgsl
//!include common/chemistry/features.wgsl
//!include common/liquid/particle.wgsl

/// Whether nothing has smoothed it yet.
override FIRST: bool = false;

@group(0) @binding(10) var<storage, read> velocity: array<vec4<f32>>;
@group(0) @binding(11) var<storage, read> bulk: array<vec4<f32>>;
/// What the pass before made of it.
@group(0) @binding(12) var<storage, read> flow: array<vec4<f32>>;

fn flow_at(j: u32) -> vec4<f32> {
    if (!FIRST) { return flow[j]; }
    var density = 1.0;
    if (DENSITY) { density = liquid_density(unpack_bulk(bulk[j])); }
    // What turned non-finite is taken out in the next substep; until then it rests.
    let known = is_finite(velocity[j].xyz) && is_finite(vec3<f32>(density));
    return select(vec4<f32>(0.0, 0.0, 0.0, 1.0), vec4<f32>(velocity[j].xyz, density), known);
}
