//! Internal forces (line 28): vorticity confinement (Macklin & Müller 2013), as an acceleration.

use super::neighbours::Neighbours;
use crate::kernel::Kernel;
use glam::DVec3;

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
