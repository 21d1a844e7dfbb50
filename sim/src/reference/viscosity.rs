//! XSPH viscosity (Eq. 16; line 27).

use super::neighbours::Neighbours;
use super::state::Reference;
use glam::DVec3;

impl Reference {
    /// The velocities after
    /// v_i ← v_i + μ_s·Σ_j V₀(v_j − v_i)W_ij + μ_s·V_b·(v_b − v_i), m/s.
    ///
    /// Eq. 16 calls this a force, which its units do not bear out; it is a
    /// change of velocity, by μ_s of the substep. All read the old
    /// velocities: in one loop, as lines 22–29 have it, the result would hang on
    /// the particles' order. The wall's velocity is limited to v_max like
    /// the liquid's.
    pub(super) fn xsph(&self, neighbours: &Neighbours) -> Vec<DVec3> {
        let (kernel, parameters) = (self.kernel(), &self.parameters);
        let (positions, velocities) = (&self.positions, &self.velocities);
        let (volume, strength) = (parameters.particle_volume(), parameters.substep_viscosity());
        let smoothed = |i: usize| {
            let mut change = DVec3::ZERO;
            for j in neighbours.of(i) {
                let weight = volume * kernel.w(positions[i].distance(positions[j]));
                // Out of reach, and maybe not a number.
                if weight > 0.0 {
                    change += (velocities[j] - velocities[i]) * weight;
                }
            }
            self.contacts(i, |contact| {
                let wall = contact.velocity.clamp_length_max(parameters.max_speed);
                change += (wall - velocities[i]) * contact.volume;
            });
            velocities[i] + change * strength
        };
        (0..positions.len()).map(smoothed).collect()
    }
}
