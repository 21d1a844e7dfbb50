//! `vitriol bench --scaling`: a frame's time over the number of particles, of blocks at rest.

use std::error::Error;
use std::path::Path;

use vitriol_gpu::{Gpu, GpuError};
use vitriol_run::passes::Timing;
use vitriol_run::units::{grouped, percent};
use vitriol_run::{Blame, Failure, output};
use vitriol_sim::scene::Scene;
use vitriol_sim::world::WorldError;

use super::peer::Peer;
use super::report::{Scaling, ScalingRow, Skipped};
use super::rest::at_rest;
use super::scaling_plot::draw;

/// Particles of the rows.
const COUNTS: [u64; 7] = [1_000, 4_000, 16_000, 64_000, 250_000, 1_000_000, 4_000_000];
/// Spacing, m: the paper's world.
const SPACING: f64 = 0.05;
/// Most layers of particles, as in `sim/scenes/bench/million.toml`. A deeper column would want shorter substeps.
const LAYERS: f64 = 20.0;

/// Measures blocks of up to `most` particles, and draws them into the file `figure`.
///
/// # Errors
/// [`Failure::Input`] where the file exists; otherwise the error of the device or of a peer.
pub fn measure(
    gpu: &Gpu,
    figure: &Path,
    (most, frames): (u64, u32),
    peers: &[Peer],
) -> Result<Scaling, Failure> {
    let folder = figure.parent().unwrap_or(Path::new(""));
    let name = figure.file_name().unwrap_or_default().to_string_lossy();
    let figure = output::new_file(folder, &name)?;
    let (mut rows, mut skipped) = (Vec::new(), Vec::new());
    let mut effort = [0, 0];
    for count in COUNTS.into_iter().filter(|count| *count <= most) {
        let scene = block(count)?;
        effort = [scene.solver.substeps, scene.solver.iterations];
        match at_rest(gpu, &scene, frames, peers) {
            Ok(rest) => rows.push(ScalingRow {
                fluid_particles: rest.particles,
                total: rest.total,
                particle_iteration_ns: 1e6 * rest.total.median_ms
                    / (rest.particles as f64 * f64::from(effort[0] * effort[1])),
                density_error_mean: rest.density_error_mean,
                density_error_p99: rest.density_error_p99,
                peers: rest.peers,
            }),
            Err(failure) if lacks_memory(&failure) => skipped.push(Skipped {
                fluid_particles: count,
                reason: failure.to_string(),
            }),
            Err(failure) => return Err(failure),
        }
    }
    let mut svg = String::new();
    draw(&mut svg, &rows).other()?;
    output::write_new(&figure, svg.as_bytes())?;
    Ok(Scaling {
        substeps: effort[0],
        iterations: effort[1],
        rows,
        skipped,
        figure: figure.display().to_string(),
    })
}

/// `count` particles at rest, as deep as a cube of them, but [`LAYERS`] at most.
fn block(count: u64) -> Result<Scene, Failure> {
    let layers = (count as f64).cbrt().min(LAYERS);
    let radius = SPACING * (count as f64 / layers / std::f64::consts::PI).sqrt();
    // A wall cuts the lattice, so that some layers come on top.
    let rim = SPACING * (1.5 * layers + 5.0);
    let text = format!(
        r#"name = "block"
description = "{count} particles at rest."
model = []

[scale]
spacing = {SPACING:?}
support_ratio = 2.0
frame_time = 0.016666666666667
gravity = 9.81
rest_density = 1000.0
length_scale = 0.05
boundary_spacing_ratio = 0.5

[solver]
substeps = 3
iterations = 2
relaxation = "jacobi"
omega = 0.35
carry_rate = 0.0
v_max = 20.0
boundary = "map"
viscosity = 0.3

[floor]
height = 0.0

[[flask]]
name = "tray"
points = [[0.0, {radius:?}], [{rim:?}, {radius:?}]]
wall = 0.1
density = 2230.0
position = [0.0, 0.0, 0.0]
fixed = true

[[liquid]]
flask = "tray"
particles = {count}
temperature = 20.0
acid_fraction = 0.0
"#
    );
    Scene::parse(&text, "block.toml").other()
}

/// Whether the device had too little memory, or lets no shader bind as much at once.
fn lacks_memory(failure: &Failure) -> bool {
    let (Failure::Input(cause) | Failure::NoDevice(cause) | Failure::Other(cause)) = failure;
    let mut next: Option<&(dyn Error + 'static)> = Some(cause.as_ref());
    while let Some(error) = next {
        let world = error.downcast_ref::<WorldError>();
        let gpu = match world {
            Some(WorldError::Gpu(error)) => Some(error),
            _ => error.downcast_ref::<GpuError>(),
        };
        if let Some(GpuError::OutOfMemory { .. } | GpuError::BufferTooLarge { .. }) = gpu {
            return true;
        }
        next = error.source();
    }
    false
}

impl Scaling {
    /// A table for people.
    pub fn describe(&self) -> String {
        let mut text = format!(
            "\nblocks at rest, {} × {}\n\
             particles   median ms      95 %   ns a particle and iteration   mean error  99 %\n",
            self.substeps, self.iterations
        );
        for row in &self.rows {
            let Timing { median_ms, p95_ms } = row.total;
            text += &format!(
                "{:>9} {median_ms:>11.3} {p95_ms:>9.3} {:>29.3} {:>12} {:>5}\n",
                grouped(row.fluid_particles),
                row.particle_iteration_ns,
                percent(row.density_error_mean),
                percent(row.density_error_p99)
            );
            for peer in &row.peers {
                text.push_str(&peer.describe());
            }
        }
        for row in &self.skipped {
            text += &format!(
                "{:>9} not measured: {}\n",
                grouped(row.fluid_particles),
                row.reason
            );
        }
        text += &format!("figure  {}\n", self.figure);
        text
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use vitriol_sim::solver::SolverError;

    #[test]
    fn each_block_loads_with_its_particles() {
        for count in COUNTS {
            let scene = block(count).unwrap();
            assert_eq!(scene.particle_count(&scene.liquids[0]) as u64, count);
            assert_eq!(scene.problem_of_solver(), None);
        }
    }

    #[test]
    fn only_a_lack_of_memory_skips_a_row() {
        let short = || GpuError::OutOfMemory {
            label: "list".into(),
            bytes: Some(1),
            cause: "full".into(),
        };
        let large = GpuError::BufferTooLarge {
            label: "list".into(),
            bytes: 2,
            limit: 1,
        };
        let lacks = |error: WorldError| lacks_memory(&Err::<(), _>(error).other().unwrap_err());
        assert!(lacks(WorldError::Gpu(short())));
        assert!(lacks(WorldError::Solver(SolverError::Gpu(short()))));
        assert!(lacks(WorldError::Solver(SolverError::Gpu(large))));
        let other = SolverError::TooManyParticles(1 << 33);
        assert!(!lacks(WorldError::Solver(other)));
        assert!(!lacks(WorldError::Gpu(GpuError::NoDevice)));
    }
}
