//! Energy of a liquid's surface, which becomes motion where it shrinks or wets.

use glam::{DVec3, IVec3};
use std::collections::{BTreeMap, HashMap};
use vitriol_sim::parameters::Parameters;
use vitriol_sim::pose::Pose;
use vitriol_sim::reference::Reference;
use vitriol_sim::reference::surroundings::Surroundings;
use vitriol_sim::scene::Scene;
use vitriol_sim::solver::SolverState;

/// Nodes of the longest piece that is integrated: a spray's can be metres long.
const MOST_NODES: f64 = 1e6;

/// The reference's integral of the surface energy, for a scene whose particles all count as V₀ of water: density and composition change it
/// by a tenth.
pub(super) struct Surface {
    parameters: Parameters,
    surroundings: Surroundings,
}

impl Surface {
    /// The integral for `scene`; `None` where no surface tension is modelled.
    pub fn of(scene: &Scene, parameters: &Parameters) -> Option<Self> {
        parameters.surface.as_ref()?;
        Some(Self {
            parameters: Parameters {
                chemistry: None,
                ..parameters.clone()
            },
            surroundings: Surroundings::of_scene(scene),
        })
    }

    /// Surface energy, J, with the flasks at `poses`. Pieces that are too long count nothing.
    pub fn energy(&self, state: &SolverState, poses: &[Pose]) -> f64 {
        let present = (0..state.tags.len()).filter(|&slot| state.is_present(slot));
        let particles: Vec<_> = present
            .map(|slot| {
                let [x, y, z, _] = state.positions[slot];
                let at = DVec3::new(x.into(), y.into(), z.into());
                (at, state.flask_of(slot))
            })
            .filter(|(at, _)| at.is_finite())
            .collect();
        // Colours reach three nodes, h/2 apart, so pieces further apart do not affect each other.
        let reach = 2.0 * self.parameters.support_radius;
        let mut reference = Reference::new(
            self.parameters.clone(),
            self.surroundings.clone(),
            Vec::new(),
            poses,
        );
        let mut energy = 0.0;
        for piece in pieces(&particles, reach) {
            let low = piece.iter().fold(DVec3::MAX, |a, &i| a.min(particles[i].0));
            let high = piece.iter().fold(DVec3::MIN, |a, &i| a.max(particles[i].0));
            let nodes = (high - low) / (0.25 * reach) + 14.0;
            if nodes.element_product() > MOST_NODES {
                continue;
            }
            reference.positions = piece.iter().map(|&i| particles[i].0).collect();
            reference.membership = piece.iter().map(|&i| particles[i].1).collect();
            energy += reference.surface_energy();
        }
        energy
    }
}

/// Particles that are within two cells of `size` of each other, directly or by others.
fn pieces(particles: &[(DVec3, Option<usize>)], size: f64) -> Vec<Vec<usize>> {
    let mut cells: BTreeMap<[i32; 3], Vec<usize>> = BTreeMap::new();
    for (index, (at, _)) in particles.iter().enumerate() {
        let cell = (*at / size).floor().as_ivec3().to_array();
        cells.entry(cell).or_default().push(index);
    }
    let mut piece_of: HashMap<[i32; 3], usize> = HashMap::new();
    let mut all: Vec<Vec<usize>> = Vec::new();
    for &first in cells.keys() {
        if piece_of.contains_key(&first) {
            continue;
        }
        let (number, mut found, mut open) = (all.len(), Vec::new(), vec![first]);
        piece_of.insert(first, number);
        while let Some(cell) = open.pop() {
            found.extend(&cells[&cell]);
            for k in 0..27 {
                let next = IVec3::from_array(cell) + IVec3::new(k % 3, k / 3 % 3, k / 9) - 1;
                let next = next.to_array();
                if cells.contains_key(&next) && piece_of.insert(next, number).is_none() {
                    open.push(next);
                }
            }
        }
        all.push(found);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_apart_is_in_two_pieces() {
        let at = |x: f64| (DVec3::X * x, None);
        let particles = [at(0.1), at(9.3), at(0.9), at(1.8), at(8.7)];
        assert_eq!(pieces(&particles, 1.0), [vec![0, 2, 3], vec![4, 1]]);
    }
}
