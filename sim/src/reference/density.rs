//! The density constraint (Eqs 1 and 2; lines 18–21).
//!
//! In displacement form: λ has the unit m², and no mass or time appears. By
//! x* ← x* + Σ_j (λ_i + λ_j)·V₀∇W_ij, λ/Δt² is −p/ρ.

use super::neighbours::Neighbours;
use super::placement::Motion;
use super::state::Reference;
use crate::kernel::Kernel;
use glam::DVec3;

/// Distance below which two particles coincide, fraction of h.
const COINCIDENT: f64 = 1e-6;

/// Most that mirrored liquid adds to the density in a substep: a lone particle at a wall lacks
/// 0.18 of a full density.
const MOST_MIRRORED: f64 = 0.1;

/// Least 1 − V_b that the gradient along a wall is divided by: in a gap
/// narrower than a particle.
const LEAST_OPEN: f64 = 0.3;

/// One iteration's multipliers from `densities` (ρ/ρ₀) and a =
/// `gradient_sum`: λ ← min(0, λ − c_r·C/a + c_m·Δλ). `change` is Δλ, that of
/// the iteration before on entry and this one's on return; both m².
///
/// Eq. 2 is an inequality, so a liquid pushes and never pulls: λ ≤ 0. It is
/// the multiplier accumulated over the substep's iterations for which this
/// holds, so an iteration may take back what one before it pushed too far.
/// Plain PBF clamps C ≥ 0 in each iteration instead, which can only push.
pub fn multipliers(
    densities: &[f64],
    gradient_sum: f64,
    (momentum, residual): (f64, f64),
    lambda: &mut [f64],
    change: &mut [f64],
) {
    for ((density, lambda), change) in densities.iter().zip(lambda).zip(change) {
        let constraint = density - 1.0;
        let next = (*lambda - residual * constraint / gradient_sum + momentum * *change).min(0.0);
        *change = next - *lambda;
        *lambda = next;
    }
}

impl Reference {
    /// ρ_i/ρ₀ at `positions`, V_i·W(0) + Σ_j V_j·W_ij + V_b (Eq. 1 with m = ρ₀V₀), the
    /// particle itself included: without it a liquid at rest would be compressed by a
    /// third. Where the V_i (m³) differ it is the share of space that is filled.
    pub fn densities(&self, positions: &[DVec3], neighbours: &Neighbours) -> Vec<f64> {
        let (kernel, (volumes, _)) = (self.kernel(), self.bulk());
        let walls = self
            .surroundings
            .sums(positions, &self.membership, &self.motion);
        let density = |i: usize| {
            let around: f64 = neighbours
                .of(i)
                .map(|j| volumes[j] * kernel.w(positions[i].distance(positions[j])))
                .sum();
            volumes[i] * kernel.w(0.0) + around + walls[i].volume
        };
        (0..positions.len()).map(density).collect()
    }

    /// ρ_i/ρ₀ of line 19: that of [`Self::densities`] at `at`, and by how much V_b has
    /// grown since the substep's start, `before`, once more: what is mirrored in a
    /// wall comes as fast as the particle goes there. Up to a bound, since a lone drop
    /// has no liquid around it to be mirrored.
    pub(super) fn mirrored_densities(
        &self,
        at: &[DVec3],
        neighbours: &Neighbours,
        before: &[f64],
    ) -> Vec<f64> {
        let mut densities = self.densities(at, neighbours);
        if !self.surroundings.has_boundary_particles() {
            let walls = self.surroundings.sums(at, &self.membership, &self.motion);
            for ((density, wall), before) in densities.iter_mut().zip(walls).zip(before) {
                *density += (wall.volume - before).clamp(-MOST_MIRRORED, MOST_MIRRORED);
            }
        }
        densities
    }

