//! Goggles and gloves that the user wears: goggles go with the head, gloves with the hands.

use glam::{Quat, Vec3};
use serde::{Deserialize, Serialize};

use super::body::Body;
use super::grip::{GripState, holder};
use super::reach;
use super::spec::{Hand, Role, Worn};
use crate::pose::Pose;

/// How near the eyes' middle (m, at real size) the middle of goggles must be when they are let go, to be worn: they are as broad as a
/// face. Our choice.
const AT_EYES: f32 = 0.15;
/// How near another hand's palm (m, at real size) a hand takes hold of its glove: a hand is 0.19 m long (median of adults:
/// NASA-STD-3000), and its wrist is half of that from the palm's middle.
const AT_HAND: f32 = 0.12;
/// How far it must go from there (m, at real size), closed, until the glove is off: a hand that closes beside the other one, at a button
/// or a flask, pulls nothing. A glove is 0.24 m long.
const PULLED: f32 = 0.22;

/// State of the goggles and gloves that the user wears: which are on, where the goggles are, and which glove a hand pulls at.
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct Wearing {
    /// Goggles and gloves that are on.
    pub worn: Worn,
    /// Pose of the goggles while they are worn, at the head where it was tracked last.
    place: Option<Pose>,
    /// Whether a hand held the goggles in the last step.
    were_held: bool,
    /// By hand, whether it has hold of the other's glove.
    pulls: [bool; 2],
}

impl Wearing {
    pub fn of(worn: Worn) -> Self {
        Self {
            worn,
            place: None,
            were_held: false,
            pulls: [false; 2],
        }
    }

    /// Advances by a step, in which the grips were advanced; `flasks` and `poses` are of all bodies, poses those before the step.
    pub fn advance(
        &mut self,
        (grips, hands): (&[GripState; 2], &[Hand; 2]),
        head: Option<Pose>,
        (flasks, poses): (&[Body], &[Pose]),
        scale: f32,
    ) {
        let of_role = |role| flasks.iter().position(|it| it.role == Some(role));
        if let (Some(on), Some(goggles)) = (&mut self.worn.goggles, of_role(Role::Goggles)) {
            let is_held = holder(grips, goggles).is_some();
            let let_go = std::mem::replace(&mut self.were_held, is_held) && !is_held;
            let near = head.is_some_and(|head| {
                let middle = 0.5 * height(&flasks[goggles]) * Vec3::Y;
                let apart = poses[goggles]
                    .transform_point(middle)
                    .distance(head.position);
                apart <= AT_EYES * scale
            });
            *on = !is_held && (*on || (let_go && near));
            self.place = match (*on, head) {
                (true, Some(head)) => Some(head.compose(head_from_goggles())),
                (true, None) => self.place,
                (false, _) => None,
            };
        }
        if let (Some(on), Some(gloves)) = (&mut self.worn.gloves, of_role(Role::Gloves)) {
            for hand in 0..hands.len() {
                let (own, other) = (&hands[hand], &hands[1 - hand]);
                if !(own.present && other.present && grips[hand].closed) {
                    self.pulls[hand] = false;
                }
                if !own.present {
                    continue;
                }
                let at = own.stage_from_grip.position;
                let apart = other.stage_from_grip.position.distance(at);
                if self.pulls[hand] && apart > PULLED * scale {
                    (self.pulls[hand], on[1 - hand]) = (false, false);
                }
                if !grips[hand].closes_on_nothing() {
                    continue;
                }
                let in_box = poses[gloves].inverse().transform_point(at);
                let from_box = reach::signed_distance(&flasks[gloves].outline, in_box);
                if from_box <= super::GRIP_REACH * scale {
                    on[hand] = true;
                } else {
                    self.pulls[hand] = other.present && on[1 - hand] && apart <= AT_HAND * scale;
                }
            }
        }
    }

    /// Pose (stage_from_body) of the goggles while they are worn, at the head where it was tracked last; `None` of other bodies.
    pub fn place(&self, flask: &Body) -> Option<Pose> {
        self.place.filter(|_| flask.role == Some(Role::Goggles))
    }
}

/// Goggles lie on the bench with their lenses up, +y; before eyes these look along −z.
fn head_from_goggles() -> Pose {
    Pose::new(
        Vec3::ZERO,
        Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2),
    )
}

fn height(flask: &Body) -> f32 {
    flask.outline.last().map_or(0.0, |top| top[1])
}
