// What molecules carry where nothing moves.

/// Diffusivities of acid and of heat, m²/s.
override ACID_DIFFUSIVITY: f32 = 0.0;
override THERMAL_DIFFUSIVITY: f32 = 0.0;
