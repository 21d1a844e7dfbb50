// Line 16 at a frame's start; within a frame the forces end with it. Liquid that settles begins each frame at rest.
//!include common/chemistry/bulk.wgsl
//!include common/chemistry/features.wgsl
//!include common/chemistry/turnover_plan.wgsl
//!include common/liquid/awake.wgsl
//!include common/liquid/prediction.wgsl
//!include common/liquid/step.wgsl

@group(0) @binding(0) var<storage, read> position: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> velocity: array<vec4<f32>>;
/// (membership, identity)
@group(0) @binding(2) var<storage, read> tags: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read> bulk: array<vec4<f32>>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x;
    if (i >= COUNT) { return; }
    if (DORMANT_TURNOVER) {
        if (i == 0u) { plan_turnover(step.time); }
    }
    // In a frame in which flasks fell asleep or woke up, particles are not yet where they belong.
    if (i >= sorted_count()) { return; }
    var volume = 1.0;
    if (DENSITY) { volume = unpack_bulk(bulk[i]).volume; }
    if (sleeps(tags[i].x)) {
        trial[i] = pack_trial(position[i].xyz, volume);
        // Taken out since the last rebuild, it is still among those that are awake.
        if (tags[i].x == REMOVED) { ask_for_list(sorted_count()); }
        return;
    }
    if (LOADS) { wall_push[i] = vec4<f32>(0.0); }
    var v = velocity[i].xyz;
    if (frames_to_settle(tags[i].x) > 0u) { v = vec3<f32>(0.0); }
    predict(i, position[i].xyz, v, volume, tags[i].x, step.before, step.after);
}
