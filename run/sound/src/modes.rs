//! The modes of a glass: French 1983, "In vino veritas: a study of wineglass acoustics", Am. J. Phys. 51(8), 688.

use std::f64::consts::PI;

use crate::event::Glass;

/// Borosilicate glass 3.3 (ISO 3585): Young's modulus, Pa, and density, kg/m³.
const YOUNG: f64 = 64e9;
const DENSITY: f64 = 2230.0;

/// Share of the liquid that moves with the wall: French's α.
const LIQUID: f64 = 1.25;

/// Modes by the number of waves around the rim: 2n places stand still.
pub(crate) const WAVES: [u32; 4] = [2, 3, 4, 5];

/// A glass with dimensions clamped to those of real glasses.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cup {
    radius: f64,
    wall: f64,
    height: f64,
    filled: f64,
    density: f64,
}

impl Cup {
    pub(crate) fn of(glass: &Glass) -> Self {
        Self {
            radius: f64::from(glass.radius).clamp(0.004, 0.3),
            wall: f64::from(glass.wall).clamp(0.2e-3, 0.02),
            height: f64::from(glass.height).clamp(0.01, 1.0),
            filled: f64::from(glass.filled).clamp(0.0, 1.0),
            density: f64::from(glass.density).clamp(0.0, 3000.0),
        }
    }

    /// Frequency (Hz) of the mode with `waves` waves around.
    ///
    /// A ring's f = (a/2πR²)·√(E/12ρ)·n(n² − 1)/√(n² + 1), times √(1 + (4/3)(R/H)⁴) for the bottom, as French has it
    /// for n = 2. Bending along the height is (n² − 1)² weaker beside a ring's, so that 4/3 becomes 12/(n² − 1)².
    pub(crate) fn frequency(&self, waves: u32) -> f64 {
        let n = f64::from(waves);
        let about = n * n - 1.0;
        let ring = self.wall / (2.0 * PI * self.radius * self.radius)
            * (YOUNG / (12.0 * DENSITY)).sqrt()
            * n
            * about
            / (n * n + 1.0).sqrt();
        let flat = self.radius / self.height;
        let flat = flat * flat * flat * flat;
        ring * ((1.0 + 12.0 / (about * about) * flat) / (1.0 + self.added(waves))).sqrt()
    }

    /// Mass of liquid that moves with the mode, over that of glass: (f₀/f)² − 1 = (α/5)(ρ_l R/ρ a)(h/H)⁴ (French 1983,
    /// for n = 2). A mode drives liquid to a depth of R/n, and the wall also moves along the rim, by 1/n: together
    /// n/(n² + 1), which is 2/5 for n = 2.
    fn added(&self, waves: u32) -> f64 {
        let n = f64::from(waves);
        let high = self.filled * self.filled;
        let share = 0.5 * LIQUID * n / (n * n + 1.0);
        share * self.density * self.radius / (DENSITY * self.wall) * high * high
    }

    /// Mass that moves with the mode, kg: ∫(z/H)⁴dz/H = 1/5 of the wall's, half of it by the waves around.
    pub(crate) fn mass(&self, waves: u32) -> f64 {
        let n = f64::from(waves);
        let wall = 2.0 * PI * self.radius * self.height * self.wall * DENSITY;
        0.1 * wall * (1.0 + 1.0 / (n * n)) * (1.0 + self.added(waves))
    }

    /// Mass of the wall and of a bottom as thick, kg.
    pub(crate) fn whole(&self) -> f64 {
        PI * self.radius * (2.0 * self.height + self.radius) * self.wall * DENSITY
    }

    pub(crate) fn filled(&self) -> f64 {
        self.filled
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn beaker(filled: f32) -> Cup {
        Cup::of(&Glass {
            radius: 0.035,
            wall: 1.4e-3,
            height: 0.095,
            filled,
            density: 998.0,
            held: false,
        })
    }

    /// By hand, of √(3E/5ρ) = 4149.7 m/s and a/2πR² = 0.18189 1/m: 754.8 Hz·√(1 + 4/3·0.018422) = 764.0 Hz; a ring's next
    /// modes are 2.8284 and 5.4231 times as high: 2134.8 Hz·√(1 + 12/64·0.018422), 4093.3 Hz·√(1 + 12/225·0.018422).
    #[test]
    fn a_beaker_rings_as_french_says() {
        for (waves, frequency) in [(2, 764.0), (3, 2138.5), (4, 4095.3)] {
            let found = beaker(0.0).frequency(waves);
            assert!((found / frequency - 1.0).abs() < 1e-3, "{waves}: {found}");
        }
    }

    /// Full: (f₀/f)² = 1 + 0.25·998·0.035/(2230·0.0014) = 3.797; half full: 1 + 2.797/16 = 1.1748.
    #[test]
    fn liquid_lowers_it() {
        for (filled, square) in [(1.0, 3.797), (0.5, 1.1748)] {
            let found = (beaker(0.0).frequency(2) / beaker(filled).frequency(2)).powi(2);
            assert!((found / square - 1.0).abs() < 1e-3, "{filled}: {found}");
        }
    }
}
