//! A scene at rest, solved frame by frame, and its time on the device's own clock.

use std::time::Instant;

use super::report::Asleep;
use vitriol_gpu::Gpu;
use vitriol_run::passes::{PassRow, Tally, Timing, solve};
use vitriol_run::{Blame, Failure};
use vitriol_shaders::Library;
use vitriol_sim::bodies::Hand;
use vitriol_sim::scene::Scene;
use vitriol_sim::world::{StepInput, World};

/// Simulated time before the first measured frame, seconds: by then the filling lattice has settled, and the driver has compiled the last
/// pipelines.
const WARM_UP: f64 = 1.0;

/// Frames that are submitted before the device is waited for: as in the loop,
/// recording one frame overlaps with solving the one before, and the time is
/// that of whichever takes longer.
pub(super) const QUEUED: u32 = 8;

/// A frame's share, ms, of [`QUEUED`] frames at rest; `cpu` gets the time that
/// each took to record and submit.
pub(super) fn queued(gpu: &Gpu, world: &World, cpu: &mut Vec<f64>) -> Result<f64, Failure> {
    let begin = Instant::now();
    let mut last = None;
    for _ in 0..QUEUED {
        let recording = Instant::now();
        last = Some(solve(gpu, world)?);
        cpu.push(milliseconds(recording));
    }
    if let Some(ticket) = last {
        ticket.wait().other()?;
    }
    Ok(milliseconds(begin) / f64::from(QUEUED))
}

/// The passes of `frames` frames of a scene at rest, and the frames.
pub(super) fn passes(
    gpu: &Gpu,
    scene: &Scene,
    frames: u32,
) -> Result<(Vec<PassRow>, Timing), Failure> {
    let world = settled(gpu, scene)?;
    let mut tally = Tally::default();
    for _ in 0..frames {
        tally.add(&solve(gpu, &world)?)?;
    }
    Ok(tally.rows())
}

/// A world whose liquid has come to rest.
pub(super) fn settled(gpu: &Gpu, scene: &Scene) -> Result<World, Failure> {
    let world = World::new(gpu, &Library::watching(), scene, 0).other()?;
    let frames = (WARM_UP / scene.scale.frame_time).ceil() as u64;
    for _ in 0..frames {
        solve(gpu, &world)?.wait().other()?;
    }
    Ok(world)
}

/// Steps of a world whose liquid has come to rest and sleeps; `None` where none may.
pub(super) fn asleep(gpu: &Gpu, scene: &Scene, frames: u32) -> Result<Option<Asleep>, Failure> {
    if !scene.solver.sleep {
        return Ok(None);
    }
    let mut world = World::new(gpu, &Library::watching(), scene, 0).other()?;
    let steps = |world: &mut World, count: u32| -> Result<f64, Failure> {
        let begin = Instant::now();
        for _ in 0..count {
            world
                .step(&StepInput::of_hands([Hand::ABSENT; 2]))
                .other()?;
        }
        if let Some(ticket) = world.last_step() {
            ticket.wait().other()?;
        }
        Ok(milliseconds(begin) / f64::from(count))
    };
    steps(
        &mut world,
        (2.0 * WARM_UP / scene.scale.frame_time).ceil() as u32,
    )?;
    let times = (0..frames.div_ceil(QUEUED)).map(|_| steps(&mut world, QUEUED));
    let times: Vec<f64> = times.collect::<Result<_, Failure>>()?;
    Ok(Some(Asleep {
        step: Timing::of(&times),
        awake: world.solver().awake().other()?,
    }))
}

pub(super) fn milliseconds(begin: Instant) -> f64 {
    begin.elapsed().as_secs_f64() * 1e3
}
