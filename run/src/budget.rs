//! The most accurate setting of the solver that holds a time.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Instant;

use crate::{Blame, Failure, Ranks};
use vitriol_gpu::Gpu;
use vitriol_shaders::Library;
use vitriol_sim::bodies::Hand;
use vitriol_sim::scene::{Preset, Scene};
use vitriol_sim::world::{StepInput, World};

/// Substeps and iterations on the front that `vitriol trade` found at real size,
/// 13,894 particles, 90 Hz and a start carried at 0.005 (docs/measurements/accuracy.md, 2026-11-22), the most accurate first: 99th
/// percentile of the density error 0.037, 0.049, 0.081, 0.12, 0.24, 0.45, 1.8 and, as the end for devices that
/// can do no more, 3.2 %.
const FRONT: [[u32; 2]; 8] = [
    [16, 6],
    [12, 8],
    [10, 8],
    [10, 6],
    [10, 4],
    [10, 3],
    [10, 2],
    [8, 2],
];
/// What `balanced` has there: other scenes have as many times what theirs has.
const BALANCED: [u32; 2] = [10, 3];

/// Frames of a calibration: the first ones are not counted.
const FRAMES: [u32; 2] = [4, 40];
/// Frames after which a setting that is over in all of them is over.
const SURE: usize = 4;

/// Substeps and iterations for `scene` (as its preset `balanced` left it) by which the 99th
/// percentile of a frame's time is at most `budget` ms, and that time: what `calibrate` returns, with whether that is
/// the whole time, which is kept under `key` (device, driver and scene).
///
/// # Errors
/// [`Failure::Input`] where even the cheapest takes longer; an error of the device.
fn pick(
    cache: &Cache,
    scene: &Scene,
    budget: f64,
    key: impl Fn(&Scene) -> String,
    mut calibrate: impl FnMut(&Scene) -> Result<(f64, bool), Failure>,
) -> Result<([u32; 2], f64), Failure> {
    let mut known = cache.read();
    let mut least = f64::INFINITY;
    for point in points(balanced(scene)) {
        if !allows(scene, point) {
            continue;
        }
        let scene = scene.with_effort(point);
        if scene.problem_of_substep().is_some() {
            continue;
        }
        let key = key(&scene);
        let time = match known.get(&key) {
            Some(&time) => time,
            None => {
                let (time, whole) = calibrate(&scene)?;
                if whole {
                    known.insert(key, time);
                    cache.write(&known);
                }
                time
            }
        };
        tracing::info!("{} × {}: {time:.3} ms", point[0], point[1]);
        if time <= budget {
            return Ok((point, time));
        }
        least = least.min(time);
    }
    Err(format!(
        "--budget-ms {budget}: the cheapest setting of {:?} that stands up takes {least:.2} ms \
         here; allow more, or take a scene with fewer particles",
        scene.name
    ))
    .input()
}

/// Substeps and iterations as they were asked for, by name or by a budget (ms), for `scene` (as its preset
/// left it; for a budget that is `balanced`); `None` where neither was.
///
/// # Errors
/// [`Failure::Input`] for what the liquid does not stand up under; an error of the device.
pub fn chosen(
    solver: Option<[u32; 2]>,
    budget: Option<f64>,
    scene: &Scene,
    gpu: impl FnOnce() -> Result<Gpu, Failure>,
) -> Result<Option<[u32; 2]>, Failure> {
    let chosen = match (solver, budget) {
        (None, None) => return Ok(None),
        (Some(solver), _) => solver,
        (None, Some(budget)) => {
            let gpu = gpu()?;
            let key = |scene: &Scene| key(&gpu, scene);
            let calibrate = |scene: &Scene| calibrate(&gpu, scene, budget);
            let (solver, time) = pick(&Cache::open(), scene, budget, key, calibrate)?;
            tracing::warn!(
                "--budget-ms {budget}: {} × {}, of which a frame takes {time:.2} ms here",
                solver[0],
                solver[1]
            );
            solver
        }
    };
    match scene.with_effort(chosen).problem_of_solver() {
        Some(problem) => Err(format!("--solver: {problem}")).input(),
        None => Ok(Some(chosen)),
    }
}

/// Substeps and iterations that `scene` has as `balanced`, if no other preset was applied to it.
pub fn balanced(scene: &Scene) -> [u32; 2] {
    let solver = scene.with_preset(Preset::Balanced).solver;
    [solver.substeps, solver.iterations]
}

/// What substeps and iterations cost, in iterations. Beside these a substep has the neighbour search,
/// what is carried on, viscosity and dilution: on an H200 as much as five to eight iterations, on a
/// software driver as three.
pub fn cost([substeps, iterations]: [u32; 2]) -> f64 {
    f64::from(substeps) * (5.0 + f64::from(iterations))
}

