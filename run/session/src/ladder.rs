//! The rungs that a governor goes down and up: for the solver substeps and iterations along the front of speed and
//! accuracy (`budget`), for the picture the pixels away from the lenses' axes, the surface's filter and then the number of
//! pixels. The number of particles never changes.

use serde::Serialize;
use vitriol_sim::scene::{PictureFilter, Scene};

use super::governor::Level;
use vitriol_run::budget;

/// Each side of a picture over the display's.
const RESOLUTIONS: [f64; 4] = [1.0, 0.85, 0.7, 0.6];

/// Share of a picture's time that does not depend on its pixels: ellipsoids, tiles, dispatches and barriers
/// (docs/measurements/rendering.md, half the pixels).
const FIXED: f64 = 0.3;

/// Time of curvature flow's forty passes over that of the rest of a picture (docs/measurements/rendering.md).
const CURVATURE_FLOW: f64 = 0.3;

/// Share of a picture's time that foveation about the lenses' axes saves: it takes 1.007 of 1.154 ms on an H100
/// (docs/measurements/rendering.md, what the passes take).
const FOVEATION: f64 = 0.13;

/// What frames are solved and drawn with.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Setting {
    /// Substeps a step and iterations a substep.
    pub solver: [u32; 2],
    /// Filter of the liquid's surface.
    pub filter: PictureFilter,
    /// Each side of the picture over the display's.
    pub resolution: f64,
    /// Whether fewer pixels than were asked for are shaded away from the lenses' axes.
    pub foveated: bool,
}

/// A rung of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Drawn {
    filter: PictureFilter,
    resolution: f64,
    foveated: bool,
}

/// A scene's rungs. The first ones are what the session was asked for.
#[derive(Clone, Debug)]
pub struct Ladder {
    solver: Vec<[u32; 2]>,
    picture: Vec<Drawn>,
}

impl Ladder {
    /// Of `scene`, which has `balanced` substeps and iterations under that preset; of a picture that may be `foveated`
    /// ([`gives_way`](super::foveating::gives_way)) or not.
    pub fn of(scene: &Scene, balanced: [u32; 2], foveated: bool) -> Self {
        let asked = Drawn {
            filter: scene.picture.filter,
            resolution: 1.0,
            foveated: false,
        };
        // First what is seen least: beyond 10° of a lens's axis an eye that looks along it tells blocks of two by two pixels from
        // pixels hardly. All that comes after is seen wherever she looks.
        let first = Drawn { foveated, ..asked };
        // The narrow-range filter takes a seventh of its time, and looks better than fewer pixels do.
        let plain = RESOLUTIONS.map(|resolution| Drawn {
            filter: PictureFilter::NarrowRange,
            resolution,
            foveated,
        });
        let mut picture: Vec<Drawn> = [asked, first].into_iter().chain(plain).collect();
        picture.dedup();
        Self {
            solver: budget::ladder(scene, balanced),
            picture,
        }
    }

    /// Costs of the rungs of solver and picture, each in units of its own.
    pub fn costs(&self) -> [Vec<f64>; 2] {
        let picture = |drawn: &Drawn| {
            let filtered = match drawn.filter {
                PictureFilter::NarrowRange => 0.0,
                PictureFilter::CurvatureFlow => CURVATURE_FLOW,
            };
            let saved = if drawn.foveated { FOVEATION } else { 0.0 };
            FIXED + (1.0 - FIXED + filtered - saved) * drawn.resolution * drawn.resolution
        };
        [
            self.solver.iter().map(|&rung| budget::cost(rung)).collect(),
            self.picture.iter().map(picture).collect(),
        ]
    }

    /// The setting at a level. Rungs past the last one are the last one.
    pub fn setting(&self, [solver, picture]: Level) -> Setting {
        let drawn = self.picture[picture.min(self.picture.len() - 1)];
        Setting {
            solver: self.solver[solver.min(self.solver.len() - 1)],
            filter: drawn.filter,
            resolution: drawn.resolution,
            foveated: drawn.foveated,
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
            for foveated in [false, true] {
                scene.picture.filter = filter;
                let ladder = Ladder::of(&scene, [10, 3], foveated);
                for costs in ladder.costs() {
                    assert!(
                        costs.is_sorted_by(|finer, coarser| finer > coarser),
                        "{costs:?}"
                    );
                }
                let top = ladder.setting([0, 0]);
                assert_eq!((top.solver, top.resolution), ([10, 3], 1.0));
                assert_eq!((top.filter, top.foveated), (filter, false));
                let end = ladder.setting([99, 99]);
                assert_eq!((end.solver, end.resolution), ([8, 2], 0.6));
                assert_eq!(end.filter, PictureFilter::NarrowRange);
                assert_eq!(end.foveated, foveated);
            }
        }
    }

    /// Pixels aside of the lenses' axes go first, then the filter, and only then pixels that are looked at. What has gone stays
    /// gone further down.
    #[test]
    fn what_is_seen_least_goes_first() {
        let mut scene = Scene::builtin("two-flasks").unwrap();
        scene.picture.filter = PictureFilter::CurvatureFlow;
        let rungs = |foveated: bool| {
            let ladder = Ladder::of(&scene, [10, 3], foveated);
            let rungs = 0..ladder.costs()[1].len();
            let rungs = rungs.map(|rung| ladder.setting([0, rung]));
            let told = rungs.map(|it| (it.foveated, it.filter, it.resolution));
            told.collect::<Vec<_>>()
        };
        let (flow, plain) = (PictureFilter::CurvatureFlow, PictureFilter::NarrowRange);
        let without = [
            (false, flow, 1.0),
            (false, plain, 1.0),
            (false, plain, 0.85),
            (false, plain, 0.7),
            (false, plain, 0.6),
        ];
        assert_eq!(rungs(false), without);
        let with = [
            (false, flow, 1.0),
            (true, flow, 1.0),
            (true, plain, 1.0),
            (true, plain, 0.85),
            (true, plain, 0.7),
            (true, plain, 0.6),
        ];
        assert_eq!(rungs(true), with);
        // The rung's cost is the ratio of the two times that are stated where they were measured; 0.5 % is its rounding.
        let page = include_str!("../../../docs/measurements/rendering.md");
        let row = |line: &&str| line.starts_with("| picture, all passes, timed |");
        let cells = page.lines().find(row).unwrap().split('|');
        let times = cells.filter_map(|it| it.trim_matches([' ', '*']).parse::<f64>().ok());
        let times: Vec<f64> = times.collect();
        scene.picture.filter = plain;
        let [_, costs] = Ladder::of(&scene, [10, 3], true).costs();
        assert!((costs[1] - times[1] / times[0]).abs() < 0.005, "{costs:?}");
    }
}
