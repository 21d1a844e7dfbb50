//! The SPH kernel of Eq. 1 and its gradient.
//!
//! The cubic spline, with support radius h (not smoothing length). At
//! h/d = 2 and m = ρ₀d³ its sum over a cubic lattice of spacing d is 1.000,
//! over bcc 0.9997 and over fcc 0.9975, so a liquid at rest has the rest
//! density without a fitted mass. Wendland's C² kernel gives 1.034 there.

use std::f64::consts::PI;

/// Cubic spline kernel with a fixed support radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kernel {
    support: f64,
    sigma: f64,
}

impl Kernel {
    /// Kernel that vanishes at distance `support` (h, metres, above zero).
    pub fn new(support: f64) -> Self {
        Self {
            support,
            sigma: 8.0 / (PI * support.powi(3)),
        }
    }

    /// Support radius h, metres.
    pub fn support(&self) -> f64 {
        self.support
    }

    /// Normalisation σ = 8/(πh³), 1/m³; also W(0).
    pub fn sigma(&self) -> f64 {
        self.sigma
    }

    /// W(r, h), 1/m³, for a distance `r` ≥ 0 in metres.
    pub fn w(&self, r: f64) -> f64 {
        let q = r / self.support;
        let shape = if q <= 0.5 {
            6.0 * (q - 1.0) * q * q + 1.0
        } else if q < 1.0 {
            2.0 * (1.0 - q).powi(3)
        } else {
            0.0
        };
        self.sigma * shape
    }

    /// dW/dr, 1/m⁴, never above zero; ∇W(x) = (dW/dr)·x/|x|.
    pub fn dw(&self, r: f64) -> f64 {
        let q = r / self.support;
        let slope = if q <= 0.5 {
            6.0 * q * (3.0 * q - 2.0)
        } else if q < 1.0 {
            -6.0 * (1.0 - q).powi(2)
        } else {
            0.0
        };
        self.sigma * slope / self.support
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrates_to_one() {
        let kernel = Kernel::new(0.3);
        let n = 3000;
        let dr = 0.3 / n as f64;
        let total: f64 = (0..n)
            .map(|i| (i as f64 + 0.5) * dr)
            .map(|r| 4.0 * PI * r * r * kernel.w(r) * dr)
            .sum();
        // Midpoint rule, error O(dr²).
        assert!((total - 1.0).abs() < 1e-6, "{total}");
    }

    #[test]
    fn gradient_is_the_derivative() {
        let h = 0.005;
        let kernel = Kernel::new(h);
        let eps = 1e-5 * h;
        for i in 1..220 {
            let r = h * i as f64 / 200.0;
            let slope = (kernel.w(r + eps) - kernel.w(r - eps)) / (2.0 * eps);
            // Relative to the steepest slope, 1.5 σ/h.
            let error = (slope - kernel.dw(r)).abs() * h / kernel.sigma();
            assert!(error < 1e-4, "r/h = {}: {error}", r / h);
        }
    }

    #[test]
    fn is_the_cubic_b_spline() {
        // Schoenberg's M₄ by truncated powers, whose support is [−2, 2] and
        // whose value at 0 is 2/3.
        let m4 = |x: f64| {
            let terms = [1.0, -4.0, 6.0, -4.0, 1.0];
            let powers = (0..).map(|k| (x + 2.0 - f64::from(k)).max(0.0).powi(3));
            let sum: f64 = terms.iter().zip(powers).map(|(a, b)| a * b).sum();
            sum / 6.0
        };
        let kernel = Kernel::new(0.3);
        for i in 0..=120 {
            let q = f64::from(i) / 100.0;
            let error = kernel.w(0.3 * q) / kernel.sigma() - 1.5 * m4(2.0 * q);
            assert!(error.abs() < 1e-14, "{q}: {error}");
        }
    }

    /// Sum of m·W/ρ₀ over a lattice of unit cells with the given atoms.
    fn lattice_sum(atoms: &[[f64; 3]]) -> f64 {
        let d = 0.7;
        let cell = d * (atoms.len() as f64).cbrt();
        let kernel = Kernel::new(2.0 * d);
        let mut sum = 0.0;
        for x in -3..=3 {
            for y in -3..=3 {
                for z in -3..=3 {
                    for atom in atoms {
                        let at = [x, y, z].map(f64::from);
                        let r2: f64 = (0..3).map(|k| (at[k] + atom[k]).powi(2)).sum();
                        sum += d.powi(3) * kernel.w(cell * r2.sqrt());
                    }
                }
            }
        }
        sum
    }

    #[test]
    fn lattices_have_rest_density() {
        let cubic = lattice_sum(&[[0.0; 3]]);
        let bcc = lattice_sum(&[[0.0; 3], [0.5; 3]]);
        let fcc = lattice_sum(&[[0.0; 3], [0.5, 0.5, 0.0], [0.5, 0.0, 0.5], [0.0, 0.5, 0.5]]);
        assert!((cubic - 1.0).abs() < 5e-4, "{cubic}");
        assert!((bcc - 0.9997).abs() < 5e-4, "{bcc}");
        assert!((fcc - 0.9975).abs() < 5e-4, "{fcc}");
    }
}
