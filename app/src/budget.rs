//! The most accurate setting of the solver that holds a time.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Instant;

use vitriol_gpu::Gpu;
use vitriol_shaders::Library;
use vitriol_sim::bodies::Hand;
use vitriol_sim::scene::{Preset, Scene};
use vitriol_sim::world::{StepInput, World};

use crate::failure::{Blame, Failure};
use crate::rank::Ranks;

/// Substeps and iterations on the front that `vitriol trade` found at real size,
/// 13,894 particles, 90 Hz and a start carried at 0.005 (docs/accuracy.md), the most accurate first: 99th
/// percentile of the density error while pouring 0.024, 0.035, 0.049, 0.081, 0.12, 0.15, 0.24, 0.36
/// and 3.2 %.
const FRONT: [[u32; 2]; 9] = [
    [16, 8],
    [16, 6],
    [12, 8],
    [10, 8],
    [10, 6],
    [12, 4],
    [10, 4],
    [8, 4],
    [8, 2],
];
/// What `balanced` has there: other scenes have as many times what theirs has.
const BALANCED: [u32; 2] = [10, 3];

/// Frames of a calibration: the first ones are not counted.
const FRAMES: [u32; 2] = [4, 40];
/// Frames after which a setting that is over in all of them is over.
const SURE: usize = 4;

/// Substeps and iterations for `scene` (as its preset `balanced` left it) by which the 99th
/// percentile of a frame's time is at most `budget` ms on this device, and that
/// time. What was measured is kept by device, driver and scene.
///
/// # Errors
/// [`Failure::Input`] where even the cheapest takes longer; what the device says.
pub fn within(gpu: &Gpu, scene: &Scene, budget: f64) -> Result<([u32; 2], f64), Failure> {
    let cache = Cache::open();
    let mut known = cache.read();
    let mut least = f64::INFINITY;
    for point in points(scene) {
        let scene = with(scene, point);
        if scene.problem_of_substep().is_some() {
            continue;
        }
        let key = key(gpu, &scene);
        let time = match known.get(&key) {
            Some(&time) => time,
            None => {
                let (time, whole) = calibrate(gpu, &scene, budget)?;
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

/// `scene` with these substeps and iterations.
pub fn with(scene: &Scene, [substeps, iterations]: [u32; 2]) -> Scene {
    let mut scene = scene.clone();
    scene.solver.substeps = substeps;
    scene.solver.iterations = iterations;
    scene
}

/// The front for a scene: scaled to its own `balanced`.
fn points(scene: &Scene) -> Vec<[u32; 2]> {
    let solver = scene.with_preset(Preset::Balanced).solver;
    let own = [solver.substeps, solver.iterations];
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
    let input = StepInput {
        hands: [Hand::ABSENT; 2],
    };
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
        let folder = std::env::var_os("XDG_CACHE_HOME")
            .map(PathBuf::from)
            .or_else(|| std::env::var_os("HOME").map(|home| PathBuf::from(home).join(".cache")));
        Self(folder.map(|folder| folder.join("vitriol").join("budget.json")))
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
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn the_front_is_scaled_to_what_a_scene_has() {
        let real = Scene::load("two-flasks").unwrap();
        assert_eq!(points(&real), FRONT);
        // The paper's 3 × 2.
        let paper = Scene::load("single-dilution").unwrap();
        let points = points(&paper);
        assert_eq!(points[0], [5, 5]);
        // Of ten substeps three are left, of four iterations three; of eight two.
        assert!(points.contains(&[3, 3]) && points.iter().all(|p| p[0] >= 2));
        // What does not stand up is never chosen.
        assert!(with(&paper, [1, 2]).problem_of_substep().is_some());
    }
}
