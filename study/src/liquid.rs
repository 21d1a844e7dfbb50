//! Liquid in a solver of its own, without a world around it.

use glam::DVec3;
use vitriol_gpu::{Gpu, QueueKind};
use vitriol_run::{Blame, Failure};
use vitriol_shaders::Library;
use vitriol_sim::parameters::Parameters;
use vitriol_sim::pose::Pose;
use vitriol_sim::solver::{Ground, Particle, Solver, SolverSpec};

/// Water at rest, 20 °C, in no flask.
pub fn water(position: DVec3) -> Particle {
    Particle {
        position,
        velocity: DVec3::ZERO,
        flask: None,
        temperature: 20.0,
        acid: 0.0,
        carried: 0.0,
    }
}

/// Liquid with nothing around it but a floor a kilometre below.
pub fn alone(parameters: Parameters, particles: &[Particle]) -> SolverSpec<'_> {
    SolverSpec {
        parameters,
        flasks: &[],
        solids: None,
        ground: Ground {
            floor: -1000.0,
            table: None,
            scale: 1.0,
        },
        particles,
        at_rest: false,
        tools: false,
        loads: false,
        constraint: true,
        lanes: None,
    }
}

/// A solver of such liquid.
pub fn solver(gpu: &Gpu, spec: &SolverSpec<'_>) -> Result<Solver, Failure> {
    Solver::new(gpu, &Library::embedded(), spec).other()
}

/// A frame in which the flasks move from `before` to `after`; waits for the device.
pub fn frame(gpu: &Gpu, solver: &Solver, before: &[Pose], after: &[Pose]) -> Result<(), Failure> {
    let mut rec = gpu.recorder(QueueKind::Main).other()?;
    solver.record(&mut rec, before, after).other()?;
    gpu.submit(rec).and_then(|ticket| ticket.wait()).other()
}

/// ρ/ρ₀ of each particle, by slot.
pub fn densities(gpu: &Gpu, solver: &Solver) -> Result<Vec<f32>, Failure> {
    let mut rec = gpu.recorder(QueueKind::Main).other()?;
    let copy = solver.record_density(&mut rec).other()?;
    gpu.submit(rec).and_then(|ticket| ticket.wait()).other()?;
    copy.get::<f32>().other()
}
