//! A hand that is seen (XR_EXT_hand_tracking). Where it holds no controller and the runtime has no hand_interaction profile, the
//! palm is the grip, and pinching thumb and index finger pulls the trigger.

use std::sync::Arc;

use glam::{Mat3, Quat, Vec3};
use openxr as xr;

use super::convert::{CallFailure, failed, pose, sound};
use crate::{Hand, Joints, Pose, Side};

/// Distance of the two fingertips' joints at which they touch, m: a joint lies half a finger's
/// thickness, some 8 mm, below the skin.
const CLOSED: f32 = 0.016;
/// Distance at which they are clearly apart, m.
const OPEN: f32 = 0.05;

/// A tracker for each hand.
pub(super) struct Seen([xr::HandTracker; 2]);

/// Part of the names of interaction profiles for bare hands.
const BARE: &str = "hand_interaction";

impl Seen {
    /// `None` where the runtime tracks no hands.
    pub(super) fn new(instance: &xr::Instance, session: &xr::Session<xr::Vulkan>) -> Option<Self> {
        instance.exts().ext_hand_tracking?;
        // A system without hand tracking refuses here, which is no error.
        let tracker = |hand| session.create_hand_tracker(hand).ok();
        Some(Self([tracker(xr::Hand::LEFT)?, tracker(xr::Hand::RIGHT)?]))
    }

    /// The hand's joints, if it is bare and all of them are known; sets grip and trigger of `hand` where no profile does.
    pub(super) fn read(
        &self,
        stage: &xr::Space,
        time: xr::Time,
        side: Side,
        hand: &mut Hand,
    ) -> Result<Option<Joints>, CallFailure> {
        // A runtime may derive joints from the controller.
        if hand.active && !hand.profile.contains(BARE) {
            return Ok(None);
        }
        let joints = stage
            .locate_hand_joints(&self.0[side as usize], time)
            .map_err(failed("xrLocateHandJointsEXT"))?;
        let Some(joints) = joints else {
            return Ok(None);
        };
        let joint = |index: xr::HandJoint| {
            let joint = &joints[index.into_raw() as usize];
            let valid =
                xr::SpaceLocationFlags::POSITION_VALID | xr::SpaceLocationFlags::ORIENTATION_VALID;
            let pose = pose(joint.pose);
            (joint.location_flags.contains(valid) && pose.is_valid()).then_some(pose)
        };
        if let (false, Some(palm), Some(thumb), Some(index)) = (
            hand.active,
            joint(xr::HandJoint::PALM),
            joint(xr::HandJoint::THUMB_TIP),
            joint(xr::HandJoint::INDEX_TIP),
        ) {
            hand.active = true;
            hand.valid = true;
            hand.tracked = true;
            hand.stage_from_grip = palm.compose(&palm_from_grip(side));
            hand.stage_from_aim = palm;
            hand.squeeze = 0.0;
            hand.trigger = closeness(thumb.position.distance(index.position));
            hand.profile = Arc::from("");
        }
        Ok(places(&joints))
    }
}

/// Positions and radii of all joints; `None` where one is not known.
fn places(joints: &xr::HandJointLocations) -> Option<Joints> {
    let mut places = [(Vec3::ZERO, 0.0); 26];
    for (place, joint) in places.iter_mut().zip(joints) {
        let known = joint
            .location_flags
            .contains(xr::SpaceLocationFlags::POSITION_VALID);
        let position = sound(joint.pose).0.filter(|_| known)?;
        let radius = Some(joint.radius).filter(|radius| radius.is_finite() && *radius >= 0.0)?;
        *place = (position, radius);
    }
    Some(Joints(places))
}

/// 0 apart to 1 touching.
fn closeness(distance: f32) -> f32 {
    ((OPEN - distance) / (OPEN - CLOSED)).clamp(0.0, 1.0)
}

/// The grip's axes in the palm's frame. With the fingers ahead and the thumb up, the palm joint
/// has -Z ahead and +Y out of the back of the hand; the grip has -Z up along the closed hand's
/// tube and +X to the right, out of the left palm and into the right one (OpenXR specification,
/// "Standard pose identifiers" and "Conventions of hand joints").
fn palm_from_grip(side: Side) -> Pose {
    let out = match side {
        Side::Left => -1.0,
        Side::Right => 1.0,
    };
    let axes = Mat3::from_cols(Vec3::Y * out, Vec3::Z, Vec3::X * out);
    Pose::new(Vec3::ZERO, Quat::from_mat3(&axes))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    #[test]
    fn a_hand_with_the_thumb_up_grips_upright() {
        // Fingers ahead (-Z), thumb up. The back of the right hand looks right, that of the left
        // one left: palm +Y is that way, palm +Z is back.
        for (side, back) in [(Side::Right, Vec3::X), (Side::Left, -Vec3::X)] {
            let palm = Mat3::from_cols(back.cross(Vec3::Z), back, Vec3::Z);
            let stage_from_palm = Pose::new(Vec3::ONE, Quat::from_mat3(&palm));
            let grip = stage_from_palm.compose(&palm_from_grip(side));
            let near = |a: Vec3, b: Vec3| assert!(a.distance(b) < 1e-6, "{side:?}: {a} {b}");
            // From the little finger to the thumb.
            near(grip.orientation * -Vec3::Z, Vec3::Y);
            near(grip.orientation * Vec3::X, Vec3::X);
            near(grip.position, Vec3::ONE);
        }
    }

    #[test]
    fn touching_fingers_pull_all_the_way() {
        assert_eq!(closeness(0.01), 1.0);
        assert_eq!(closeness(0.1), 0.0);
        assert!((closeness(0.033) - 0.5).abs() < 1e-6);
    }
}
