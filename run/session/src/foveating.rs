//! Where a headset's pictures are sharp.

use glam::Vec3;
use serde::Serialize;
use vitriol_render::Foveation;
use vitriol_sim::scene::{Feature, Scene};
use vitriol_xr::{Pose, View};

/// What is shaded of the pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Foveating {
    /// Every pixel, whatever frames take
    Off,
    /// Every pixel within 10° of a lens's axis and of panel and signs; beyond, one of 4, and of
    /// bare room one of 16 beyond 30°
    Fixed,
    /// The runtime's own, where it has quad views; else as fixed, but within 15° of where you look, in a headset that tells
    Eye,
}

/// How far what is looked at is taken to be, m: flasks and hands are there. Of what is two metres off the eyes' middle is 2° aside
/// of where each eye looks.
const LOOKED_AT: f32 = 0.6;
/// Half the angle of all pixels about the gaze, degrees: 10°, and for what the gaze goes on by until the picture is seen (an eye
/// that follows something at 60°/s, 50 ms) and for [`LOOKED_AT`].
const ABOUT_GAZE: f32 = 15.0;

/// Whether the governor may take pixels away from the lenses' axes to keep pace: where the user says nothing of it, in scenes
/// whose liquid has no bubbles. Over boiling acid nothing was saved (1.51 and 1.54 ms with, 1.46 and 1.48 without, of an H200):
/// steam and bubbles are where the eye looks, and spreading blocks takes time. There a rung would only keep others waiting.
pub fn gives_way(asked: Option<Foveating>, scene: &Scene) -> bool {
    asked.is_none() && !scene.models(Feature::Bubbles)
}

/// Whether any frame of a scene may be foveated, which takes pipelines of its own.
pub fn may_foveate(asked: Option<Foveating>, scene: &Scene) -> bool {
    match asked {
        Some(asked) => asked != Foveating::Off,
        None => gives_way(asked, scene),
    }
}

/// What is done in a frame, of what was asked for and what the governor `gave_way`.
pub fn now(asked: Option<Foveating>, gave_way: bool) -> Foveating {
    asked.unwrap_or(match gave_way {
        true => Foveating::Fixed,
        false => Foveating::Off,
    })
}

impl Foveating {
    /// The name as it is given and recorded.
    pub fn name(self) -> &'static str {
        match self {
            Self::Off => "off",
            Self::Fixed => "fixed",
            Self::Eye => "eye",
        }
    }

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

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use clap::ValueEnum;

    /// What the user says holds: where she says nothing the governor may, in scenes that gain by it.
    #[test]
    fn only_what_nobody_asked_for_gives_way() {
        let scene = |name| Scene::builtin(name).unwrap();
        for (name, gains) in [
            ("two-flasks", true),
            ("triple-dilution", true),
            ("acid-into-water", false),
            ("water-into-acid", false),
        ] {
            let scene = scene(name);
            assert_eq!(gives_way(None, &scene), gains, "{name}");
            assert_eq!(may_foveate(None, &scene), gains, "{name}");
            for (said, foveates) in [("off", false), ("fixed", true), ("eye", true)] {
                let asked = Foveating::from_str(said, false).ok();
                assert_eq!(asked.unwrap().name(), said);
                assert!(!gives_way(asked, &scene), "{name}, {said}");
                assert_eq!(may_foveate(asked, &scene), foveates, "{name}, {said}");
                assert_eq!(Some(now(asked, true)), asked);
            }
        }
        assert_eq!(now(None, false), Foveating::Off);
        assert_eq!(now(None, true), Foveating::Fixed);
    }
}
