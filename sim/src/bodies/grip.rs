//! Hands that grip, hold and release bodies.

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::body::Body;
use super::reach;
use super::spec::Hand;
use crate::pose::Pose;

/// Farthest distance (m, at real size) from the grip point to a flask's surface
/// at which a closing hand takes hold of it.
///
/// The OpenXR grip pose lies at the palm's centre (specification, "Standard
/// pose identifiers"); 5 cm is about half the breadth of a hand (84 mm, median
/// of adults: NASA-STD-3000, anthropometry), so what the palm comes this near
/// lies under the fingers.
pub const GRIP_REACH: f32 = 0.05;
/// The squeeze at which an open hand closes. Our choice; between it and
/// [`GRIP_OPENS`] nothing changes, so that a finger that trembles on a
/// threshold does not let a flask fall.
pub const GRIP_CLOSES: f32 = 0.6;
/// The squeeze below which a closed hand opens.
pub const GRIP_OPENS: f32 = 0.4;
/// Highest speed (m/s, at real size) that a flask keeps when it is let go. An
/// adult throws a small ball at 20 m/s or more but a flask in a laboratory
/// never; above lies a tracker's leap, which must not become a missile.
pub const RELEASE_SPEED_MAX: f32 = 10.0;
/// Highest spin (rad/s) that a flask keeps when it is let go: five turns a
/// second, beyond what a wrist reaches with a flask in the hand.
pub const RELEASE_SPIN_MAX: f32 = 31.4;

/// A hand's memory from one step to the next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct GripState {
    pub(super) closed: bool,
    held: Option<Held>,
    /// It was absent in the last step.
    away: bool,
    /// It is there, and was absent in the step before, so that its way to where it is is unknown.
    pub(super) back: bool,
    /// It closed in this step: a body that it holds was moved by the other hand, or by none, until then.
    pub(super) took: bool,
}

impl GripState {
    /// Whether it closed in this step without taking hold of a body.
    pub(super) fn closes_on_nothing(&self) -> bool {
        self.took && self.held.is_none()
    }

    /// Takes a flask that broke from the hand: a hand that held it holds nothing, and must open before it takes hold again.
    pub(super) fn lose(&mut self, flask: usize) {
        self.held = self.held.filter(|held| held.flask != flask);
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Held {
    flask: usize,
    grip_from_flask: Pose,
    stage_from_flask: Pose,
    /// Height of the body over the hand when it was taken hold of, and the height that follows from the hand's now, m: a sash only slides,
    /// so that turning the hand does not move it.
    over_hand: f32,
    height: f32,
}

/// Advances both hands by a step: they open, close, take and follow.
///
/// A hand takes hold only in the step in which it closes, so that a fist that
/// passes by snatches nothing; and of a flask that the other hand holds it
/// takes over. If both close on one flask in the same step, the second has it.
pub(super) fn advance(
    grips: &mut [GripState; 2],
    hands: &[Hand; 2],
    flasks: &[Body],
    poses: &[Pose],
    reach: f32,
) {
    for index in 0..hands.len() {
        let hand = &hands[index];
        let present = hand.present && hand.stage_from_grip.is_valid();
        grips[index].back = present && grips[index].away;
        grips[index].away = !present;
        grips[index].took = false;
        if !present {
            continue;
        }
        let was_closed = grips[index].closed;
        // Comparisons with NaN are false: a squeeze that is no number changes nothing.
        if hand.squeeze >= GRIP_CLOSES {
            grips[index].closed = true;
        } else if hand.squeeze < GRIP_OPENS {
            (grips[index].closed, grips[index].held) = (false, None);
        }
        if grips[index].closed && !was_closed {
            grips[index].held = nearest(hand.stage_from_grip, flasks, poses, reach);
            grips[index].took = true;
            if let (Some(taken), Some(other)) = (grips[index].held, grips[1 - index].held)
                && taken.flask == other.flask
            {
                grips[1 - index].held = None;
            }
        }
        if let Some(held) = &mut grips[index].held {
            held.stage_from_flask = hand.stage_from_grip.compose(held.grip_from_flask);
            held.height = hand.stage_from_grip.position.y + held.over_hand;
        }
    }
}

fn nearest(stage_from_grip: Pose, flasks: &[Body], poses: &[Pose], reach: f32) -> Option<Held> {
    flasks
        .iter()
        .zip(poses)
        .enumerate()
        .filter(|(_, (flask, _))| !flask.fixed)
        .map(|(index, (flask, &stage_from_flask))| {
            let flask_from_stage = stage_from_flask.inverse();
            let grip = flask_from_stage.transform_point(stage_from_grip.position);
            let distance = reach::signed_distance(&flask.outline, grip);
            let held = Held {
                flask: index,
                grip_from_flask: stage_from_grip.inverse().compose(stage_from_flask),
                stage_from_flask,
                over_hand: stage_from_flask.position.y - stage_from_grip.position.y,
                height: stage_from_flask.position.y,
            };
            (distance, held)
        })
        .filter(|&(distance, _)| distance <= reach)
        .min_by(|(a, _), (b, _)| a.total_cmp(b))
        .map(|(_, held)| held)
}

/// The hand that holds `flask`, and the flask's pose in that hand (stage_from_flask).
pub(super) fn holder(grips: &[GripState; 2], flask: usize) -> Option<(usize, Pose)> {
    grips.iter().enumerate().find_map(|(hand, grip)| {
        grip.held
            .filter(|held| held.flask == flask)
            .map(|held| (hand, held.stage_from_flask))
    })
}

/// The height to which a hand slides a sash; `None` where no hand holds it.
pub(super) fn slid(grips: &[GripState; 2], flask: usize) -> Option<f32> {
    let held = grips.iter().filter_map(|grip| grip.held);
    held.into_iter()
        .find(|held| held.flask == flask)
        .map(|held| held.height)
}

/// Linear velocity (m/s) of the point at `centre` (flask frame) and angular velocity
/// (rad/s) that take `before` to `after` in `step` seconds, not limited.
pub(super) fn velocity_between(before: Pose, after: Pose, centre: Vec3, step: f32) -> (Vec3, Vec3) {
    let moved = after.transform_point(centre) - before.transform_point(centre);
    let turned = (after.orientation * before.orientation.conjugate()).normalize();
    // The shorter way round: q and −q are the same rotation.
    let turned = if turned.w < 0.0 { -turned } else { turned };
    (moved / step, turned.to_scaled_axis() / step)
}
