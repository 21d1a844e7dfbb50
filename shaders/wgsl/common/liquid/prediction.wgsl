// Line 16, with line 23 applied to the prediction, so that the list is built
// around positions that the flasks allow.
//!include common/glass/constraint.wgsl
//!include common/liquid/list_check.wgsl
//!include common/liquid/step.wgsl
//!include common/liquid/trial.wgsl

override GRAVITY_X: f32 = 0.0;
override GRAVITY_Y: f32 = -9.81;
override GRAVITY_Z: f32 = 0.0;

/// Displacement (m) that walls gave to each particle since the frame's start; w above 0 where it was pushed, and not dragged alone.
@group(0) @binding(32) var<storage, read_write> wall_push: array<vec4<f32>>;
@group(0) @binding(33) var<storage, read_write> trial: array<vec4<f32>>;

/// Line 16.
fn predict(i: u32, x: vec3<f32>, v: vec3<f32>, volume: f32, tag: u32, before: u32, after: u32) {
    if (tag == REMOVED) {
        trial[i] = pack_trial(x, volume);
        return;
    }
    let gravity = vec3<f32>(GRAVITY_X, GRAVITY_Y, GRAVITY_Z);
    let free = x + step.time * (v + step.time * gravity);
    let allowed = constrain(tag, x, free, before, after).position;
    trial[i] = pack_trial(allowed, volume);
    if (LOADS) { wall_push[i] += pushed(allowed - free); }
    check_list(i, allowed);
}
