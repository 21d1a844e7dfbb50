//! Hands that are tracked (XR_EXT_hand_tracking).

use openxr::sys;
use sys::{Handle as _, Result as R};

use crate::abi::{given, place};
use crate::script::{Joint, Known, Pose};
use crate::state::{State, call};

/// Target of an XrHandTrackerEXT handle.
pub(crate) struct Tracker {
    pub session: u64,
    side: usize,
}

pub(crate) extern "system" fn create_hand_tracker(
    session: sys::Session,
    info: Option<&sys::HandTrackerCreateInfoEXT>,
    tracker: Option<&mut sys::HandTrackerEXT>,
) -> R {
    call("xrCreateHandTrackerEXT", |state| {
        state.session_has(session, "XR_EXT_hand_tracking")?;
        let info = given!(info, sys::HandTrackerCreateInfoEXT);
        let side = match info.hand {
            sys::HandEXT::LEFT => 0,
            sys::HandEXT::RIGHT => 1,
            _ => return Err(R::ERROR_VALIDATION_FAILURE),
        };
        if info.hand_joint_set != sys::HandJointSetEXT::DEFAULT {
            return Err(R::ERROR_FEATURE_UNSUPPORTED);
        }
        let raw = state.handle();
        let session = session.into_raw();
        state.trackers.insert(raw, Tracker { session, side });
        *place!(tracker) = sys::HandTrackerEXT::from_raw(raw);
        Ok(R::SUCCESS)
    })
}

pub(crate) extern "system" fn destroy_hand_tracker(tracker: sys::HandTrackerEXT) -> R {
    call("xrDestroyHandTrackerEXT", |state| {
        let removed = state.trackers.remove(&tracker.into_raw());
        removed.map(|_| R::SUCCESS).ok_or(R::ERROR_HANDLE_INVALID)
    })
}

impl State {
    /// A joint in the frame of the space.
    fn joint_from(
        &mut self,
        info: &sys::HandJointsLocateInfoEXT,
        session: u64,
        joint: &Joint,
    ) -> Result<sys::HandJointLocationEXT, R> {
        let there = (joint.pose, joint.known);
        let (pose, known) = self.seen_from(info.base_space, session, info.time, there)?;
        let (location_flags, pose) = known.show(&pose);
        Ok(sys::HandJointLocationEXT {
            location_flags,
            pose,
            radius: joint.radius,
        })
    }
}

pub(crate) extern "system" fn locate_hand_joints(
    tracker: sys::HandTrackerEXT,
    info: Option<&sys::HandJointsLocateInfoEXT>,
    locations: Option<&mut sys::HandJointLocationsEXT>,
) -> R {
    call("xrLocateHandJointsEXT", |state| {
        let info = given!(info, sys::HandJointsLocateInfoEXT);
        let locations = given!(locations, sys::HandJointLocationsEXT);
        let held = state.trackers.get(&tracker.into_raw());
        let held = held.ok_or(R::ERROR_HANDLE_INVALID)?;
        let (session, side) = (held.session, held.side);
        let seen = state.world.joints[side].clone();
        locations.is_active = seen.is_some().into();
        let unseen = Joint {
            pose: Pose::IDENTITY,
            radius: 0.0,
            known: Known::NOTHING,
        };
        let joints = seen.unwrap_or_else(|| vec![unseen; sys::HAND_JOINT_COUNT_EXT]);
        if locations.joint_count as usize != sys::HAND_JOINT_COUNT_EXT
            || joints.len() != sys::HAND_JOINT_COUNT_EXT
            || locations.joint_locations.is_null()
        {
            return Err(R::ERROR_VALIDATION_FAILURE);
        }
        for (index, joint) in joints.iter().enumerate() {
            let location = state.joint_from(info, session, joint)?;
            // SAFETY: OpenXR's callers pass room for as many joints as they state, which are as many as these.
            unsafe { locations.joint_locations.add(index).write(location) };
        }
        Ok(R::SUCCESS)
    })
}
