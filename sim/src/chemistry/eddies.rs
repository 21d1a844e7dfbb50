//! Eddies that particles do not resolve: Smagorinsky's viscosity with
//! stratification, of a flow that is filtered over a stated width.
//!
//! The width does not follow the particles' size. The difference of two
//! particles' velocities does: at rest it is jitter, which mixed layers a
//! thousand times as fast as molecules do, and finer particles resolved less
//! of what mixed coarser ones.

use crate::parameters::XSPH_MOMENT;

/// Turbulent Schmidt and Prandtl number: eddies carry momentum 0.7 times as
/// well as acid and heat (0.2 to 1.3 are in use; Tominaga & Stathopoulos
/// 2007).
pub const SCHMIDT: f64 = 0.7;

/// Smagorinsky's constant (Lilly 1967), squared, over [`SCHMIDT`].
pub const CONSTANT: f64 = 0.17 * 0.17 / SCHMIDT;

/// Passes of smoothing at most.
const MOST_PASSES: u32 = 8;

/// Share of the neighbours' mean below which another pass is not worth its time.
const LEAST_SHARE: f64 = 0.1;

/// How eddies are modelled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mixing {
    /// C_s²/Sc_t: diffusivity of acid and heat over Δ²·|S|.
    pub turbulence: f64,
    /// Δ: width of the filter, m.
    pub width: f64,
}

impl Default for Mixing {
    /// 6 mm: what particles of 2.9 mm resolve, the coarsest of real size.
    fn default() -> Self {
        Self {
            turbulence: CONSTANT,
            width: 0.006,
        }
    }
}

impl Mixing {
    /// Passes over the neighbours, and the share of their mean that each puts
    /// in a velocity's place, which with the kernel of the gradient make a
    /// filter as wide as a box of Δ: variances add up, and a box has Δ²/12.
    ///
    /// Where the support radius alone is as wide there is none; 8 at most.
    pub fn smoothing(&self, support: f64) -> (u32, f64) {
        // Variance of the kernel along an axis.
        let own = 2.0 * XSPH_MOMENT * support * support;
        let wanted = (self.width * self.width / 12.0 / own - 1.0).clamp(0.0, MOST_PASSES.into());
        if wanted < LEAST_SHARE {
            return (0, 0.0);
        }
        let passes = wanted.ceil();
        (passes as u32, wanted / passes)
    }

    /// K of acid and heat, m²/s, in the filtered flow with |S|² = 2 S_ij S_ij = `strain` and
    /// N² = −(g/ρ)·∂ρ/∂z = `buoyancy` (both 1/s²).
    ///
    /// ν_t = (C_s Δ)²·√(|S|² − N²/Pr_t) (Lilly 1962): where heavy lies under
    /// light there is nothing from Ri = Pr_t on, and less before; where light
    /// lies under heavy there is more. What lifting the heavy takes,
    /// K·N², is then less than what the eddies take from the motion.
    pub fn diffusivity(&self, strain: f64, buoyancy: f64) -> f64 {
        let rate = (strain - buoyancy / SCHMIDT).max(0.0).sqrt();
        self.turbulence * self.width * self.width * rate
    }

    /// ε: power that eddies of the diffusivity `diffusivity` (m²/s) take from
    /// the motion that is resolved, W/kg.
    pub fn dissipation(&self, diffusivity: f64) -> f64 {
        let rate = diffusivity / (self.turbulence * self.width * self.width).max(1e-12);
        SCHMIDT * diffusivity * rate * rate
    }
}
