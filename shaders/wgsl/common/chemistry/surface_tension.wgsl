// Surface tension by composition and temperature, over that of water at 20 °C: `surface_tension.rs`, `relative`, in f32.

/// Acid mass fractions, and surface tensions at 25 °C over water's.
const TENSION_ACIDS = array<f32, 8>(0.0, 0.041, 0.122, 0.219, 0.291, 0.336, 0.45, 0.98);
const TENSIONS = array<f32, 8>(1.0, 1.0028, 1.0111, 1.0264, 1.0389, 1.0458, 1.0542, 0.7639);
/// What it loses a kelvin, of water's at 20 °C.
const TENSION_SLOPE: f32 = 0.002378;
/// Least that is left, far beyond any table.
const LEAST_TENSION: f32 = 0.1;

fn relative_tension(acid: f32, temperature: f32) -> f32 {
    // Drivers unroll the loop, so that each index is a constant: a software driver copies an array that is indexed otherwise, for every particle.
    var tension = 0.0;
    for (var k = 0u; k < 7u; k++) {
        let t = clamp((acid - TENSION_ACIDS[k]) / (TENSION_ACIDS[k + 1u] - TENSION_ACIDS[k]), 0.0, 1.0);
        tension = select(tension, mix(TENSIONS[k], TENSIONS[k + 1u], t), k == 0u || acid > TENSION_ACIDS[k]);
    }
    return tension * clamp(1.0 - TENSION_SLOPE * (temperature - 20.0), LEAST_TENSION, 1.1);
}
