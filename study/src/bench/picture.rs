//! `vitriol bench --render`: the time of each pass of the picture, at a headset's resolutions and a screen's, of a scene in motion.

use std::f32::consts::FRAC_PI_2;
use std::time::Instant;

use glam::{Quat, Vec3};
use vitriol_gpu::{Gpu, QueueKind, Ticket};
use vitriol_render::{Fov, Foveation, View};
use vitriol_run::scenery::drawn_liquid;
use vitriol_run::{Blame, Camera, Colour, Failure, Shot, scenes};
use vitriol_shaders::Library;
use vitriol_sim::scene::Scene;
use vitriol_sim::world::World;
use vitriol_xr::{Hand, Pose};

use super::frame::{QUEUED, milliseconds};
use super::report::RenderRow;
use crate::cli::BenchArgs;
use vitriol_run::passes::{PassRow, Tally, Timing, solve};

/// Number of views, and width and height of each.
const SIZES: [(u32, [u32; 2]); 3] = [(2, [1440, 1584]), (2, [2064, 2208]), (1, [1920, 1080])];

/// Simulated time before the first measured frame, seconds: funnels run.
const BEGIN: f64 = 0.5;

/// Half a meter before the vessels and above them, in real metres, as one
/// leans over a bench.
const HEAD: [Vec3; 2] = [Vec3::new(0.0, 1.12, 0.02), Vec3::new(0.0, 0.84, -0.40)];

/// A headset's hands: open, palms towards each other, half a metre from the eyes, real metres.
const HANDS: [Vec3; 2] = [Vec3::new(-0.10, 0.87, -0.36), Vec3::new(0.10, 0.87, -0.36)];

/// The scene's picture at each size, or at the one that is asked for.
///
/// # Errors
/// [`Failure::Input`] for a scene that does not exist; otherwise the device's error.
pub fn rows(
    timed: &Gpu,
    plain: &Gpu,
    name: &str,
    args: &BenchArgs,
) -> Result<Vec<RenderRow>, Failure> {
    let scene = scenes::load(name)?.with_preset(args.preset).without_sleep();
    let row = |case: Case| {
        let (views, extent, foveation) = case;
        let (world, camera) = ready(timed, &scene, args, case)?;
        let (passes, total) = passes(timed, &world, &camera, args.frames)?;
        let (world, camera) = ready(plain, &scene, args, case)?;
        let queued = queued(plain, &world, Some(&camera), args.frames)?;
        Ok(RenderRow {
            scene: name.to_owned(),
            fluid_particles: world.solver().count().into(),
            views,
            width: extent[0],
            height: extent[1],
            foveated: foveation.is_some(),
            passes,
            device_total: total,
            frame: queued,
            overlapped: overlapped(plain, &world, &camera, args.frames)?,
            solver: self::queued(plain, &world, None, args.frames)?,
        })
    };
    match args.size {
        Some(extent) => [(1, extent, None)].into_iter().map(row).collect(),
        None => cases().map(row).collect(),
    }
}

/// (views, width and height, foveation): a headset's picture sharp everywhere, and foveated as in a session.
type Case = (u32, [u32; 2], Option<Foveation>);

fn cases() -> impl Iterator<Item = Case> {
    SIZES.into_iter().flat_map(|(views, extent)| {
        let foveated = (views == 2).then(|| Some(Foveation::fixed()));
        [Some(None), foveated]
            .into_iter()
            .flatten()
            .map(move |foveation| (views, extent, foveation))
    })
}

/// A world in motion and the camera before it.
fn ready(
    gpu: &Gpu,
    scene: &Scene,
    args: &BenchArgs,
    (eyes, extent, foveation): Case,
) -> Result<(World, Camera), Failure> {
    let library = Library::watching();
    let world = World::new(gpu, &library, scene, 0).other()?;
    let shot = Shot {
        extent,
        eyes,
        liquid: Some(drawn_liquid(&world)),
        filter: args.filter,
        foveation,
        ..Shot::of(extent)
    };
    let mut camera = Camera::new(gpu, &library, scene, &shot)?;
    let aspect = extent[0] as f32 / extent[1] as f32;
    // A headset's field; on a screen a wide lens.
    let vertical: f32 = if eyes == 2 { 96.0 } else { 60.0 };
    let [eye, target] = HEAD;
    let fov = Fov::symmetric(vertical.to_radians(), aspect);
    camera.view = View::look_at(eye, target, fov);
    if eyes == 2 {
        camera.show_hands(HANDS.map(|place| Hand {
            active: true,
            valid: true,
            stage_from_grip: Pose::new(place, Quat::from_rotation_x(FRAC_PI_2)),
            ..Hand::default()
        }));
    }
    for _ in 0..(BEGIN / scene.scale.frame_time) as u32 {
        solve(gpu, &world)?;
    }
    gpu.wait_idle().other()?;
    Ok((world, camera))
}

/// Times of each pass by the device's clock, and of all of them.
fn passes(
    gpu: &Gpu,
    world: &World,
    camera: &Camera,
    frames: u32,
) -> Result<(Vec<PassRow>, Timing), Failure> {
    let mut tally = Tally::default();
    for _ in 0..frames {
        solve(gpu, world)?;
        let mut rec = gpu.recorder(QueueKind::Main).other()?;
        camera.record(&mut rec, world, Colour::Liquid)?;
        tally.add(&gpu.submit(rec).other()?)?;
    }
    Ok(tally.rows())
}

/// A frame's share, ms, where a frame is solved on one queue while the one before it is drawn
/// on the other.
fn overlapped(gpu: &Gpu, world: &World, camera: &Camera, frames: u32) -> Result<Timing, Failure> {
    let mut times = Vec::new();
    for _ in 0..frames.div_ceil(QUEUED) {
        let begin = Instant::now();
        let mut drawn: Vec<Ticket> = Vec::new();
        for n in 0..QUEUED as usize {
            let mut solved = gpu.recorder(QueueKind::Async).other()?;
            let mut picture = gpu.recorder(QueueKind::Main).other()?;
            let poses = world.poses();
            world.solver().record(&mut solved, poses, poses).other()?;
            camera.record_apart(&mut solved, &mut picture, world, n)?;
            // The picture that used this slot before.
            let before: Vec<&Ticket> = n.checked_sub(2).map(|n| &drawn[n]).into_iter().collect();
            let solved = gpu.submit_after(solved, &before).other()?;
            drawn.push(gpu.submit_after(picture, &[&solved]).other()?);
        }
        gpu.wait_idle().other()?;
        times.push(milliseconds(begin) / f64::from(QUEUED));
    }
    Ok(Timing::of(&times))
}

/// A frame's share, ms, of [`QUEUED`] frames that are solved and, with a camera,
/// drawn.
fn queued(
    gpu: &Gpu,
    world: &World,
    camera: Option<&Camera>,
    frames: u32,
) -> Result<Timing, Failure> {
    let mut times = Vec::new();
    for _ in 0..frames.div_ceil(QUEUED) {
        let begin = Instant::now();
        for _ in 0..QUEUED {
            solve(gpu, world)?;
            if let Some(camera) = camera {
                let mut rec = gpu.recorder(QueueKind::Main).other()?;
                camera.record(&mut rec, world, Colour::Liquid)?;
                gpu.submit(rec).other()?;
            }
        }
        gpu.wait_idle().other()?;
        times.push(milliseconds(begin) / f64::from(QUEUED));
    }
    Ok(Timing::of(&times))
}
