//! What every pass of the picture knows of its frame. Lengths are in the scene's unit, of which
//! `metres_per_unit` says how long it is drawn; clip space has y down and depth reversed
//! (near / distance: 1 at the near plane, 0 at infinity).

/// One eye.
struct View {
    /// Projection times the inverse of the eye's pose.
    clip_from_stage: mat4x4<f32>,
    /// Where the eye is in the stage, in the scene's unit.
    eye: vec3<f32>,
}

/// A capsule that keeps daylight from the bench: a vessel, roughly.
struct Blocker {
    /// Centre of the lower end's sphere.
    foot: vec3<f32>,
    /// Radius of both spheres.
    radius: f32,
    /// Centre of the upper end's sphere.
    top: vec3<f32>,
    /// Share of the daylight that it keeps away, 0 to 1.
    opacity: f32,
}

/// The uniforms of one frame.
struct Frame {
    /// One or two eyes.
    views: array<View, 2>,
    /// Colours of the chosen attribute, linear, evenly spaced over its range.
    colour_map: array<vec4<f32>, 17>,
    /// The first `blocker_count` count.
    blockers: array<Blocker, 8>,
    /// How many blockers there are.
    blocker_count: u32,
    /// Length of the scene's unit as drawn, metres.
    metres_per_unit: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
