//! XSPH with a coefficient per particle, and anti-viscosity (Eqs 16 and 17;
//! line 27).

use super::chemistry::Coefficients;
use super::neighbours::Neighbours;
use super::state::Reference;
use glam::DVec3;

/// Result of line 27.
#[derive(Clone, Debug, PartialEq)]
pub struct Stirred {
    /// The velocities after it, m/s.
    pub velocities: Vec<DVec3>,
    /// e_i = ½Σ_j w_ij·|v_i − v_j|² of the old velocities, J/kg: the next
    /// substep's.
    pub agitation: Vec<f64>,
}

impl Reference {
    /// v_i ← v_i + Σ_j (μ_i + μ_j − α_i − α_j)/2·w_ij·(v_j − v_i) + μ_i·V_b·(v_b − v_i)
    /// with w_ij = V₀W_ij·2m_j/(m_i + m_j).
    ///
    /// Eq. 17 has μ_i alone, with which one particle gains momentum that no
    /// other loses; the pair's mean conserves it. The reduced mass does so among
    /// unequal ones, and is one among equals. Walls do not boil, so α is none of
    /// theirs. All read the old velocities.
    pub(super) fn stirred(&self, neighbours: &Neighbours, of: &Coefficients) -> Stirred {
        let (kernel, volume) = (self.kernel(), self.parameters.particle_volume());
        let (positions, velocities) = (&self.positions, &self.velocities);
        let mut stirred = Stirred {
            velocities: Vec::with_capacity(velocities.len()),
            agitation: Vec::with_capacity(velocities.len()),
        };
        for (i, &velocity) in velocities.iter().enumerate() {
            let (mut damping, mut driving, mut agitation) = (DVec3::ZERO, DVec3::ZERO, 0.0);
            for j in neighbours.of(i) {
                let kernel = volume * kernel.w(positions[i].distance(positions[j]));
                if kernel > 0.0 {
                    let weight = kernel * 2.0 * of.masses[j] / (of.masses[i] + of.masses[j]);
                    let apart = velocity - velocities[j];
                    damping -= apart * (weight * 0.5 * (of.viscosity[i] + of.viscosity[j]));
                    driving += apart * (weight * 0.5 * (of.growth[i] + of.growth[j]));
                    agitation += 0.5 * weight * apart.length_squared();
                }
            }
            self.contacts(i, |contact| {
                let wall = contact.velocity.clamp_length_max(self.parameters.max_speed);
                damping += (wall - velocity) * (contact.volume * of.viscosity[i]);
            });
            stirred.velocities.push(velocity + damping + driving);
            stirred.agitation.push(agitation);
        }
        stirred
    }
}
