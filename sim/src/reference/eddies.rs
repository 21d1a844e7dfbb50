//! Eddies that are not resolved, by the filtered flow at a frame's end.

use super::chemistry::ReferenceChemistry;
use super::neighbours::Neighbours;
use super::state::Reference;
use crate::chemistry::eddies::Mixing;
use glam::{DMat3, DVec3};

/// Velocity (m/s) and density over the rest density.
type Flow = (DVec3, f64);

/// Least part of a full neighbourhood's first moment by which a gradient is
/// normalised, which is about what a level surface has: drops that fly side by
/// side are no flow.
const LEAST_MOMENT: f64 = 0.6;

impl Reference {
    /// K of every particle's eddies, m²/s, at the present positions and velocities.
    pub fn eddies(&self, mixing: &Mixing, neighbours: &Neighbours) -> Vec<f64> {
        let (passes, share) = mixing.smoothing(self.parameters.support_radius);
        let (_, lightness) = self.bulk();
        let densities = lightness.iter().map(|lightness| 1.0 / lightness);
        let mut flow: Vec<Flow> = self.velocities.iter().copied().zip(densities).collect();
        for _ in 0..passes {
            flow = self.smoothed(&flow, share, neighbours);
        }
        let of = |i: usize| {
            let (strain, buoyancy) = self.strain(&flow, i, neighbours);
            mixing.diffusivity(strain, buoyancy)
        };
        (0..flow.len()).map(of).collect()
    }

    /// The end of a frame: the eddies that mix in the next one.
    pub(super) fn find_eddies(&mut self) {
        let Some(ReferenceChemistry::Physical(physical)) = &self.chemistry else {
            return;
        };
        let mixing = physical.law.mixing;
        let neighbours = self.neighbours(&self.positions);
        let eddies = self.eddies(&mixing, &neighbours);
        if let Some(ReferenceChemistry::Physical(physical)) = &mut self.chemistry {
            physical.eddies = eddies;
        }
    }

    /// The flow, of which `share` is the mean by the kernel around a particle.
    fn smoothed(&self, flow: &[Flow], share: f64, neighbours: &Neighbours) -> Vec<Flow> {
        let kernel = self.kernel();
        let of = |i: usize| {
            let (own, density) = flow[i];
            let mut sum = (own * kernel.w(0.0), density * kernel.w(0.0));
            let mut whole = kernel.w(0.0);
            for j in neighbours.of(i) {
                let weight = kernel.w(self.positions[i].distance(self.positions[j]));
                sum = (sum.0 + flow[j].0 * weight, sum.1 + flow[j].1 * weight);
                whole += weight;
            }
            let velocity = own + (sum.0 / whole - own) * share;
            (velocity, density + (sum.1 / whole - density) * share)
        };
        (0..flow.len()).map(of).collect()
    }

    /// |S|² and N² (1/s²) of `flow` at particle `i`: sums of V₀∇W over the
    /// first moment that they have, so that a linear flow's are exact in any
    /// neighbourhood that is alike along all axes.
    fn strain(&self, flow: &[Flow], i: usize, neighbours: &Neighbours) -> (f64, f64) {
        let kernel = self.kernel();
        let volume = self.parameters.particle_volume();
        let (mut slope, mut density, mut moment) = (DMat3::ZERO, DVec3::ZERO, 0.0);
        for j in neighbours.of(i) {
            let apart = self.positions[i] - self.positions[j];
            let towards = apart.normalize_or_zero() * (volume * kernel.dw(apart.length()));
            let change = flow[j].0 - flow[i].0;
            slope += DMat3::from_cols(change * towards.x, change * towards.y, change * towards.z);
            density += towards * (flow[j].1 - flow[i].1);
            moment -= apart.dot(towards) / 3.0;
        }
        let scale = 1.0 / moment.max(LEAST_MOMENT);
        let strain = (slope + slope.transpose()) * (0.5 * scale);
        let [x, y, z] = strain.to_cols_array_2d();
        let trace = (x[0] + y[1] + z[2]) / 3.0;
        let squares: f64 = [x, y, z].iter().flatten().map(|s| s * s).sum();
        // Without what expands; of S, −3·trace² is what that takes off.
        let squares = (squares - 3.0 * trace * trace).max(0.0);
        let gravity = DVec3::from_array(self.parameters.gravity);
        (2.0 * squares, gravity.dot(density) * scale / flow[i].1)
    }
}
