//! Where a headset's pictures are sharp.

use glam::Vec3;
use serde::Serialize;
use vitriol_render::Foveation;
use vitriol_xr::{Pose, View};

/// What is shaded of the pictures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Foveating {
    /// Every pixel: the rest is faster only where most of the picture is not glass
    #[default]
    Off,
    /// Every pixel within 10° of a lens's axis and of panel and signs; beyond, one of 4, and of
    /// bare room one of 16 beyond 30°
    Fixed,
    /// The same within 15° of where you look, in a headset that tells; else as fixed
    Eye,
}

/// How far what is looked at is taken to be, m: flasks and hands are there. Of what is two metres off the eyes' middle is 2° aside
/// of where each eye looks.
const LOOKED_AT: f32 = 0.6;
/// Half the angle of all pixels about the gaze, degrees: 10°, and for what the gaze goes on by until the picture is seen (an eye
/// that follows something at 60°/s, 50 ms) and for [`LOOKED_AT`].
const ABOUT_GAZE: f32 = 15.0;

impl Foveating {
    /// As the renderer takes it, of eyes that see from there, with the `gaze` between them.
    pub fn foveation(self, views: &[View; 2], gaze: Option<Pose>) -> Option<Foveation> {
        let fixed = Foveation::fixed();
        match (self, gaze) {
            (Self::Off, _) => None,
            (Self::Fixed, _) | (Self::Eye, None) => Some(fixed),
            (Self::Eye, Some(gaze)) => {
                let place = gaze.transform_point(LOOKED_AT * Vec3::NEG_Z);
                Some(Foveation {
                    towards: views.each_ref().map(|view| slopes(view, place)),
                    sharp: ABOUT_GAZE.to_radians(),
                    ..fixed
                })
            }
        }
    }
}

/// Where an eye sees a place, as slopes to the right and up from its line of sight; that line for what is behind it.
fn slopes(view: &View, place: Vec3) -> [f32; 2] {
    let at = view.stage_from_eye.inverse().transform_point(place);
    let ahead = -at.z;
    match ahead > 1e-3 * LOOKED_AT {
        true => [at.x / ahead, at.y / ahead],
        false => [0.0; 2],
    }
}
