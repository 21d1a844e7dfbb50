//! Conversion of OpenXR's poses, fields of view, states and errors to ours.

use glam::{Quat, Vec3};
use openxr as xr;

use crate::{Fov, HeadsetError, Pose, SessionState};

/// Converts a pose whose flags state that position and orientation are valid.
pub(super) fn pose(pose: xr::Posef) -> Pose {
    let (p, q) = (pose.position, pose.orientation);
    Pose::new(
        Vec3::new(p.x, p.y, p.z),
        Quat::from_xyzw(q.x, q.y, q.z, q.w),
    )
}

pub(super) fn posef(pose: &Pose) -> xr::Posef {
    let (p, q) = (pose.position, pose.orientation);
    xr::Posef {
        orientation: xr::Quaternionf {
            x: q.x,
            y: q.y,
            z: q.z,
            w: q.w,
        },
        position: xr::Vector3f {
            x: p.x,
            y: p.y,
            z: p.z,
        },
    }
}

pub(super) fn fov(fov: xr::Fovf) -> Fov {
    Fov {
        left: fov.angle_left,
        right: fov.angle_right,
        up: fov.angle_up,
        down: fov.angle_down,
    }
}

pub(super) fn fovf(fov: &Fov) -> xr::Fovf {
    xr::Fovf {
        angle_left: fov.left,
        angle_right: fov.right,
        angle_up: fov.up,
        angle_down: fov.down,
    }
}

pub(super) fn state(state: xr::SessionState) -> SessionState {
    SessionState::try_from(state.into_raw()).unwrap_or(SessionState::Unknown)
}

/// A located pose, `None` unless position and orientation are both valid.
pub(super) fn located(location: &xr::SpaceLocation) -> Option<Pose> {
    let (position, orientation) = parts(location);
    Some(Pose::new(position?, orientation?))
}

/// Position and orientation of a location, each if it is valid: a runtime that has lost one may know the other.
pub(super) fn parts(location: &xr::SpaceLocation) -> (Option<Vec3>, Option<Quat>) {
    let has = |flag| location.location_flags.contains(flag);
    let (position, orientation) = sound(location.pose);
    (
        position.filter(|_| has(xr::SpaceLocationFlags::POSITION_VALID)),
        orientation.filter(|_| has(xr::SpaceLocationFlags::ORIENTATION_VALID)),
    )
}

/// Position and orientation, each if its numbers are valid.
pub(super) fn sound(raw: xr::Posef) -> (Option<Vec3>, Option<Quat>) {
    let Pose {
        position,
        orientation,
    } = pose(raw);
    (
        position.is_finite().then_some(position),
        Pose::new(Vec3::ZERO, orientation)
            .is_valid()
            .then_some(orientation),
    )
}

/// Why a call on a live session failed.
#[derive(Debug)]
pub(super) enum CallFailure {
    /// The runtime or the session is gone, or going: the headset looks for it again.
    Lost(String),
    /// Another try does not help.
    Fatal(HeadsetError),
}

impl CallFailure {
    /// Returns `instead` where the runtime has refused a call, and warns that the session goes on without `what`. A loss, and a failure of
    /// the device, stay errors.
    pub(super) fn do_without<T>(self, what: &str, instead: T) -> Result<T, Self> {
        match self {
            Self::Fatal(HeadsetError::Refused { call, cause }) => {
                tracing::warn!(
                    call,
                    cause,
                    "the runtime refuses {what}; it goes on without"
                );
                Ok(instead)
            }
            failure => Err(failure),
        }
    }
}

impl From<vitriol_gpu::GpuError> for CallFailure {
    fn from(error: vitriol_gpu::GpuError) -> Self {
        Self::Fatal(HeadsetError::Gpu(error))
    }
}

/// For `map_err`: classifies the error code of `call`.
pub(super) fn failed(call: &'static str) -> impl Fn(xr::sys::Result) -> CallFailure {
    use xr::sys::Result as R;
    move |answer| match answer {
        // The specification names the first three; a runtime that dies in the middle of a call also returns the fourth (Monado's broken
        // pipe).
        R::ERROR_SESSION_LOST
        | R::ERROR_INSTANCE_LOST
        | R::ERROR_RUNTIME_UNAVAILABLE
        | R::ERROR_RUNTIME_FAILURE => CallFailure::Lost(format!("{call}: {answer}")),
        _ => refused(call, answer.to_string()),
    }
}

/// `call` gave nothing that can be used, for that cause.
pub(super) fn refused(call: &'static str, cause: String) -> CallFailure {
    CallFailure::Fatal(HeadsetError::Refused { call, cause })
}
