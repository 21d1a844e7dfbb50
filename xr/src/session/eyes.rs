//! Both eyes at a frame's display time, as far as the runtime locates them.

use glam::{Quat, Vec3};
use openxr as xr;

use super::convert::{CallFailure, fov, sound};
use super::live::{Begun, Live};
use crate::{Fov, Pose, View};

/// The eyes as they were located last.
pub(super) struct Eyes {
    /// The left and the right eye, then the inset's in each, where the session has one.
    all: [View; 4],
    /// Position of each in the head, in the eye's own axes, m: by it an eye follows a head of which only the orientation is known.
    offsets: [Vec3; 4],
}

impl Default for Eyes {
    fn default() -> Self {
        let eye = View {
            stage_from_eye: Pose::IDENTITY,
            fov: Fov::default(),
        };
        Self {
            all: [eye; 4],
            offsets: [Vec3::ZERO; 4],
        }
    }
}

impl Eyes {
    /// The left and the right eye.
    pub(super) fn views(&self) -> [View; 2] {
        [self.all[0], self.all[1]]
    }

    /// The inset's views. A view that has not been located yet is all of its eye's picture: that is right, if coarse.
    pub(super) fn inset(&self) -> [View; 2] {
        [0, 1].map(|eye| {
            let inset = self.all[2 + eye];
            match inset.fov == Fov::default() {
                true => self.all[eye],
                false => inset,
            }
        })
    }

    /// Locates them. Fields of view are always known; a part of a pose that is not known keeps its last value.
    pub(super) fn locate(
        &mut self,
        live: &Live,
        begun: Begun,
        head: &Pose,
    ) -> Result<(), CallFailure> {
        let (flags, found) = live.views.locate(
            &live.session,
            &live.stage.space,
            (live.gaze.as_ref(), &live.head),
            begun.time,
        )?;
        for (eye, found) in found.into_iter().take(self.all.len()).enumerate() {
            let (position, orientation) = sound(found.pose);
            let position = position.filter(|_| flags.contains(xr::ViewStateFlags::POSITION_VALID));
            let orientation =
                orientation.filter(|_| flags.contains(xr::ViewStateFlags::ORIENTATION_VALID));
            self.take(eye, position, orientation, head);
            let fov = fov(found.fov);
            if fov.left < fov.right && fov.down < fov.up {
                self.all[eye].fov = fov;
            }
        }
        Ok(())
    }

    fn take(&mut self, eye: usize, position: Option<Vec3>, orientation: Option<Quat>, head: &Pose) {
        let at = &mut self.all[eye].stage_from_eye;
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
