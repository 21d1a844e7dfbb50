//! Algorithm 1 itself: a frame of it, line by line.

use super::chemistry::retain;
use super::measure::DensityError;
use super::neighbours::{self, Neighbours};
use super::placement::Motion;
use super::state::Reference;
use super::visibility::see_each_other;
use super::{density, forces};
use crate::pose::Pose;
use glam::DVec3;

impl Reference {
    /// A frame of Δt_f in which the flasks go from the poses `before` to
    /// `after` (`stage_from_flask`, one per vessel each).
    pub fn step(&mut self, before: &[Pose], after: &[Pose]) {
        let count = self.parameters.substeps;
        let time = self.parameters.substep_time(); // line 13
        let mass = self.parameters.particle_mass();
        let surface = self.parameters.surface.as_ref();
        let impulses = surface.map_or(Vec::new(), |s| s.impulses(mass, count, time));
        for substep in 0..count {
            // line 14; lines 1–5 belong in here, see Motion::of_substep
            self.motion = before
                .iter()
                .zip(after)
                .map(|(&from, &to)| Motion::of_substep(from, to, substep, count, time))
                .collect();
            let impulse = impulses.iter().find(|&&(first, _)| first == substep);
            self.substep(impulse.map(|&(_, substeps)| f64::from(substeps) * time));
        }
        self.warm_glass();
        self.find_eddies();
    }

    /// `tension` is the time (s) for which surface tension acts at once, if it acts in this substep.
    fn substep(&mut self, tension: Option<f64>) {
        let predicted = self.predict(); // lines 15–17
        let neighbours = self.neighbours(&predicted); // lines 9–12
        let solved = self.solve(predicted, &neighbours); // lines 18–21
        self.commit(&solved); // lines 22–25
        if let Some(time) = tension {
            self.hold_together(&neighbours, time); // line 28, surface tension
        }
        self.dilute(&neighbours); // line 26
        let accelerations = self.internal_forces(&neighbours); // line 28
        self.smooth(&neighbours); // line 27
        self.push(&accelerations);
        self.take_out_non_finite();
    }

    /// Line 10 at `positions`: everything that corrections may bring within h.
    pub fn neighbours(&self, positions: &[DVec3]) -> Neighbours {
        let radius = self.parameters.support_radius * (1.0 + 2.0 * self.parameters.list_reach);
        neighbours::find(positions, radius, |i, j| {
            see_each_other(
                &self.surroundings,
                &self.motion,
                (positions[i], self.membership[i]),
                (positions[j], self.membership[j]),
            )
        })
    }

    /// Lines 18–21 from the prediction to the corrected x*.
    fn solve(&mut self, predicted: Vec<DVec3>, neighbours: &Neighbours) -> Vec<DVec3> {
        let per_area = self.parameters.substep_time().powi(2);
        let mut at = predicted;
        let mut lambda = vec![0.0; at.len()];
        let mut change = vec![0.0; at.len()];
        if self.parameters.carry_rate > 0.0 {
            lambda = self
                .carried
                .iter()
                .map(|p| (p * per_area).min(0.0))
                .collect();
            change.clone_from(&lambda);
            self.displace(&mut at, neighbours, &change);
        }
        let before = self.walls_before();
        let iterations = self.parameters.iterations;
        for coefficients in self.parameters.relaxation.coefficients(iterations) {
            let densities = self.mirrored_densities(&at, neighbours, &before);
            let a = self.parameters.gradient_sum();
            density::multipliers(&densities, a, coefficients, &mut lambda, &mut change); // line 19
            self.displace(&mut at, neighbours, &change); // line 20
        }
        let share = self.parameters.carried_share();
        for (carried, lambda) in self.carried.iter_mut().zip(lambda) {
            *carried += share * (lambda / per_area - *carried);
        }
        at
    }

    /// Line 27: XSPH, and anti-viscosity where something boils.
    pub fn smooth(&mut self, neighbours: &Neighbours) {
        if let Some(mut chemistry) = self.chemistry.take() {
            self.stir(&mut chemistry, neighbours);
            self.chemistry = Some(chemistry);
            return;
        }
        if self.parameters.viscosity == 0.0 {
            return;
        }
        self.velocities = self.xsph(neighbours);
    }

    /// Line 28: accelerations by internal forces, m/s², of each force that is
    /// not zero.
    ///
    /// By the velocities that line 24 left, as those of line 27 are: a vorticity
    /// of smoothed velocities would take the GPU a second pass over the
    /// neighbours, and lines 27 and 28 stand in one loop over the particles
    /// in the paper, so that neither order is the listing's.
    pub fn internal_forces(&self, neighbours: &Neighbours) -> Vec<Vec<DVec3>> {
        let parameters = &self.parameters;
        let mut accelerations = Vec::new();
        if parameters.vorticity > 0.0 {
            let volume = parameters.particle_volume();
            let kernel = self.kernel();
            let (positions, velocities) = (&self.positions, &self.velocities);
            let vorticities = forces::vorticity(&kernel, volume, positions, velocities, neighbours);
            let strength = (volume, parameters.vorticity);
            let confinement =
                forces::confinement(&kernel, strength, positions, &vorticities, neighbours);
            accelerations.push(confinement);
        }
        accelerations
    }

    /// v ← v + Δt·a for each of `accelerations` (m/s²), at most v_max: line 24
    /// again, since these and what boils come after it.
    pub fn push(&mut self, accelerations: &[Vec<DVec3>]) {
        let time = self.parameters.substep_time();
        for acceleration in accelerations {
            for (velocity, acceleration) in self.velocities.iter_mut().zip(acceleration) {
                *velocity += *acceleration * time;
            }
        }
        for velocity in &mut self.velocities {
            *velocity = velocity.clamp_length_max(self.parameters.max_speed);
        }
    }

    /// A particle that is no longer a number is taken out and counted. It
    /// had no neighbours, so it has not spread.
    fn take_out_non_finite(&mut self) {
        let finite = |(x, v): (&DVec3, &DVec3)| x.is_finite() && v.is_finite();
        let keep: Vec<bool> = self
            .positions
            .iter()
            .zip(&self.velocities)
            .map(finite)
            .collect();
        self.removed += keep.iter().filter(|&&keep| !keep).count();
        retain(&mut self.ids, &keep);
        retain(&mut self.positions, &keep);
        retain(&mut self.velocities, &keep);
        retain(&mut self.carried, &keep);
        retain(&mut self.membership, &keep);
        if !self.held.is_empty() {
            retain(&mut self.held, &keep);
        }
        if let Some(chemistry) = &mut self.chemistry {
            chemistry.retain(&keep);
        }
    }

    /// max(0, ρ/ρ₀ − 1) of the state.
    pub fn density_error(&self) -> DensityError {
        let neighbours = self.neighbours(&self.positions);
        DensityError::of(&self.densities(&self.positions, &neighbours))
    }
}
