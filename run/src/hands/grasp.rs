//! A hand closes on a flask: the palm comes to the glass, and each finger bends until it touches it.

use glam::{Affine3A, Mat3, Quat, Vec3};
use vitriol_xr::{Pose, Side};

use vitriol_render::Bone;

use super::bones::{Joints, THUMB_BONES, bones_of, web};
use super::held_glass::Glass;
use super::posture::{CLOSED, Chain, INDEX, Posture, SPREAD_OUT, Thumb, in_grip};

/// How far the palm is drawn from where it is, m, to be at the glass: as far as a hand reaches for what it grips
/// (`GRIP_REACH` of the bodies) and a little more; and out of the glass, since no hand is in it: across a pot.
const REACH: f32 = 0.06;
const BACK: f32 = 0.17;
/// The distance that is taken for none, m.
const TOUCH: f32 = 5e-4;
/// Places along a bone at which its distance is taken: at most 7 mm apart, so that between two of them a cylinder of
/// 70 mm is no more than 0.2 mm nearer.
const PLACES: usize = 8;
/// The first of them that moves enough where a bone turns about its end.
const MOVES: usize = 2;
/// How far a thumb swings about its root at most, rad, as fast as it turns anywhere on its way.
const SWING: f32 = 1.8;
/// Most steps of a joint; it stops where it is then.
const STEPS: usize = 40;

/// How a hand is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grasp {
    /// Its joints' angles.
    pub posture: Posture,
    /// How far it is from where the grip is, out of its palm, m.
    pub shift: f32,
}

impl Grasp {
    /// A hand that holds nothing, closed by 0 (open) to 1 (a fist).
    pub fn empty(closed: f32) -> Self {
        Self {
            posture: Posture::empty(closed),
            shift: 0.0,
        }
    }

    /// The joints of a hand that holds a controller, in the grip's parent.
    pub fn joints(&self, stage_from_grip: &Pose, side: Side) -> Joints {
        let joints = self.posture.joints();
        joints.map(|(at, radius)| {
            let at = in_grip(at + self.shift * Vec3::Y, side);
            (stage_from_grip.transform_point(at), radius)
        })
    }
}

/// A flask at a hand.
struct Held<'a> {
    glass: &'a Glass,
    /// Of the hand's frame; a reflection for a right one.
    flask_from_hand: Affine3A,
}

impl Held<'_> {
    /// How far a bone is from the glass, m, from one of its places on.
    fn clearance(&self, [a, b]: [Vec3; 2], [ra, rb]: [f32; 2], from: usize) -> f32 {
        let [a, b] = [a, b].map(|end| self.flask_from_hand.transform_point3(end));
        (from..PLACES)
            .map(|n| {
                let share = n as f32 / (PLACES - 1) as f32;
                self.glass.distance(a.lerp(b, share)) - (ra + share * (rb - ra))
            })
            .fold(f32::INFINITY, f32::min)
    }

    /// Least distance, m, from the glass to a chain's bones beyond a joint that it bends about: the joint itself stays, and may touch the
    /// glass already.
    fn beyond(&self, chain: &Chain, joint: usize) -> f32 {
        let bones = chain.windows(2).enumerate().skip(joint);
        bones
            .map(|(n, pair)| {
                let from = if n == joint { MOVES } else { 0 };
                self.clearance([pair[0].0, pair[1].0], [pair[0].1, pair[1].1], from)
            })
            .fold(f32::INFINITY, f32::min)
    }
}

/// The hand at that grip pose as it holds a flask, both in one frame, m.
pub fn closed_on(
    stage_from_grip: &Pose,
    side: Side,
    glass: &Glass,
    stage_from_flask: &Pose,
) -> Grasp {
    let flask_from_grip = stage_from_flask.inverse().compose(stage_from_grip);
    let axes = Vec3::AXES.map(|axis| in_grip(axis, side));
    let turn = Mat3::from_quat(Quat::normalize(flask_from_grip.orientation));
    let mut held = Held {
        glass,
        flask_from_hand: Affine3A::from_mat3_translation(
            turn * Mat3::from_cols_array_2d(&axes.map(|axis| axis.to_array())),
            flask_from_grip.position,
        ),
    };
    let shift = seat(&held);
    held.flask_from_hand *= Affine3A::from_translation(shift * Vec3::Y);
    let mut posture = SPREAD_OUT;
    for n in 0..4 {
        close_finger(&held, &mut posture, n);
    }
    close_thumb(&held, &mut posture.thumb);
    Grasp { posture, shift }
}