/// From what `scene` is solved with down the front, the dearest first; `balanced` is what it has there. Only
/// what its liquid stands up under; and where boiling's power is the paper's as
/// printed, which follows the number of substeps, only other iterations.
pub fn ladder(scene: &Scene, balanced: [u32; 2]) -> Vec<[u32; 2]> {
    let own = [scene.solver.substeps, scene.solver.iterations];
    let mut rungs = vec![own];
    for point in points(balanced) {
        let below = rungs.last().is_none_or(|last| cost(point) < cost(*last));
        if below && allows(scene, point) && scene.with_effort(point).problem_of_solver().is_none() {
            rungs.push(point);
        }
    }
    rungs
}

/// Whether a scene boils by these as it does by its own: the paper's power as printed follows the number of
/// substeps.
fn allows(scene: &Scene, [substeps, _]: [u32; 2]) -> bool {
    let paper = scene.paper.as_ref();
    let literal = paper.is_some_and(|paper| paper.literal_boiling == Some(true));
    !literal || substeps == scene.solver.substeps
}

/// The front for a scene, scaled to what it has as `balanced`.
fn points(own: [u32; 2]) -> Vec<[u32; 2]> {
    let mut all: Vec<[u32; 2]> = Vec::new();
    for point in FRONT {
        let scaled = [0, 1].map(|i| {
            let times = f64::from(point[i]) / f64::from(BALANCED[i]);
            (times * f64::from(own[i])).round().max(1.0) as u32
        });
        if !all.contains(&scaled) {
            all.push(scaled);
        }
    }
    all
}

/// The longest of a few frames' times, ms, while the liquid settles: its lists are
/// rebuilt then as while it is moved. Of so few it stands for their 99th percentile. Where the first frames all take longer than
/// `budget`, the least of them and `false`: it is over already.
fn calibrate(gpu: &Gpu, scene: &Scene, budget: f64) -> Result<(f64, bool), Failure> {
    let mut world = World::new(gpu, &Library::embedded(), scene, 0).input()?;
    let input = StepInput::of_hands([Hand::ABSENT; 2]);
    let [warm, counted] = FRAMES;
    let mut times = Vec::new();
    for frame in 0..warm + counted {
        let begin = Instant::now();
        world.step(&input).other()?;
        if let Some(ticket) = world.last_step() {
            ticket.wait().other()?;
        }
        if frame >= warm {
            times.push(begin.elapsed().as_secs_f64() * 1e3);
            let least = times.iter().copied().fold(f64::INFINITY, f64::min);
            if times.len() == SURE && least > budget {
                return Ok((least, false));
            }
        }
    }
    Ok((Ranks::of(&times).at(1.0).unwrap_or(f64::INFINITY), true))
}

fn key(gpu: &Gpu, scene: &Scene) -> String {
    let info = gpu.info();
    let count: usize = scene.liquids.iter().map(|l| scene.particle_count(l)).sum();
    let models: Vec<String> = scene.model.iter().map(|feature| feature.name()).collect();
    format!(
        "{} | {} | {} | {} | {count} particles | {} s, h/d {} | {:?}",
        env!("CARGO_PKG_VERSION"),
        info.name,
        info.driver,
        models.join("+"),
        scene.scale.frame_time,
        scene.scale.support() / scene.scale.spacing,
        scene.solver
    )
}

/// The file in which times are kept; without a home none are.
struct Cache(Option<PathBuf>);

impl Cache {
    fn open() -> Self {
        Self(dirs::cache_dir().map(|folder| folder.join("vitriol").join("budget.json")))
    }

    /// What is kept; a file that cannot be read is as good as none.
    fn read(&self) -> BTreeMap<String, f64> {
        let bytes = self.0.as_ref().and_then(|path| std::fs::read(path).ok());
        bytes
            .and_then(|bytes| serde_json::from_slice(&bytes).ok())
            .unwrap_or_default()
    }

