//! Internal forces (line 28): vorticity confinement (Macklin & Müller 2013),
//! cohesion and adhesion (Akinci et al. 2013), as accelerations.

use super::neighbours::Neighbours;
use super::placement::Motion;
use super::surroundings::Surroundings;
use crate::kernel::Kernel;
use glam::DVec3;
use std::f64::consts::PI;

/// ∫₀¹ q⁴·c(q) dq = 21/28160 for the cohesion kernel C = 32/(πh³)·c(r/h).
const COHESION_MOMENT: f64 = 21.0 / 28160.0;

/// ∫₀¹ q⁴·a(q) dq for the adhesion kernel A = 0.007/h³·a(r/h), by quadrature.
const ADHESION_MOMENT: f64 = 0.116_585;

/// Intervals of [`HalfSpacePull`]'s table over the support radius.
pub const PULL_SAMPLES: usize = 64;

/// C(r) of Akinci et al. 2013, Eq. 2, 1/m³: attracts beyond h/2, repels
/// nearby.
pub fn cohesion_kernel(r: f64, support: f64) -> f64 {
    let scale = 32.0 / (PI * support.powi(3));
    let q = r / support;
    let shape = ((1.0 - q) * q).powi(3);
    if q >= 1.0 {
        0.0
    } else if q > 0.5 {
        scale * shape
    } else {
        scale * (2.0 * shape - 1.0 / 64.0)
    }
}

/// A(r) of Akinci et al. 2013, Eq. 7, 1/m³: attracts between h/2 and h.
pub fn adhesion_kernel(r: f64, support: f64) -> f64 {
    let q = r / support;
    if (0.5..1.0).contains(&q) {
        0.007 / support.powi(3) * (q * (6.0 - 4.0 * q) - 2.0).max(0.0).powf(0.25)
    } else {
        0.0
    }
}

/// γ of Akinci et al. 2013 for a surface tension (N/m), m⁴/(kg·s²).
///
/// A liquid of number density n whose particles attract by f(r) has the
/// surface tension (π/8)·n²·∫ r⁴ f dr (Fowler 1937, with particles spread
/// evenly); with f = γm²C and nm = ρ₀ this is γ.
pub fn cohesion_strength(tension: f64, rest_density: f64, support: f64) -> f64 {
    tension / (4.0 * COHESION_MOMENT * (rest_density * support).powi(2))
}

/// β of Akinci et al. 2013, likewise: glass with as much adhesion as the
/// liquid has surface tension attracts the liquid as it attracts itself.
pub fn adhesion_strength(tension: f64, rest_density: f64, support: f64) -> f64 {
    8.0 * tension / (PI * 0.007 * ADHESION_MOMENT * (rest_density * support).powi(2))
}

/// G(s) = ∫ A(r)·cos dV over a half space at distance s: what a flat wall of
/// solid particles would attract with, since a volume map has none.
#[derive(Clone, Debug)]
pub struct HalfSpacePull {
    support: f64,
    samples: Vec<f64>,
}

impl HalfSpacePull {
    /// Table for support radius `support`, metres.
    pub fn new(support: f64) -> Self {
        // The part of the sphere of radius r beyond the plane has
        // ∫ cos dΩ = π(1 − s²/r²).
        let value = |s: f64| {
            let steps = 2000;
            let dr = 0.5 * support / f64::from(steps);
            (0..steps)
                .map(|i| 0.5 * support + (f64::from(i) + 0.5) * dr)
                .filter(|&r| r > s)
                .map(|r| PI * adhesion_kernel(r, support) * (r * r - s * s) * dr)
                .sum()
        };
        let step = support / PULL_SAMPLES as f64;
        Self {
            support,
            samples: (0..=PULL_SAMPLES).map(|i| value(i as f64 * step)).collect(),
        }
    }

