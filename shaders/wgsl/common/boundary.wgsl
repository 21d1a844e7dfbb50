// The volume that walls contribute to a particle's density, and its gradient.
//!include common/vessel.wgsl
//!include common/ground.wgsl

/// (∇V, V) of one map of flask k at `x` (stage frame).
fn vessel_volume(k: u32, pose: FlaskPose, first: u32, x: vec3<f32>) -> vec4<f32> {
    let p = flask_from_stage(pose, x);
    let r = length(p.xz);
    let map = sample_map(k, first, r, p.y);
    let out = p.xz / max(r, 1e-9);
    let slope = vec3<f32>(out.x * map.z, map.w, out.y * map.z);
    return vec4<f32>(rotate(pose.orientation, slope), map.y);
}

/// (∇V, V) at `x` of all vessels' glass.
fn outside_vessels(x: vec3<f32>, pose_first: u32) -> vec4<f32> {
    var sum = vec4<f32>(0.0);
    for (var k = 0u; k < FLASKS; k++) {
        let pose = poses[pose_first + k];
        let reach = flasks[k].outer + flasks[k].rim + SUPPORT;
        let offset = x - pose.position.xyz;
        if (dot(offset, offset) < reach * reach) {
            sum += vessel_volume(k, pose, flasks[k].outside_first, x);
        }
    }
    return sum;
}

/// (∇V, V) at `x` of all walls that act on a particle with `membership`. What
/// is inside a flask feels that flask's inner surface and nothing beyond it.
fn boundary_volume(membership: u32, x: vec3<f32>, pose_first: u32) -> vec4<f32> {
    var sum = vec4<f32>(0.0);
    if (FLASKS > 0u) {
        if (membership != NOBODYS) {
            let k = membership - 1u;
            sum = vessel_volume(k, poses[pose_first + k], flasks[k].inside_first, x);
        } else {
            sum = outside_vessels(x, pose_first);
        }
    }
    if (membership == NOBODYS) {
        if (TABLE) {
            let above = x.y - TABLE_TOP;
            if (above < SUPPORT && x.y > TABLE_UNDER && beyond_table(x) < 0.0) {
                let v = half_space(above);
                sum += vec4<f32>(0.0, v.y, 0.0, v.x);
            }
        }
        let height = x.y - FLOOR;
        if (height < SUPPORT) {
            let v = half_space(height);
            sum += vec4<f32>(0.0, v.y, 0.0, v.x);
        }
    }
    return sum;
}
