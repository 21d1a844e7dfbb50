//! Prediction, flask constraint and the new state (lines 15–17 and 22–25).

use super::placement::Motion;
use super::surroundings::{Surroundings, Table};
use crate::flask::project_from;
use glam::DVec3;

/// A particle's position and the flask that it is in.
pub type Place = (DVec3, Option<usize>);

/// Line 16: x* = x + Δt·v + Δt²·g, and the flask constraint on it already,
/// so that neighbours and density are those of a place it can be in.
pub fn predict(
    surroundings: &Surroundings,
    motion: &[Motion],
    margin: f64,
    (time, gravity): (f64, DVec3),
    positions: &[DVec3],
    velocities: &[DVec3],
    membership: &[Option<usize>],
) -> Vec<DVec3> {
    let predicted = |((&position, &velocity), &member_of)| {
        let free = position + velocity * time + gravity * (time * time);
        constrain(surroundings, motion, margin, (position, member_of), free).0
    };
    let states = positions.iter().zip(velocities).zip(membership);
    states.map(predicted).collect()
}

/// Lines 23–25 for one particle: the new place and velocity.
///
/// Line 24 limits the velocity alone; x* is limited with it, or line 25
/// would still tunnel. The flask constraint comes after that: what a flask
/// that moves faster than v_max takes along stays in it. What is not a number
/// comes out as none, to be taken out.
pub fn commit(
    surroundings: &Surroundings,
    motion: &[Motion],
    margin: f64,
    (time, max_speed): (f64, f64),
    (position, member_of): Place,
    solved: DVec3,
) -> (Place, DVec3) {
    if !is_finite(solved - position) {
        return ((DVec3::NAN, member_of), DVec3::NAN);
    }
    let limited = position + (solved - position).clamp_length_max(max_speed * time);
    let place = constrain(surroundings, motion, margin, (position, member_of), limited);
    let velocity = ((place.0 - position) / time).clamp_length_max(max_speed);
    (place, velocity)
}

/// Line 23: the flask constraint, table and floor, on a particle that was at
/// its place by the previous poses and is at `predicted` by the current ones
/// (stage, metres).
///
/// What is inside a flask is that flask's alone; what is in none, or has
/// just left one by its mouth, is every other's. What is not a number is
/// left alone.
pub fn constrain(
    surroundings: &Surroundings,
    motion: &[Motion],
    margin: f64,
    (position, member_of): Place,
    predicted: DVec3,
) -> Place {
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
        // Only what was changed goes through two transforms and their rounding.
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

/// What was above the table stays above it, below it below, beside it beside.
/// Where a flask has put a particle into the table, it rises.
fn out_of_table(table: &Table, margin: f64, position: DVec3, at: DVec3) -> DVec3 {
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
