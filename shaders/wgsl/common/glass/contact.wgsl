// What walls do to a particle's velocity, at the place and with the membership
// that it has after lines 22 to 25: they drag it along (line 27).
//!include common/glass/boundary.wgsl
//!include common/liquid/max_speed.wgsl
//!include common/liquid/step.wgsl

/// Line 3: velocity of flask k's glass at `x`, its displacement over the time; no faster than the liquid may be.
fn wall_velocity(k: u32, x: vec3<f32>) -> vec3<f32> {
    let local = flask_from_stage(poses[step.after + k], x);
    let velocity = (x - stage_from_flask(poses[step.before + k], local)) / step.time;
    return velocity * min(1.0, MAX_SPEED / max(length(velocity), 1e-9));
}

/// Line 27: Σ V·(v_wall − v) over all walls that a particle at `x` with velocity `v` touches, m/s;
/// for lane 0, but all lanes must ask.
fn drag_by_walls(membership: u32, x: vec3<f32>, v: vec3<f32>, lane: u32) -> vec3<f32> {
    var drag = vec3<f32>(0.0);
    if (FLASKS > 0u && (SOLIDS || lane == 0u)) {
        for (var k = 0u; k < FLASKS; k++) {
            let pose = poses[step.after + k];
            if (may_touch(k, membership, pose, x)) {
                let wall = wall_of(k, membership, pose, x, lane);
                drag += wall.volume * (wall_velocity(k, x) - v);
            }
        }
    }
    if (SOLIDS) { drag = lane_sum3(drag); }
    if (membership == NOBODYS) {
        // Table and floor stand still.
        let above = heights(x);
        drag -= (half_space(above.table).volume + half_space(above.floor).volume) * v;
    }
    return drag;
}
