//! Internal forces (line 28): vorticity confinement (Macklin & Müller 2013),
//! cohesion and adhesion (Akinci et al. 2013), as accelerations.

use super::neighbours::Neighbours;
use super::state::Reference;
use crate::kernel::Kernel;
use crate::surface_tension::cohesion_kernel;
use glam::DVec3;

impl Reference {
    /// Acceleration by cohesion, −γ·Σ_j m·C(r)·r̂, m/s².
    ///
    /// Akinci's factor 2ρ₀/(ρ_i + ρ_j) and the curvature term are left out: the
    /// density constraint keeps the first near one, and the second needs a
    /// colour field and another pass.
    pub(super) fn cohesion(&self, neighbours: &Neighbours) -> Vec<DVec3> {
        let (support, strength) = (
            self.parameters.support_radius,
            self.parameters.cohesion_scale(),
        );
        let acceleration = |i: usize| -> DVec3 {
            neighbours
                .of(i)
                .map(|j| self.positions[i] - self.positions[j])
                .map(|apart| {
                    let pull = cohesion_kernel(apart.length(), support);
                    apart.normalize_or_zero() * (-strength * pull)
                })
                .sum()
        };
        (0..self.positions.len()).map(acceleration).collect()
    }

    /// Acceleration by adhesion, β·ρ₀·∫ A(r)·r̂ over what is solid, m/s².
    pub(super) fn adhesion(&self) -> Vec<DVec3> {
        let strength = self.parameters.adhesion_scale();
        let acceleration = |i: usize| {
            let mut sum = DVec3::ZERO;
            self.contacts(i, |contact| sum += contact.pull);
            sum * strength
        };
        (0..self.positions.len()).map(acceleration).collect()
    }
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