    /// Keeps them where it can: the next calibration only takes longer without.
    fn write(&self, known: &BTreeMap<String, f64>) {
        let Some(path) = &self.0 else { return };
        let made = path.parent().map(std::fs::create_dir_all);
        let bytes = serde_json::to_vec_pretty(known);
        if let (Some(Ok(())), Ok(bytes)) = (made, bytes)
            && let Err(error) = std::fs::write(path, bytes)
        {
            tracing::warn!("{}: not kept: {error}", path.display());
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    #[test]
    fn the_front_is_scaled_to_what_a_scene_has() {
        let real = Scene::builtin("two-flasks").unwrap();
        assert_eq!(points(balanced(&real)), FRONT);
        // The paper's 3 × 2.
        let paper = Scene::builtin("single-dilution").unwrap();
        let points = points(balanced(&paper));
        assert_eq!(points[0], [5, 4]);
        // Of ten substeps three are left, of four iterations three; of eight two.
        assert!(points.contains(&[3, 3]) && points.iter().all(|p| p[0] >= 2));
        // What does not stand up is never chosen.
        assert!(paper.with_effort([1, 2]).problem_of_substep().is_some());
    }

    /// Down the front from wherever a session begins, ever cheaper, and nothing that falls over.
    #[test]
    fn a_ladder_goes_down_to_what_stands_up() {
        let real = Scene::builtin("two-flasks").unwrap();
        assert_eq!(ladder(&real, [10, 3]), [[10, 3], [10, 2], [8, 2]]);
        let fine = real.with_effort([16, 6]);
        assert_eq!(ladder(&fine, [10, 3]), FRONT);
        let fast = real.with_preset(Preset::Fast);
        assert_eq!(ladder(&fast, [10, 3]), [[8, 2]]);
        // A smaller spacing makes the substep's limit shorter: 8 are too few.
        let mut small = fine;
        small.scale.spacing *= 0.6;
        let rungs = ladder(&small, [10, 3]);
        assert!(small.with_effort([8, 2]).problem_of_substep().is_some());
        assert_eq!(rungs.last(), Some(&[10, 2]));
        // Where substeps are the boiling's power, they stay.
        let mut soup = Scene::builtin("tomato-soup").unwrap();
        soup.paper.as_mut().unwrap().literal_boiling = Some(true);
        let soup = soup.with_effort([3, 5]);
        let rungs = ladder(&soup, [3, 2]);
        assert!(
            rungs.len() > 1 && rungs.iter().all(|rung| rung[0] == 3),
            "{rungs:?}"
        );
    }

    /// A device on which an iteration takes 0.1 ms.
    fn times(scene: &Scene) -> f64 {
        0.1 * f64::from(scene.solver.substeps * scene.solver.iterations)
    }

    /// What `--budget-ms` finds, and how often it measured.
    fn found(cache: &Cache, scene: &Scene, budget: f64) -> (Option<([u32; 2], f64)>, u32) {
        let mut measured = 0;
        let key = |scene: &Scene| format!("{:?}", scene.solver);
        let picked = pick(cache, scene, budget, key, |scene| {
            measured += 1;
            let time = times(scene);
            // Cut short where it is far over.
            Ok((time, time < 2.0 * budget))
        });
        (picked.ok(), measured)
    }

    #[test]
    fn a_budget_is_held_by_the_most_accurate_that_holds_it() {
        let scene = Scene::builtin("two-flasks").unwrap();
        let none = Cache(None);
        for budget in [20.0, 9.7, 5.0, 4.9, 4.1, 3.3, 1.7] {
            let best = FRONT
                .into_iter()
                .find(|point| times(&scene.with_effort(*point)) <= budget)
                .unwrap();
            let (picked, measured) = found(&none, &scene, budget);
            let place = FRONT.iter().position(|point| *point == best).unwrap();
            let time = times(&scene.with_effort(best));
            assert_eq!((picked, measured), (Some((best, time)), place as u32 + 1));
        }
        // 1.6 ms are the least.
        assert_eq!(found(&none, &scene, 1.5).0, None);
    }

    /// Whole times are kept and taken again, those of another program or scene are not, and a file that is no
    /// cache is none.
    #[test]
    fn what_was_measured_is_kept() {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache(Some(folder.path().join("vitriol").join("budget.json")));
        let scene = Scene::builtin("two-flasks").unwrap();
        assert_eq!(found(&cache, &scene, 20.0).1, 1);
        assert_eq!(found(&cache, &scene, 20.0).1, 0);
        // From 9.6 ms down to 4 ms, of which the first is known.
        let (picked, measured) = found(&cache, &scene, 4.5);
        let time = times(&scene.with_effort([10, 4]));
        assert_eq!((picked, measured), (Some(([10, 4], time)), 4));
        // What was cut short, the other that takes 9.6 ms, has no time to be kept.
        assert_eq!(found(&cache, &scene, 4.5), (picked, 1));
        let mut other = scene.clone();
        other.solver.omega *= 0.9;
        assert_eq!(found(&cache, &other, 20.0).1, 1);
        let file = cache.0.clone().unwrap();
        std::fs::write(&file, b"{ broken").unwrap();
        assert_eq!(found(&cache, &scene, 20.0).1, 1);
        assert_eq!(found(&cache, &scene, 20.0).1, 0);
    }
}
