// At a frame's end: what of it keeps flasks' liquid awake (`sim/sleep.wgsl`).
//!include common/chemistry/features.wgsl
//!include common/chemistry/heat.wgsl
//!include common/liquid/awake.wgsl
//!include common/liquid/flask_sleep.wgsl
//!include common/liquid/step.wgsl

/// T (°C) of the room.
override ROOM: f32 = 20.0;
/// Δt_f, s.
override FRAME_TIME: f32 = 0.0111;

@group(0) @binding(0) var<storage, read> position: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> velocity: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> tags: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read> heat: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read> eddies: array<vec2<f32>>;
@group(0) @binding(5) var<storage, read> list_counts: array<u32>;

/// Speed below which a particle is slow, m/s; difference from the room up to which liquid exchanges next to nothing with it, K; variance of
/// the acid fraction within a particle up to which it is even (`solver/sleep.rs`).
override SLOW: f32 = 0.03;
override WARM: f32 = 5.0;
override VARIED: f32 = 1e-6;

/// Keeps those flasks awake that a particle outside all of them may reach in two frames.
fn visit(x: vec3<f32>, v: vec3<f32>) {
    let reach = CLEARANCE + 2.0 * FRAME_TIME * length(v);
    for (var k = 0u; k < FLASKS; k++) {
        let about = sphere_about(k, poses[step.after + k]);
        if (distance(x, about.xyz) < about.w + reach) { keep_awake(k); }
    }
}

/// Notes an acid fraction of flask k. Most lie between those that are noted already: if each took part, all would wait for one word.
fn note_acid(k: u32, acid: f32) {
    let bits = bitcast<u32>(max(acid, 0.0));
    if (bits < atomicLoad(&flask_sleeps[k].least_acid)) { atomicMin(&flask_sleeps[k].least_acid, bits); }
    if (bits > atomicLoad(&flask_sleeps[k].most_acid)) { atomicMax(&flask_sleeps[k].most_acid, bits); }
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x;
    if (i >= awake_count()) { return; }
    let membership = tags[i].x;
    if (membership == REMOVED) { return; }
    let v = velocity[i].xyz;
    if (membership == NOBODYS) {
        visit(position[i].xyz, v);
        return;
    }
    let k = membership - 1u;
    // Lists that are longer than a place are made anew with every other list.
    var lively = !(dot(v, v) <= SLOW * SLOW) || list_counts[i] > LIST_CAPACITY;
    if (HEAT) {
        let own = heat[i];
        lively = lively || !(abs(temperature_in(own) - ROOM) <= WARM);
        note_acid(k, acid_in(own));
    }
    if (PHYSICAL) { lively = lively || !(eddies[i].y <= VARIED); }
    if (lively) { keep_awake(k); }
}
