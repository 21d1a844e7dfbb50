// What a tool does to the liquid before a frame: a rod that moves drags along what is about it, and a cloth takes up what is nobody's
// and that it lies on. The rod takes no room: a rod of 7 mm is hardly thicker than a particle.
//!include common/chemistry/bulk.wgsl
//!include common/chemistry/features.wgsl
//!include common/liquid/awake.wgsl
//!include common/liquid/counters.wgsl
//!include common/liquid/flask_sleep.wgsl
//!include common/liquid/position.wgsl
//!include common/liquid/velocity.wgsl

/// d, m.
override SPACING: f32 = 0.0025;

const PI = 3.14159265;

/// A tool's cylinder.
struct Handle {
    /// Ends of its axis, m; for a cloth the first is the middle of its base.
    a: vec3<f32>,
    /// m.
    radius: f32,
    b: vec3<f32>,
    /// Whether it takes liquid up.
    wipes: u32,
    /// How the ends move, m/s.
    velocity_a: vec3<f32>,
    /// Of the step, s.
    time: f32,
    velocity_b: vec3<f32>,
    /// Drag coefficient over the diameter.
    drag: f32,
    /// Whether it moves.
    stirs: u32,
}

var<immediate> handle: Handle;

@group(0) @binding(0) var<storage, read_write> position: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read_write> velocity: array<vec4<f32>>;
/// (membership, identity)
@group(0) @binding(2) var<storage, read_write> tags: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read_write> heat: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read_write> bulk: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read_write> eddies: array<vec2<f32>>;
@group(0) @binding(6) var<storage, read_write> counters: Counters;

/// The particle is in the cloth from now on, and out of the simulation.
fn take_up(i: u32) {
    if (HEAT) { heat[i] = vec4<f32>(0.0); }
    if (PHYSICAL) {
        eddies[i] = vec2<f32>(0.0);
        bulk[i] = pack_bulk(Bulk(1.0, 1.0, 0.0, 0.0));
    }
    position[i] = pack_taken_out(parked(tags[i].y));
    velocity[i] = vec4<f32>(0.0);
    tags[i].x = REMOVED;
    atomicAdd(&counters.wiped, 1u);
}

/// Change of velocity in a step, of liquid that the rod passes with `relative` across its axis: the drag ½ ρ C D u² on a metre of rod
/// is shared by what is within a particle of it, π (r + d)² ρ. Where that share would exceed u, it tends to u.
fn dragged(relative: vec3<f32>) -> vec3<f32> {
    let reach = handle.radius + SPACING;
    let share = handle.time * handle.drag * handle.radius * length(relative) / (PI * reach * reach);
    return relative * share / (1.0 + share);
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x;
    if (i >= COUNT) { return; }
    let membership = tags[i].x;
    if (membership == REMOVED) { return; }
    let x = position[i].xyz;
    let along = handle.b - handle.a;
    let long = length(along);
    let axis = along / long;
    let place = dot(x - handle.a, axis);
    let aside = length(x - handle.a - place * axis);
    if (handle.wipes != 0u) {
        // As far as a layer of two particles lies beneath it, and what falls on it.
        let near = place > -2.0 * SPACING && place < long + 0.5 * SPACING;
        if (membership == NOBODYS && near && aside < handle.radius) { take_up(i); }
        return;
    }
    if (place < 0.0 || place > long || aside >= handle.radius + SPACING) { return; }
    // Liquid that sleeps wakes up where the rod moves in it.
    if (SLEEP && handle.stirs != 0u && membership != NOBODYS) { disturb(membership - 1u); }
    let v = velocity[i];
    let rods = mix(handle.velocity_a, handle.velocity_b, place / long);
    let relative = rods - v.xyz;
    velocity[i] = pack_velocity(v.xyz + dragged(relative - dot(relative, axis) * axis), carried_by(v));
}
