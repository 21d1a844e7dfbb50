//! Both eyes at a frame's display time, as far as the runtime knows them.

use glam::{Quat, Vec3};
use openxr as xr;

use super::convert::{CallFailure, failed, fov, sound};
use super::live::{Begun, Live};
use super::system::STEREO;
use crate::{Fov, Pose, View};

/// The eyes as they were located last.
pub(super) struct Eyes {
    pub views: [View; 2],
    /// Where each is in the head, seen from the eye itself, m: by it an eye follows a head of which only the orientation is
    /// known.
    offsets: [Vec3; 2],
}

impl Default for Eyes {
    fn default() -> Self {
        let eye = View {
            stage_from_eye: Pose::IDENTITY,
            fov: Fov::default(),
        };
        Self {
            views: [eye; 2],
            offsets: [Vec3::ZERO; 2],
        }
    }
}

impl Eyes {
    /// Locates them. Fields of view are known at all times; of a pose each part stays that is not.
    pub(super) fn locate(
        &mut self,
        live: &Live,
        begun: Begun,
        head: &Pose,
    ) -> Result<(), CallFailure> {
        let (flags, found) = live
            .session
            .locate_views(STEREO, begun.time, &live.stage.space)
            .map_err(failed("xrLocateViews"))?;
        for (eye, found) in found.into_iter().take(2).enumerate() {
            let (position, orientation) = sound(found.pose);
            let position = position.filter(|_| flags.contains(xr::ViewStateFlags::POSITION_VALID));
            let orientation =
                orientation.filter(|_| flags.contains(xr::ViewStateFlags::ORIENTATION_VALID));
            self.take(eye, position, orientation, head);
            let fov = fov(found.fov);
            if fov.left < fov.right && fov.down < fov.up {
                self.views[eye].fov = fov;
            }
        }
        Ok(())
    }

    fn take(&mut self, eye: usize, position: Option<Vec3>, orientation: Option<Quat>, head: &Pose) {
        let at = &mut self.views[eye].stage_from_eye;
        at.orientation = orientation.unwrap_or(at.orientation);
        match (position, orientation) {
            (Some(position), Some(orientation)) => {
                at.position = position;
                self.offsets[eye] = orientation.inverse() * (position - head.position);
            }
            (None, Some(orientation)) => {
                at.position = head.position + orientation * self.offsets[eye];
            }
            _ => {}
        }
    }
}
