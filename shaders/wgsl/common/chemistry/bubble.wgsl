// The record `bubbles`: a bubble of steam in the liquid.
//!include common/chemistry/slots.wgsl

struct Bubble {
    /// Stage frame, m.
    position: vec3<f32>,
    /// Steam, over V0·ρ0; 0 where there is no bubble.
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
}
