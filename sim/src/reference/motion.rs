//! Prediction, flask constraint and the new state (lines 15–17 and 22–25).

use super::placement::Motion;
use super::state::Reference;
use super::surroundings::{Slab, Surroundings};
use crate::flask::project_from;
use glam::DVec3;

/// A particle's position and the flask that it is in.
pub type Placed = (DVec3, Option<usize>);

impl Reference {
    /// Lines 15–17: x* = x + Δt·v + Δt²·g of all particles, and the flask constraint
    /// on it already, so that neighbours and density are those of a place it can be in.
    pub fn predict(&self) -> Vec<DVec3> {
        let time = self.parameters.substep_time();
        let gravity = DVec3::from_array(self.parameters.gravity);
        let predicted = |i: usize| {
            let free = self.positions[i] + self.velocities[i] * time + gravity * (time * time);
            self.constrained(i, free).0
        };
        (0..self.positions.len()).map(predicted).collect()
    }

    /// Lines 22–25: flask constraint, velocity and position from the corrected x*.
    ///
    /// Line 24 limits the velocity alone; x* is limited with it, or line 25
    /// would still tunnel. The flask constraint comes after that: liquid that a flask
    /// faster than v_max takes along stays in it. A position that is not a number
    /// stays one, and the particle is taken out.
    pub fn commit(&mut self, solved: &[DVec3]) {
        let (time, max_speed) = (self.parameters.substep_time(), self.parameters.max_speed);
        for (i, &solved) in solved.iter().enumerate() {
            let position = self.positions[i];
            if !is_finite(solved - position) {
                (self.positions[i], self.velocities[i]) = (DVec3::NAN, DVec3::NAN);
                continue;
            }
            let lines = self.held_back(i, solved);
            let way = solved + lines - position;
            let limited = position + way.clamp_length_max(max_speed * time);
            (self.positions[i], self.membership[i]) = self.constrained(i, limited);
            self.velocities[i] =
                ((self.positions[i] - position) / time).clamp_length_max(max_speed);
        }
    }

    /// How far a wall holds back particle `i` on its way to `to`, across the surface's line.
    fn held_back(&self, i: usize, to: DVec3) -> DVec3 {
        let Some(hold) = self.held.get(i) else {
            return DVec3::ZERO;
        };
        let from = match hold.flask {
            None => self.positions[i],
            Some(flask) => {
                let Motion { before, after, .. } = self.motion[flask];
                after.to_stage(before.to_flask(self.positions[i]))
            }
        };
        let across = hold.acceleration.normalize_or_zero();
        let most = hold.acceleration.length() * self.parameters.substep_time().powi(2);
        -across * (to - from).dot(across).clamp(-most, most)
    }

    /// [`constrain`] of particle `i`.
    fn constrained(&self, i: usize, predicted: DVec3) -> Placed {
        let place = (self.positions[i], self.membership[i]);
        let margin = self.parameters.margin;
        constrain(&self.surroundings, &self.motion, margin, place, predicted)
    }
}

/// Line 23: the flask constraint, table and floor, on a particle that was at
/// its place by the previous poses and is at `predicted` by the current ones
/// (stage, metres).
///
/// Only its own flask acts on a particle that is inside one; all others act on
/// one that is in none, or has just left one by its mouth. A position that is
/// not a number is returned as it is.
pub fn constrain(
    surroundings: &Surroundings,
    motion: &[Motion],
    margin: f64,
    (position, member_of): Placed,
    predicted: DVec3,
) -> Placed {
    if !is_finite(predicted - position) {
        return (predicted, member_of);
    }
    let mut at = predicted;
    let others = (0..motion.len()).filter(|&flask| Some(flask) != member_of);
    for flask in member_of.into_iter().chain(others) {
        let Motion { before, after, .. } = motion[flask];
        let projection = project_from(
            &surroundings.vessels[flask].profile,
            member_of == Some(flask),
            before.to_flask(position),
            after.to_flask(at),
            margin,
        );
        // Only changed positions go through two transforms and their rounding.
        if projection.constrained {
            at = after.to_stage(projection.position);
        }
        if projection.inside {
            return (at, Some(flask));
        }
    }
    if let Some(table) = &surroundings.table {
        at = out_of_table(table, margin, position, at);
    }
    if let Some(floor) = surroundings.floor {
        at.y = at.y.max(floor + margin);
    }
    (at, None)
}

/// Whether a way is a number, and its length, too.
fn is_finite(way: DVec3) -> bool {
    way.length_squared().is_finite()
}

/// A particle above the table stays above it, one below it below, one beside it beside.
/// Where a flask has put a particle into the table, it rises.
fn out_of_table(table: &Slab, margin: f64, position: DVec3, at: DVec3) -> DVec3 {
    if at.y <= table.under - margin || at.y >= table.top + margin || !table.covers(at) {
        at
    } else if position.y <= table.under {
        at.with_y(table.under - margin)
    } else if position.y >= table.top || table.covers(position) {
        at.with_y(table.top + margin)
    } else {
        position.with_y(at.y)
    }
}
