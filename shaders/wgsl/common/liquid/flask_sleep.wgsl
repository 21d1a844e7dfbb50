// What is noted of each flask to tell whether its liquid sleeps.
//!include common/glass/vessel.wgsl
//!include common/liquid/particle.wgsl

struct FlaskSleep {
    /// Where it stood when it was last moved, and how.
    position: vec3<f32>,
    /// Frames since something last moved, came near or was not even, up to `CALM_FRAMES`.
    calm: u32,
    orientation: vec4<f32>,
    /// `LIVELY`, `DISTURBED` and `MOVED`, and at a frame's start `STARTS`.
    lively: atomic<u32>,
    /// Least and greatest acid fraction of its particles in the last frame, bits of an f32.
    least_acid: atomic<u32>,
    most_acid: atomic<u32>,
    /// Above 0 where its particles' mean square of the speed is more than that of liquid at rest: sums of `sim/calm.wgsl`.
    unrest: atomic<i32>,
    /// Height over the flask's origin to which its liquid reached when it was last awake at a frame's start, m.
    top: f32,
    /// The same of this frame, bits of an f32.
    highest: atomic<u32>,
}

@group(0) @binding(60) var<storage, read_write> flask_sleeps: array<FlaskSleep>;

/// Distance that liquid of elsewhere keeps from a flask whose liquid sleeps, m (`solver/sleep.rs`).
override CLEARANCE: f32 = 0.015;

/// Bits of `lively`: something of the last frame keeps the liquid awake; the flask moves in this frame, or has drifted; a rod or other liquid came
/// near.
const LIVELY = 1u;
const MOVED = 2u;
const DISTURBED = 8u;

/// Way from x (stage) to the cylinder about a flask up to a height, m; 0 within it.
fn way_to(k: u32, pose: FlaskPose, height: f32, x: vec3<f32>) -> f32 {
    let p = flask_from_stage(pose, x);
    let beside = length(p.xz) - flasks[k].outer;
    let along = max(p.y - height, -p.y);
    return length(max(vec2<f32>(beside, along), vec2<f32>(0.0)));
}

/// Keeps the liquid of a flask awake, or wakes it at the next frame's start.
fn keep_awake(k: u32) {
    note_bits(k, LIVELY);
}

/// The same of what comes near; liquid that settles does so no longer.
fn disturb(k: u32) {
    note_bits(k, LIVELY | DISTURBED);
}

fn note_bits(k: u32, bits: u32) {
    // Most find it done: if each took part, all would wait for one word.
    if ((atomicLoad(&flask_sleeps[k].lively) & bits) != bits) { atomicOr(&flask_sleeps[k].lively, bits); }
}
