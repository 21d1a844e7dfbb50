// At a frame's end: what of it keeps flasks' liquid awake (`sim/sleep.wgsl`).
//!include common/chemistry/features.wgsl
//!include common/chemistry/heat.wgsl
//!include common/chemistry/slots.wgsl
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
/// As `common/chemistry/live_places.wgsl` has it.
@group(0) @binding(6) var<storage, read> live: array<u32>;

/// Speed below which a particle is slow, m/s; difference from the room up to which liquid exchanges next to nothing with it, K; variance of
/// the acid fraction within a particle up to which it is even (`solver/sleep.rs`).
override SLOW: f32 = 0.03;
/// Root mean square of the speeds of liquid at rest, over `SLOW`.
override UNREST: f32 = 0.2;
/// Speed up to which a particle has settled, m/s: what it gains in a frame from rest, of which free fall would be 0.11. Chosen.
const SETTLED: f32 = 0.055;
override WARM: f32 = 5.0;
override VARIED: f32 = 1e-6;

/// No flask.
const NONE = 0xffffffffu;

/// How far a particle may come in two frames, m.
fn reach_of(v: vec3<f32>) -> f32 {
    return CLEARANCE + 2.0 * FRAME_TIME * length(v);
}

/// Keeps the liquid of those flasks awake but `own` that a particle may reach in two frames. What is in no flask then may fall into one, and has
/// to find it awake; what is in another flask meets liquid alone.
fn visit(own: u32, leaves: bool, x: vec3<f32>, v: vec3<f32>) {
    for (var k = 0u; k < FLASKS; k++) {
        let height = select(flask_sleeps[k].top, flasks[k].rim, leaves);
        if (k != own && way_to(k, poses[step.after + k], height, x) < reach_of(v)) { disturb(k); }
    }
}

/// Notes that there is liquid at height y in flask k. Most is lower than what is noted already.
fn note_height(k: u32, y: f32) {
    let bits = bitcast<u32>(max(y, 0.0));
    if (bits > atomicLoad(&flask_sleeps[k].highest)) { atomicMax(&flask_sleeps[k].highest, bits); }
}

/// Notes an acid fraction of flask k. Most lie between those that are noted already: if each took part, all would wait for one word.
fn note_acid(k: u32, acid: f32) {
    let bits = bitcast<u32>(max(acid, 0.0));
    if (bits < atomicLoad(&flask_sleeps[k].least_acid)) { atomicMin(&flask_sleeps[k].least_acid, bits); }
    if (bits > atomicLoad(&flask_sleeps[k].most_acid)) { atomicMax(&flask_sleeps[k].most_acid, bits); }
}

/// Keeps all flasks awake while there are bubbles or drops.
fn note_bubbles() {
    if (live[SLOTS] + live[SLOTS + 1u] == 0u) { return; }
    for (var k = 0u; k < FLASKS; k++) { keep_awake(k); }
}

/// Which flask the workgroup's first particle is in, and what is summed up for it: cells are in order, so most others are there too.
var<workgroup> common_flask: u32;
var<workgroup> common_unrest: atomic<i32>;

/// A particle's square of the speed less what it may be on average, in sixteenths of the latter: a million particles fit the sum.
fn unrest_of(square: f32) -> i32 {
    return i32(round(16.0 * (min(square / (SLOW * SLOW), 1.0) / (UNREST * UNREST) - 1.0)));
}

/// Velocity of a particle, m/s; 0 of liquid that settles, as the next frame begins with, but for the last such frame.
fn velocity_of(i: u32) -> vec3<f32> {
    if (frames_to_settle(tags[i].x) > 1u) { return vec3<f32>(0.0); }
    return velocity[i].xyz;
}

/// Notes what a particle does; its flask, or `NONE`.
fn note(i: u32) -> u32 {
    if (i >= sorted_count()) { return NONE; }
    let membership = tags[i].x;
    if (membership == REMOVED) { return NONE; }
    if (i >= awake_count()) {
        // Where not all were sorted, it came into liquid that sleeps after this frame began.
        if (sorted_count() < COUNT) { keep_awake(membership - 1u); }
        return NONE;
    }
    let v = velocity_of(i);
    if (membership == NOBODYS) {
        visit(NONE, true, position[i].xyz, v);
        return NONE;
    }
    let k = membership - 1u;
    let y = flask_from_stage(poses[step.after + k], position[i].xyz).y;
    note_height(k, y);
    let slow = select(SLOW, SETTLED, frames_to_settle(membership) > 0u);
    let fast = !(dot(v, v) <= slow * slow);
    // Liquids of two flasks meet through a mouth that one flask carries to the other, or through which one flows.
    if (fast || (atomicLoad(&flask_sleeps[k].lively) & MOVED) != 0u) { visit(k, y > flasks[k].rim - reach_of(v), position[i].xyz, v); }
    // Lists that are longer than a place are made anew with every other list. Of those that sleep, one came in after this frame began.
    var lively = fast || list_counts[i] > LIST_CAPACITY || sleeps(membership);
    if (HEAT) {
        let own = heat[i];
        lively = lively || !(abs(temperature_in(own) - ROOM) <= WARM);
        note_acid(k, acid_in(own));
    }
    if (PHYSICAL) { lively = lively || !(eddies[i].y <= VARIED); }
    if (lively) { keep_awake(k); }
    return k;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = id.x;
    if (BUBBLES) {
        if (i == 0u) { note_bubbles(); }
    }
    let k = note(i);
    if (local == 0u) {
        common_flask = k;
        atomicStore(&common_unrest, 0);
    }
    workgroupBarrier();
    if (k != NONE) {
        // What settled liquid gained in a frame from rest is judged by the fastest particle alone.
        let v = select(velocity_of(i), vec3<f32>(0.0), frames_to_settle(tags[i].x) > 0u);
        let unrest = unrest_of(dot(v, v));
        if (k == common_flask) { atomicAdd(&common_unrest, unrest); } else { atomicAdd(&flask_sleeps[k].unrest, unrest); }
    }
    workgroupBarrier();
    if (local == 0u && k != NONE) { atomicAdd(&flask_sleeps[k].unrest, atomicLoad(&common_unrest)); }
}
