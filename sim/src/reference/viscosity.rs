//! XSPH viscosity (Eq. 16; line 27).

use super::neighbours::Neighbours;
use super::placement::Motion;
use super::surroundings::Surroundings;
use crate::kernel::Kernel;
use glam::DVec3;

/// The velocities after
/// v_i ← v_i + μ_s·Σ_j V₀(v_j − v_i)W_ij + μ_s·V_b·(v_b − v_i), m/s.
///
/// Eq. 16 calls this a force, which its units do not bear out; it is a
/// change of velocity, by `strength` = μ_s of the substep. All read the old
/// velocities: in one loop, as lines 22–29 have it, the result would hang on
/// the particles' order. The wall's velocity is limited to `max_speed` like
/// the liquid's.
#[allow(clippy::too_many_arguments)]
pub fn xsph(
    surroundings: &Surroundings,
    motion: &[Motion],
    kernel: &Kernel,
    (volume, strength, max_speed): (f64, f64, f64),
    positions: &[DVec3],
    membership: &[Option<usize>],
    neighbours: &Neighbours,
    velocities: &[DVec3],
) -> Vec<DVec3> {
    let smoothed = |i: usize| {
        let mut change = DVec3::ZERO;
        for j in neighbours.of(i) {
            let weight = volume * kernel.w(positions[i].distance(positions[j]));
            // Out of reach, and maybe not a number.
            if weight > 0.0 {
                change += (velocities[j] - velocities[i]) * weight;
            }
        }
        surroundings.contacts(positions[i], membership[i], motion, |contact| {
            let wall = contact.velocity.clamp_length_max(max_speed);
            change += (wall - velocities[i]) * contact.volume;
        });
        velocities[i] + change * strength
    };
    (0..positions.len()).map(smoothed).collect()
}
