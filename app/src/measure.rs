//! Measures what `vitriol bench` prints: a scene at rest in its flasks, frame
//! by frame on the device's own clock.

mod features;
mod picture;
mod tally;

use std::time::Instant;

use vitriol_gpu::{Gpu, QueueKind, Timestamps};
use vitriol_shaders::Library;
use vitriol_sim::pose::Pose;
use vitriol_sim::scene::{Boundary, Scene};
use vitriol_sim::world::World;

use crate::cli::BenchArgs;
use crate::command::bench::{Bench, PassRow, Row, TABLE_2, Timing};
use crate::device;
use crate::failure::{Blame, Failure};
use tally::Tally;

/// Simulated time before the first measured frame, seconds: the filling
/// lattice has settled, and the driver has compiled what it compiles late.
const WARM_UP: f64 = 1.0;

/// Frames that are submitted before the device is waited for: as in the loop,
/// recording one frame overlaps with solving the one before, and the time is
/// that of whichever takes longer.
const QUEUED: u32 = 8;

/// Measures what `vitriol bench` was asked for.
///
/// # Errors
/// [`Failure::NoDevice`], or [`Failure::Input`] for a scene or device that is
/// not there.
pub fn measure(args: &BenchArgs) -> Result<Bench, Failure> {
    let timed = device::timed(args.device.as_deref(), Timestamps::Passes)?;
    let plain = device::open(args.device.as_deref())?;
    let names: Vec<String> = match (&args.scene, args.paper) {
        (_, true) => TABLE_2.iter().map(|(name, _)| (*name).to_owned()).collect(),
        (Some(scene), false) => vec![scene.clone()],
        (None, false) if args.render => vec!["triple-dilution".to_owned()],
        (None, false) => vec!["beaker".to_owned()],
    };
    let (mut rows, mut costs, mut pictures) = (Vec::new(), Vec::new(), Vec::new());
    if args.render {
        for name in &names {
            pictures.extend(picture::rows(&timed, &plain, name, args)?);
        }
    } else if args.features {
        for name in &names {
            costs.extend(features::costs(&timed, &plain, name, args)?);
        }
    } else {
        for name in &names {
            rows.push(row(&timed, &plain, name, args)?);
        }
    }
    Ok(Bench {
        device: device::statement(&timed),
        frames: args.frames,
        rows,
        features: costs,
        pictures,
    })
}

/// One scene: totals without timestamps around passes, which cost time
/// themselves on a software driver, then each pass with them.
fn row(timed: &Gpu, plain: &Gpu, name: &str, args: &BenchArgs) -> Result<Row, Failure> {
    let scene = Scene::load(name).input()?.with_preset(args.preset.into());
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
        let poses = world.poses().to_vec();
        let (mut total, mut cpu) = (Vec::new(), Vec::new());
        for _ in 0..frames.div_ceil(QUEUED) {
            total.push(queued(gpu, &world, &poses, &mut cpu)?);
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

/// A frame's share, ms, of [`QUEUED`] frames at rest; `cpu` gets the time that
/// each took to record and submit.
fn queued(gpu: &Gpu, world: &World, poses: &[Pose], cpu: &mut Vec<f64>) -> Result<f64, Failure> {
    let begin = Instant::now();
    let mut last = None;
    for _ in 0..QUEUED {
        let recording = Instant::now();
        let mut rec = gpu.recorder(QueueKind::Main).other()?;
        world.solver().record(&mut rec, poses, poses).other()?;
        last = Some(gpu.submit(rec).other()?);
        cpu.push(milliseconds(recording));
    }
    if let Some(ticket) = last {
        ticket.wait().other()?;
    }
    Ok(milliseconds(begin) / f64::from(QUEUED))
}

/// The passes of `frames` frames of a scene at rest, and the frames.
fn passes(gpu: &Gpu, scene: &Scene, frames: u32) -> Result<(Vec<PassRow>, Timing), Failure> {
    let world = settled(gpu, scene)?;
    let poses = world.poses().to_vec();
    let mut tally = Tally::default();
    for _ in 0..frames {
        let mut rec = gpu.recorder(QueueKind::Main).other()?;
        world.solver().record(&mut rec, &poses, &poses).other()?;
        let ticket = gpu.submit(rec).other()?;
        ticket.wait().other()?;
        tally.add(&ticket)?;
    }
    Ok(tally.rows())
}

/// Passes of a first frame of `scene`, which rebuilds its lists in every substep that
/// asks for it, and bytes of device memory a particle.
///
/// # Errors
/// What the device says.
pub(crate) fn anatomy(gpu: &Gpu, scene: &Scene) -> Result<(Vec<PassRow>, u64), Failure> {
    let world = World::new(gpu, &Library::embedded(), scene, 0).other()?;
    let poses = world.poses().to_vec();
    let mut rec = gpu.recorder(QueueKind::Main).other()?;
    world.solver().record(&mut rec, &poses, &poses).other()?;
    let ticket = gpu.submit(rec).other()?;
    ticket.wait().other()?;
    let mut tally = Tally::default();
    tally.add(&ticket)?;
    Ok((tally.rows().0, world.solver().bytes_per_particle()))
}

/// A world whose liquid has come to rest.
fn settled(gpu: &Gpu, scene: &Scene) -> Result<World, Failure> {
    let world = World::new(gpu, &Library::embedded(), scene, 0).other()?;
    let poses = world.poses().to_vec();
    let frames = (WARM_UP / scene.scale.frame_time).ceil() as u64;
    for _ in 0..frames {
        let mut rec = gpu.recorder(QueueKind::Main).other()?;
        world.solver().record(&mut rec, &poses, &poses).other()?;
        gpu.submit(rec).and_then(|ticket| ticket.wait()).other()?;
    }
    Ok(world)
}

fn milliseconds(begin: Instant) -> f64 {
    begin.elapsed().as_secs_f64() * 1e3
}
