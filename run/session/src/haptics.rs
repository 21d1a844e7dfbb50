//! What a hand feels of the flask that it holds.

/// Kinetic energy at a wall of real size that is felt with full strength, J: a beaker of 200 mL that boils hard has a
/// few grams at its wall that move at 0.5 m/s.
const FULL: f32 = 1e-3;
/// Strength below which nothing is felt: particles at rest still move a little.
const LEAST: f32 = 0.06;

/// Strength, 0 to 1, for the kinetic energy (J) at a flask's wall in a scene that is
/// 1 / `length_scale` times as large as real. Mass goes with the third power of length and the square
/// of speed with the second, so energy goes with the fifth. The strength is proportional to the energy's
/// root: liquid that moves twice as fast is felt twice as strongly.
pub fn amplitude(energy: f32, length_scale: f64) -> f32 {
    let real = energy * length_scale.powi(5) as f32;
    let strength = (real / FULL).max(0.0).sqrt().min(1.0);
    // Comparisons with NaN are false, so NaN is felt as 0.
    if strength >= LEAST { strength } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_grows_with_speed_and_has_two_ends() {
        assert_eq!(amplitude(0.0, 1.0), 0.0);
        assert_eq!(amplitude(f32::NAN, 1.0), 0.0);
        assert_eq!(amplitude(1.0, 1.0), 1.0);
        // Speed doubled, energy fourfold.
        let (slow, fast) = (amplitude(5e-5, 1.0), amplitude(2e-4, 1.0));
        assert!((fast - 2.0 * slow).abs() < 1e-6, "{slow} {fast}");
        // Twenty times as large, the same to the hand.
        let large = amplitude(5e-5 * 20.0_f32.powi(5), 0.05);
        assert!((large - slow).abs() < 1e-5, "{large} {slow}");
    }
}