/// How far the hand goes, spread out, until anything but its thumb's last bones touches the glass; not at all where nothing
/// lies before it.
fn seat(held: &Held<'_>) -> f32 {
    let bones = bones_of(&SPREAD_OUT.joints());
    let clearance = |shift: f32| {
        let (thumb, palm) = bones.split_at(THUMB_BONES);
        let apart = |bone: &Bone| {
            let ends = bone.ends.map(|end| end + shift * Vec3::Y);
            held.clearance(ends, bone.radii, 0)
        };
        let bones = thumb.iter().take(1).chain(palm);
        bones.map(apart).fold(f32::INFINITY, f32::min)
    };
    let mut shift = -BACK;
    for _ in 0..STEPS {
        let free = clearance(shift);
        if free < TOUCH {
            // Where it is in the glass from the outset there is no way out.
            return if shift > -BACK { shift } else { 0.0 };
        }
        // No part of it goes further than the hand, so it cannot go through.
        shift += free;
        if shift > REACH {
            return 0.0;
        }
    }
    shift
}

/// Bends a finger about its knuckle until a bone touches the glass, then about each joint beyond: so it lies round what it
/// holds.
fn close_finger(held: &Held<'_>, posture: &mut Posture, n: usize) {
    for joint in 0..3 {
        let begin = *posture;
        let (open, closed) = (begin.fingers[n][joint], CLOSED.fingers[n][joint]);
        let bent = |share: f32| {
            let mut bent = begin;
            bent.fingers[n][joint] = open + share * (closed - open);
            bent
        };
        let free = |share: f32| held.beyond(&bent(share).finger(n), joint);
        let long = long(&begin.finger(n), joint);
        *posture = bent(until_touch((closed - open) * long, free));
    }
}

/// Swings the thumb about its root, with the skin between it and the index finger, then bends it about each joint.
fn close_thumb(held: &Held<'_>, thumb: &mut Thumb) {
    let begin = *thumb;
    let swung = |share: f32| Thumb {
        bends: begin.bends,
        ..begin.towards(&CLOSED.thumb, share)
    };
    let free = |share: f32| {
        let chain = swung(share).chain();
        let web = web(chain[0].0, chain[1].0, INDEX);
        let of_web = held.clearance(web.ends, web.radii, 0);
        held.beyond(&chain, 0).min(of_web)
    };
    *thumb = swung(until_touch(SWING * long(&begin.chain(), 0), free));
    for joint in 0..2 {
        let begin = *thumb;
        let (open, closed) = (begin.bends[joint], CLOSED.thumb.bends[joint]);
        let bent = |share: f32| {
            let mut bent = begin;
            bent.bends[joint] = open + share * (closed - open);
            bent
        };
        let free = |share: f32| held.beyond(&bent(share).chain(), joint + 1);
        let long = long(&begin.chain(), joint + 1);
        *thumb = bent(until_touch((closed - open) * long, free));
    }
}

/// The first share of a movement at which nothing is free any more, 0 to 1; no part goes further than `way` (m).
fn until_touch(way: f32, free: impl Fn(f32) -> f32) -> f32 {
    let mut share = 0.0;
    for _ in 0..STEPS {
        let apart = free(share);
        if apart < TOUCH {
            return share;
        }
        share += apart / way.max(TOUCH);
        if share >= 1.0 {
            return 1.0;
        }
    }
    share
}

/// From a joint over all that are beyond it to the tip's skin, m.
fn long(chain: &Chain, joint: usize) -> f32 {
    let bones = chain[joint..].windows(2);
    let bones = bones.map(|pair| pair[0].0.distance(pair[1].0));
    bones.sum::<f32>() + chain[3].1
}
