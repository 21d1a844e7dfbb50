// What every pass over particles shares.
//!include common/liquid/lane_sums.wgsl

/// Number of particles.
override COUNT: u32 = 1u;
/// Neighbours for which a particle has places in the list.
override LIST_CAPACITY: u32 = 64u;
/// Invocations of a workgroup of a pass over neighbours.
override GROUP: u32 = 64u;
/// Whether what pushes on walls is summed up for the rigid bodies.
override LOADS: bool = false;

/// Membership of a particle that is in no flask.
const NOBODYS: u32 = 0u;
/// Tag of a particle that was taken out because it turned non-finite.
const REMOVED: u32 = 0xffffffffu;

/// Tests of the bits: a compiler may assume that arithmetic is finite.
fn is_finite(v: vec3<f32>) -> bool {
    let bits = bitcast<vec3<u32>>(v) & vec3<u32>(0x7f800000u);
    return all(bits != vec3<u32>(0x7f800000u));
}

/// Where a particle that was taken out is parked: far off, and apart from the others.
fn parked(index: u32) -> vec3<f32> {
    return vec3<f32>(1.0e4 + f32(index & 1023u) * 4.0, -1.0e4, f32(index >> 10u) * 4.0);
}

/// The record `wall_push` of a wall that pushes a particle by this, m: its load, and that it was pushed.
fn pushed(by: vec3<f32>) -> vec4<f32> {
    return vec4<f32>(by, select(0.0, 1.0, any(by != vec3<f32>(0.0))));
}
