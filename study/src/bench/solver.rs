//! What a frame's solution takes, of a scene at rest in its flasks.

use vitriol_experiment::{Blame, Failure};
use vitriol_gpu::Gpu;
use vitriol_sim::scene::{Boundary, Scene};

use super::frame::{QUEUED, passes, queued, settled};
use super::report::{Row, TABLE_2, Timing};
use crate::cli::BenchArgs;

/// One scene: totals without timestamps around passes, which cost time
/// themselves on a software driver, then each pass with them.
///
/// # Errors
/// [`Failure::Input`] for a scene that is not there; what the device says.
pub fn row(timed: &Gpu, plain: &Gpu, name: &str, args: &BenchArgs) -> Result<Row, Failure> {
    let scene = Scene::load(name).input()?.with_preset(args.preset);
    let whole = Whole::run(plain, &scene, args.frames)?;
    let (passes, device_total) = passes(timed, &scene, args.frames)?;
    let paper = TABLE_2.iter().find(|(known, _)| *known == name);
    Ok(Row {
        scene: name.to_owned(),
        fluid_particles: whole.particles,
        solid_particles: solid_particles(&scene),
        substeps: scene.solver.substeps,
        iterations: scene.solver.iterations,
        density_error_mean: whole.density_error.0,
        density_error_p99: whole.density_error.1,
        total: whole.total,
        device_total,
        cpu: whole.cpu,
        passes,
        paper: paper.map(|(_, row)| *row),
    })
}

/// Boundary particles of a scene whose walls are made of them.
fn solid_particles(scene: &Scene) -> u64 {
    match scene.solver.boundary {
        Boundary::Map => 0,
        Boundary::Particles => scene
            .boundary_particles()
            .iter()
            .map(|solids| solids.len() as u64)
            .sum(),
    }
}

/// A frame as a whole.
struct Whole {
    particles: u64,
    density_error: (f64, f64),
    /// A frame's share of [`QUEUED`] frames, from the first one's recording
    /// to the last one's end.
    total: Timing,
    /// Recording and submitting.
    cpu: Timing,
}

impl Whole {
    fn run(gpu: &Gpu, scene: &Scene, frames: u32) -> Result<Self, Failure> {
        let world = settled(gpu, scene)?;
        let (mut total, mut cpu) = (Vec::new(), Vec::new());
        for _ in 0..frames.div_ceil(QUEUED) {
            total.push(queued(gpu, &world, &mut cpu)?);
        }
        let measured = world.measure().other()?;
        Ok(Self {
            particles: u64::from(world.solver().count()),
            density_error: (measured.density_error_mean, measured.density_error_p99),
            total: Timing::of(&total),
            cpu: Timing::of(&cpu),
        })
    }
}
