//! What a frame's solution takes, of a scene at rest in its flasks.

use vitriol_experiment::{Blame, Failure, scenes};
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
    let scene = scenes::load(name)?.with_preset(args.preset);
    let world = settled(plain, &scene)?;
    let (mut total, mut cpu) = (Vec::new(), Vec::new());
    for _ in 0..args.frames.div_ceil(QUEUED) {
        total.push(queued(plain, &world, &mut cpu)?);
    }
    let measured = world.measure().other()?;
    let (passes, device_total) = passes(timed, &scene, args.frames)?;
    let paper = TABLE_2.iter().find(|(known, _)| *known == name);
    Ok(Row {
        scene: name.to_owned(),
        fluid_particles: world.solver().count().into(),
        solid_particles: solid_particles(&scene),
        substeps: scene.solver.substeps,
        iterations: scene.solver.iterations,
        density_error_mean: measured.density_error_mean,
        density_error_p99: measured.density_error_p99,
        total: Timing::of(&total),
        device_total,
        cpu: Timing::of(&cpu),
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
