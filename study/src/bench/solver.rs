//! The time of a frame's solution, of a scene at rest in its flasks.

use vitriol_gpu::Gpu;
use vitriol_run::{Failure, scenes};
use vitriol_sim::scene::{Boundary, Scene};

use super::frame::{asleep, passes};
use super::peer::Peer;
use super::report::{Row, TABLE_2};
use super::rest::at_rest;
use crate::cli::BenchArgs;

/// One scene, in which no liquid sleeps: totals without timestamps around passes, which cost time
/// themselves on a software driver, in turn with peers; then each pass with timestamps.
///
/// # Errors
/// [`Failure::Input`] for a scene that does not exist; otherwise the error of the device or of a peer.
pub fn row(
    timed: &Gpu,
    plain: &Gpu,
    name: &str,
    args: &BenchArgs,
    peers: &[Peer],
) -> Result<Row, Failure> {
    let scene = scenes::load(name)?.with_preset(args.preset);
    let asleep = asleep(plain, &scene, args.frames)?;
    let scene = scene.without_sleep();
    let rest = at_rest(plain, &scene, args.frames, peers)?;
    let (passes, device_total) = passes(timed, &scene, args.frames)?;
    let paper = TABLE_2.iter().find(|(known, _)| *known == name);
    Ok(Row {
        scene: name.to_owned(),
        fluid_particles: rest.particles,
        solid_particles: solid_particles(&scene),
        substeps: scene.solver.substeps,
        iterations: scene.solver.iterations,
        density_error_mean: rest.density_error_mean,
        density_error_p99: rest.density_error_p99,
        total: rest.total,
        asleep,
        device_total,
        cpu: rest.cpu,
        passes,
        paper: paper.map(|(_, row)| *row),
        peers: rest.peers,
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
