//! Invocations of passes in which some share a particle: `lanes.rs` says how they are dispatched.

/// The number of an invocation: workgroups of 64 are in rows along x and z.
fn invocation(id: vec3<u32>) -> u32 {
    return id.x + id.z * (64u * 65535u);
}
