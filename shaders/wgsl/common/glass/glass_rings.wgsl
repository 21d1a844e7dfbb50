// The heat of the flasks' glass: rings of their walls (`chemistry/wall_heat.rs`).

/// Rings of a flask.
const GLASS_RINGS: u32 = 32u;

/// Constants of a ring.
struct GlassRing {
    /// Heat capacity, J/K.
    capacity: f32,
    /// Heat that the air takes, W/K.
    to_air: f32,
    /// Heat that is conducted to the next ring above, W/K.
    upwards: f32,
    /// Heat that a plate gives it, W.
    heated: f32,
    /// Heat that the liquid takes per area of contact over ρ0, W m/(kg K).
    to_liquid: f32,
    /// Least heat that is counted, J, and over V0·ρ0, J/kg.
    quantum: f32,
    quantum_per_mass: f32,
}

/// By flask and ring.
@group(0) @binding(27) var<storage, read> glass_rings: array<GlassRing>;
