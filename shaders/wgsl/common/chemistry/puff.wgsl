// A puff of steam in the room's air: the place of one, what it holds and what is
// drawn of it.

/// Air that a sphere moves along, over what it displaces (`chemistry/puff.rs`).
const VIRTUAL_MASS: f32 = 0.5;

struct Puff {
    /// Centre in the stage, m.
    position: vec3<f32>,
    /// Radius, m; 0 for none.
    radius: f32,
    /// Horizontal drift over the upward speed.
    drift: vec2<f32>,
    /// Upward momentum with that of the air moved along, kg m/s.
    momentum: f32,
    /// Dry air and water, kg.
    air: f32,
    water: f32,
    /// J, relative to dry air and water at 0 °C.
    enthalpy: f32,
    /// Part of the water that is mist, kg.
    mist: f32,
    /// Optical depth of the mist along a mean chord.
    depth: f32,
}
