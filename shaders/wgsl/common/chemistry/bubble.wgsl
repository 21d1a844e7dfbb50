// The record `bubbles`: a bubble of steam, of air or of both in the liquid.
//!include common/chemistry/slots.wgsl

struct Bubble {
    /// Stage frame, m.
    position: vec3<f32>,
    /// Steam, over V0·ρ0.
    mass: f32,
    /// m/s.
    velocity: vec3<f32>,
    /// Of all its steam, J per V0·ρ0.
    enthalpy: f32,
    /// How long it has been at the surface, and in touch with a larger one, s.
    surfaced: f32,
    touching: f32,
    /// As particles have it.
    membership: u32,
    /// Radius, m.
    radius: f32,
    /// Steam that left the liquid from this place since the start, and its enthalpy, per V0·ρ0; and what puffs were made of.
    gone: vec2<f32>,
    vented: vec2<f32>,
    /// Air, as the steam that has as many molecules, over V0·ρ0, and its temperature, °C; and air that left from this place.
    air: f32,
    air_temperature: f32,
    air_gone: f32,
    /// Radius with which this step began, m; 0 where there was no bubble.
    radius_before: f32,
    /// Position then, m.
    position_before: vec3<f32>,
    /// Share of its volume that is a cavity.
    cavity: f32,
    /// Velocity of the liquid around it at the step before, m/s.
    flow: vec3<f32>,
    /// Whether it is wider than its vessel lets it be, and divides as soon as there is a place.
    divides: f32,
}

fn is_there(bubble: Bubble) -> bool {
    return bubble.mass > 0.0 || bubble.air > 0.0;
}
