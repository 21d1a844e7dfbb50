// What is noted of each flask to tell whether its liquid sleeps.
//!include common/glass/vessel.wgsl
//!include common/liquid/particle.wgsl

struct FlaskSleep {
    /// Where it stood when it was last moved, and how.
    position: vec3<f32>,
    /// Frames since something last moved, came near or was not even, up to `CALM_FRAMES`.
    calm: u32,
    orientation: vec4<f32>,
    /// Above 0 where something of the last frame keeps its liquid awake; at a frame's start also the bits of `sim/sleep.wgsl`.
    lively: atomic<u32>,
    /// Least and greatest acid fraction of its particles in the last frame, bits of an f32.
    least_acid: atomic<u32>,
    most_acid: atomic<u32>,
    /// Above 0 where its particles' mean square of the speed is more than that of liquid at rest: sums of `sim/calm.wgsl`.
    unrest: atomic<i32>,
}

@group(0) @binding(60) var<storage, read_write> flask_sleeps: array<FlaskSleep>;

/// Distance that liquid and moving flasks keep from a flask whose liquid sleeps, m (`solver/sleep.rs`).
override CLEARANCE: f32 = 0.03;

/// A sphere about a flask at `pose`: its middle and radius.
fn sphere_about(k: u32, pose: FlaskPose) -> vec4<f32> {
    let half = 0.5 * flasks[k].rim;
    return vec4<f32>(stage_from_flask(pose, vec3<f32>(0.0, half, 0.0)), length(vec2<f32>(half, flasks[k].outer)));
}

/// Keeps the liquid of a flask awake, or wakes it at the next frame's start.
fn keep_awake(k: u32) {
    atomicStore(&flask_sleeps[k].lively, 1u);
}
