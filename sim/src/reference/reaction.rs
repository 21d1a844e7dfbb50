//! Lines 26 and 27 of a liquid with a chemistry.

use super::chemistry::ReferenceChemistry;
use super::dilution::Pairs;
use super::neighbours::Neighbours;
use super::state::Reference;
use super::surroundings::WallSum;
use super::wall_heat::{GlassTouch, ReferenceRings};
use crate::chemistry::transport::{contact_area, surface_area};
use crate::chemistry::wall_heat::ring_at;
use glam::DVec3;

impl Reference {
    /// Line 26: diffusion, heat of solution and the other changes of particles'
    /// content by the chemistry.
    pub fn dilute(&mut self, neighbours: &Neighbours) {
        let Some(mut chemistry) = self.chemistry.take() else {
            return;
        };
        let longest = (0..self.positions.len()).map(|i| neighbours.of(i).count());
        let capacity = longest.max().unwrap_or(0) as u32;
        // The GPU's lists have this capacity; these have no limit.
        let capacity = capacity.max(self.parameters.list_capacity());
        let exchange = self.parameters.exchange(capacity);
        let pairs = Pairs {
            exchange: &exchange,
            positions: &self.positions,
            neighbours,
        };
        let walls = self
            .surroundings
            .sums(&self.positions, &self.membership, &self.motion);
        match &mut chemistry {
            ReferenceChemistry::Paper(paper) => {
                let densities = self.densities(&self.positions, neighbours);
                paper.dilute(&pairs, &walls, &densities);
            }
            ReferenceChemistry::Physical(physical) => {
                let kernel = self.kernel();
                let (volumes, _) = physical.bulk_of(&self.parameters);
                let slopes = pairs.sums(|i, j| {
                    let apart = self.positions[i] - self.positions[j];
                    apart.normalize_or_zero() * (volumes[j] * kernel.dw(apart.length()))
                });
                let touch = |(i, (wall, &liquid)): (usize, (&WallSum, &DVec3))| {
                    let open = (wall.gradient + liquid).length();
                    GlassTouch {
                        glass: contact_area(volumes[i], wall.gradient.length()),
                        surface: surface_area(volumes[i], open),
                        ring: self.ring_of(i, wall),
                    }
                };
                let touches: Vec<_> = walls.iter().zip(&slopes).enumerate().map(touch).collect();
                if let (Some(losses), None) = (&physical.law.losses, &physical.glass) {
                    let vessels = &self.surroundings.vessels;
                    let glass = ReferenceRings::new(vessels, losses, &self.parameters);
                    physical.glass = Some(glass);
                }
                physical.dilute(&pairs, &self.parameters, &touches);
            }
        }
        self.chemistry = Some(chemistry);
    }

    /// Ring that particle `i` touches, half a spacing away along the wall's gradient.
    pub(super) fn ring_of(&self, i: usize, wall: &WallSum) -> Option<(usize, usize)> {
        let flask = self.membership[i]?;
        let away: DVec3 = wall.gradient.normalize_or_zero() * (0.5 * self.parameters.spacing);
        let local = self.motion[flask].after.to_flask(self.positions[i] + away);
        let profile = &self.surroundings.vessels[flask].profile;
        Some((flask, ring_at(profile, local.y)))
    }

    /// The end of a frame: the glass takes the heat that the liquid gave it.
    pub(super) fn warm_glass(&mut self) {
        if let Some(ReferenceChemistry::Physical(physical)) = &mut self.chemistry
            && let (Some(glass), Some(losses)) = (&mut physical.glass, &physical.law.losses)
        {
            glass.advance(losses.ambient, self.parameters.frame_time);
        }
    }

    /// Line 27 with a coefficient per particle.
    pub(super) fn stir(&mut self, chemistry: &mut ReferenceChemistry, neighbours: &Neighbours) {
        let parameters = &self.parameters;
        let coefficients = match chemistry {
            ReferenceChemistry::Paper(paper) => paper.coefficients(parameters),
            ReferenceChemistry::Physical(physical) => physical.coefficients(parameters),
        };
        let stirred = self.stirred(neighbours, &coefficients);
        self.velocities = stirred.velocities;
        if let ReferenceChemistry::Paper(paper) = chemistry {
            paper.agitation = stirred.agitation;
        }
    }
}