    /// G at distance `distance` (metres) from the wall, that at the wall
    /// within it; dimensionless.
    pub fn at(&self, distance: f64) -> f64 {
        let position = (distance / self.support).clamp(0.0, 1.0) * PULL_SAMPLES as f64;
        let i = (position as usize).min(PULL_SAMPLES - 1);
        let t = position - i as f64;
        (1.0 - t) * self.samples[i] + t * self.samples[i + 1]
    }

    /// A(r), 1/m³.
    pub fn kernel(&self, r: f64) -> f64 {
        adhesion_kernel(r, self.support)
    }

    /// G at uniform steps from distance 0 to h, both included, for the GPU.
    pub fn table(&self) -> Vec<f32> {
        self.samples.iter().map(|&value| value as f32).collect()
    }
}

/// Acceleration by cohesion, −γ·Σ_j m·C(r)·r̂, m/s², for γm = `strength`.
///
/// Akinci's factor 2ρ₀/(ρ_i + ρ_j) and the curvature term are left out: the
/// density constraint keeps the first near one, and the second needs a
/// colour field and another pass.
pub fn cohesion(
    support: f64,
    strength: f64,
    positions: &[DVec3],
    neighbours: &Neighbours,
) -> Vec<DVec3> {
    let acceleration = |i: usize| -> DVec3 {
        neighbours
            .of(i)
            .map(|j| positions[i] - positions[j])
            .map(|apart| {
                let pull = cohesion_kernel(apart.length(), support);
                apart.normalize_or_zero() * (-strength * pull)
            })
            .sum()
    };
    (0..positions.len()).map(acceleration).collect()
}

/// Acceleration by adhesion, β·ρ₀·∫ A(r)·r̂ over what is solid, m/s², for
/// βρ₀ = `strength`.
pub fn adhesion(
    surroundings: &Surroundings,
    motion: &[Motion],
    strength: f64,
    positions: &[DVec3],
    membership: &[Option<usize>],
) -> Vec<DVec3> {
    let acceleration = |(&position, &member_of)| {
        let mut sum = DVec3::ZERO;
        surroundings.contacts(position, member_of, motion, |contact| sum += contact.pull);
        sum * strength
    };
    positions.iter().zip(membership).map(acceleration).collect()
}

/// ω_i = ∇ × v = Σ_j V₀·∇W_ij × (v_j − v_i), 1/s.
pub fn vorticity(
    kernel: &Kernel,
    volume: f64,
    positions: &[DVec3],
    velocities: &[DVec3],
    neighbours: &Neighbours,
) -> Vec<DVec3> {
    let curl = |i: usize| -> DVec3 {
        neighbours
            .of(i)
            .map(|j| {
                let slope = slope(kernel, positions[i] - positions[j]);
                slope.cross(velocities[j] - velocities[i]) * volume
            })
            .sum()
    };
    (0..positions.len()).map(curl).collect()
}

/// Acceleration ε·(N × ω) with N = η/|η| and η = ∇|ω|, m/s², for
/// ε = `strength` (m/s).
///
/// N fades out where η is below a thousandth of |ω|/h: the direction of a
/// vanishing gradient is noise.
pub fn confinement(
    kernel: &Kernel,
    (volume, strength): (f64, f64),
    positions: &[DVec3],
    vorticities: &[DVec3],
    neighbours: &Neighbours,
) -> Vec<DVec3> {
    let acceleration = |i: usize| {
        let own = vorticities[i].length();
        let eta: DVec3 = neighbours
            .of(i)
            .map(|j| {
                let slope = slope(kernel, positions[i] - positions[j]);
                slope * (volume * (vorticities[j].length() - own))
            })
            .sum();
        let size = eta.length() + 1e-3 * own / kernel.support();
        if size > 0.0 {
            (eta / size).cross(vorticities[i]) * strength
        } else {
            DVec3::ZERO
        }
    };
    (0..positions.len()).map(acceleration).collect()
}

/// ∇W, zero where particles coincide: velocities need not be parted there.
fn slope(kernel: &Kernel, apart: DVec3) -> DVec3 {
    apart.normalize_or_zero() * kernel.dw(apart.length())
}
