// What is solid, as the density sum has it.
//!include common/glass/ground.wgsl
//!include common/glass/solids.wgsl
//!include common/glass/vessel.wgsl
//!include common/glass/wall.wgsl
//!include common/liquid/particle.wgsl

/// What one flask's glass is to a particle.
struct Wall {
    /// ∇V, 1/m.
    gradient: vec3<f32>,
    /// V, its part of a full density.
    volume: f32,
}

/// Whether flask k's glass may act on a particle at `x` (stage frame). What is
/// inside a flask feels that flask's inner surface and nothing beyond it.
fn may_touch(k: u32, membership: u32, pose: FlaskPose, x: vec3<f32>) -> bool {
    let reach = flasks[k].outer + flasks[k].rim + SUPPORT;
    let offset = x - pose.position.xyz;
    return membership == k + 1u || (membership == NOBODYS && dot(offset, offset) < reach * reach);
}

/// The wall at `p` by flask k's map of the particle's side, both in the flask's frame.
fn wall_of_map(k: u32, membership: u32, p: vec3<f32>) -> Wall {
    let r = length(p.xz);
    let first = select(flasks[k].outside_first, flasks[k].inside_first, membership == k + 1u);
    let map = sample_map(k, first, r, p.y);
    let out = p.xz / max(r, 1e-9);
    let gradient = vec3<f32>(out.x * map.slope.x, map.slope.y, out.y * map.slope.x);
    return Wall(gradient, map.volume);
}

/// This lane's part of flask k's wall at `x`, in the stage's frame. The lanes
/// of a particle share its solids; of a map, lane 0 has all.
fn wall_of(k: u32, membership: u32, pose: FlaskPose, x: vec3<f32>, lane: u32) -> Wall {
    let p = flask_from_stage(pose, x);
    var wall: Wall;
    if (SOLIDS) { wall = wall_of_solids(k, p, lane); } else { wall = wall_of_map(k, membership, p); }
    wall.gradient = rotate(pose.orientation, wall.gradient);
    return wall;
}

/// The record `boundary` at `x` of all walls that act on a particle with `membership`; for
/// lane 0, but all lanes must ask. One loop for particles inside and outside:
/// two would both be walked on a software driver.
fn boundary_volume(membership: u32, x: vec3<f32>, pose_first: u32, lane: u32) -> vec4<f32> {
    var sum = vec4<f32>(0.0);
    if (FLASKS > 0u && (SOLIDS || lane == 0u)) {
        for (var k = 0u; k < FLASKS; k++) {
            let pose = poses[pose_first + k];
            if (may_touch(k, membership, pose, x)) {
                let wall = wall_of(k, membership, pose, x, lane);
                sum += pack_walls(wall.gradient, wall.volume);
            }
        }
    }
    if (SOLIDS) { sum = pack_walls(lane_sum3(wall_gradient(sum)), lane_sum(wall_volume(sum))); }
    if (membership == NOBODYS) {
        let above = heights(x);
        let table = half_space(above.table);
        let ground = half_space(above.floor);
        sum += pack_walls(vec3<f32>(0.0, table.slope + ground.slope, 0.0), table.volume + ground.volume);
    }
    return sum;
}