    /// V_b of every particle at the substep's start.
    pub(super) fn walls_before(&self) -> Vec<f64> {
        let motion: Vec<_> = self.motion.iter().map(Motion::start).collect();
        let walls = self
            .surroundings
            .sums(&self.positions, &self.membership, &motion);
        walls.into_iter().map(|wall| wall.volume).collect()
    }

    /// Line 20: moves `at` by the displacements of the changes Δλ (m²) of the multipliers,
    /// Δx_i = ρ₀/ρ_i·(Σ_j (Δλ_i + Δλ_j)·V_j∇W_ij + Δλ_i·∇V_b), metres: the same
    /// pressure moves lighter liquid further, and a pair's momenta stay opposite.
    ///
    /// A wall mirrors the liquid before it: across itself it has the particle's
    /// own multiplier, 2 Δλ_i ∇V_b, and along itself the share V_b of the
    /// pressure's gradient that the neighbours, 1 − V_b of a neighbourhood,
    /// lack. With the first alone, as in Akinci et al. 2012, what touches a
    /// wall is borne by too little, sinks, and the beaker turns over. Boundary
    /// particles count once, as the paper has them: ψ is twice a half-space.
    pub fn displace(&self, at: &mut [DVec3], neighbours: &Neighbours, change: &[f64]) {
        let walls = self.surroundings.sums(at, &self.membership, &self.motion);
        let (kernel, ids) = (self.kernel(), &self.ids);
        let (volumes, lightness) = self.bulk();
        let mirrors = !self.surroundings.has_boundary_particles();
        let displacement = |i: usize| {
            let by_liquid: DVec3 = neighbours
                .of(i)
                .map(|j| {
                    let gradient = gradient(&kernel, at[i] - at[j], ids[i], ids[j]);
                    gradient * (volumes[j] * (change[i] + change[j]))
                })
                .sum();
            let once = walls[i].gradient * change[i];
            if !mirrors {
                return (by_liquid + once) * lightness[i];
            }
            let both = by_liquid + 2.0 * once;
            let normal = walls[i].gradient.normalize_or_zero();
            let along = both - normal * both.dot(normal);
            let open = (1.0 - walls[i].volume).max(LEAST_OPEN);
            (both + along * (1.0 / open - 1.0)) * lightness[i]
        };
        let displacements: Vec<_> = (0..at.len()).map(displacement).collect();
        for (at, displacement) in at.iter_mut().zip(displacements) {
            *at += displacement;
        }
    }
}

/// ∇_i W(x_ij), 1/m⁴.
///
/// Where two particles coincide it vanishes, and no density could ever part
/// them. They get the kernel's steepest slope (at h/3) in a direction that
/// is hashed from their ids, so that it is the same whenever it is asked for.
fn gradient(kernel: &Kernel, apart: DVec3, id: u32, other: u32) -> DVec3 {
    let distance = apart.length();
    let support = kernel.support();
    if distance < COINCIDENT * support {
        hashed_direction(id, other) * kernel.dw(support / 3.0)
    } else if distance < support {
        apart * (kernel.dw(distance) / distance)
    } else {
        DVec3::ZERO
    }
}

/// A unit vector, the opposite one when the ids are exchanged.
pub fn hashed_direction(id: u32, other: u32) -> DVec3 {
    let (low, high) = (id.min(other), id.max(other));
    let bits = mix(mix(low) ^ high);
    // Odd multiples of a half: never the zero vector.
    let component = |shift: u32| f64::from(bits >> shift & 0x3ff) - 511.5;
    let direction = DVec3::new(component(0), component(10), component(20)).normalize();
    if id < other { direction } else { -direction }
}

/// MurmurHash3's 32-bit finaliser.
fn mix(mut bits: u32) -> u32 {
    bits ^= bits >> 16;
    bits = bits.wrapping_mul(0x85eb_ca6b);
    bits ^= bits >> 13;
    bits = bits.wrapping_mul(0xc2b2_ae35);
    bits ^ bits >> 16
}
