//! OpenXR's poses, fields of view and states as ours, and its refusals.

use glam::{Quat, Vec3};
use openxr as xr;

use crate::{Fov, HeadsetError, Pose, SessionState};

/// A pose of which the flags say that position and orientation are valid.
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
    let valid = xr::SpaceLocationFlags::POSITION_VALID | xr::SpaceLocationFlags::ORIENTATION_VALID;
    let pose = pose(location.pose);
    (location.location_flags.contains(valid) && pose.is_valid()).then_some(pose)
}

/// Why a call on a live session failed.
#[derive(Debug)]
pub(super) enum CallFailure {
    /// Runtime or session are gone, or going: they are to be sought again.
    Lost(String),
    /// Asking again does not help.
    Fatal(HeadsetError),
}

impl From<vitriol_gpu::GpuError> for CallFailure {
    fn from(error: vitriol_gpu::GpuError) -> Self {
        Self::Fatal(HeadsetError::Gpu(error))
    }
}

/// For `map_err`: sorts what `call` answered.
pub(super) fn failed(call: &'static str) -> impl Fn(xr::sys::Result) -> CallFailure {
    use xr::sys::Result as R;
    move |answer| match answer {
        // The specification names the first three; a runtime that dies in the middle of a call
        // is also heard as the fourth (Monado's broken pipe).
        R::ERROR_SESSION_LOST
        | R::ERROR_INSTANCE_LOST
        | R::ERROR_RUNTIME_UNAVAILABLE
        | R::ERROR_RUNTIME_FAILURE => CallFailure::Lost(format!("{call}: {answer}")),
        _ => CallFailure::Fatal(HeadsetError::Refused {
            call,
            cause: answer.to_string(),
        }),
    }
}
