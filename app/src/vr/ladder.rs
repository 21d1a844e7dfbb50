//! The rungs that a governor goes down and up: for the solver substeps and iterations along the front of speed and
//! accuracy (`budget`), for the picture the surface's filter and then the number of pixels. The number of particles
//! never changes.

use serde::Serialize;
use vitriol_sim::scene::{PictureFilter, Scene};

use super::governor::Level;
use crate::budget;

/// Each side of a picture over the display's.
const RESOLUTIONS: [f64; 4] = [1.0, 0.85, 0.7, 0.6];

/// Share of a picture's time that does not depend on its pixels: ellipsoids, tiles, dispatches and barriers
/// (docs/measurements/rendering.md, half the pixels).
const FIXED: f64 = 0.3;

/// Time of curvature flow's forty passes over that of the rest of a picture (docs/measurements/rendering.md).
const CURVATURE_FLOW: f64 = 0.3;

/// What frames are solved and drawn with.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Setting {
    /// Substeps a step and iterations a substep.
    pub solver: [u32; 2],
    /// Filter of the liquid's surface.
    pub filter: PictureFilter,
    /// Each side of the picture over the display's.
    pub resolution: f64,
}

/// A scene's rungs. The first ones are what the session was asked for.
#[derive(Clone, Debug)]
pub struct Ladder {
    solver: Vec<[u32; 2]>,
    picture: Vec<(PictureFilter, f64)>,
}

impl Ladder {
    /// Of `scene`, which has `balanced` substeps and iterations under that preset.
    pub fn of(scene: &Scene, balanced: [u32; 2]) -> Self {
        let own = scene.picture.filter;
        // The narrow-range filter takes a seventh of its time, and looks better than fewer pixels do.
        let first = (own == PictureFilter::CurvatureFlow).then_some((own, 1.0));
        let rest = RESOLUTIONS.map(|resolution| (PictureFilter::NarrowRange, resolution));
        Self {
            solver: budget::ladder(scene, balanced),
            picture: first.into_iter().chain(rest).collect(),
        }
    }

    /// Costs of the rungs of solver and picture, each in units of its own.
    pub fn costs(&self) -> [Vec<f64>; 2] {
        let picture = |&(filter, resolution): &(PictureFilter, f64)| {
            let filtered = match filter {
                PictureFilter::NarrowRange => 0.0,
                PictureFilter::CurvatureFlow => CURVATURE_FLOW,
            };
            FIXED + (1.0 - FIXED + filtered) * resolution * resolution
        };
        [
            self.solver.iter().map(|&rung| budget::cost(rung)).collect(),
            self.picture.iter().map(picture).collect(),
        ]
    }

    /// The setting at a level. Rungs past the last one are the last one.
    pub fn setting(&self, [solver, picture]: Level) -> Setting {
        let (filter, resolution) = self.picture[picture.min(self.picture.len() - 1)];
        Setting {
            solver: self.solver[solver.min(self.solver.len() - 1)],
            filter,
            resolution,
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn rungs_fall_and_end_where_they_end() {
        let mut scene = Scene::builtin("two-flasks").unwrap();
        for filter in [PictureFilter::NarrowRange, PictureFilter::CurvatureFlow] {
            scene.picture.filter = filter;
            let ladder = Ladder::of(&scene, [10, 3]);
            for costs in ladder.costs() {
                assert!(
                    costs.is_sorted_by(|finer, coarser| finer > coarser),
                    "{costs:?}"
                );
            }
            let top = ladder.setting([0, 0]);
            assert_eq!((top.solver, top.resolution), ([10, 3], 1.0));
            assert_eq!(top.filter, filter);
            let end = ladder.setting([99, 99]);
            assert_eq!((end.solver, end.resolution), ([8, 2], 0.6));
            assert_eq!(end.filter, PictureFilter::NarrowRange);
        }
        // The filter goes before any pixel.
        let second = Ladder::of(&scene, [10, 3]).setting([0, 1]);
        assert_eq!(second.resolution, 1.0);
        assert_eq!(second.filter, PictureFilter::NarrowRange);
    }
}
