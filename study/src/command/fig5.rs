//! `vitriol fig5`: the paper's Fig. 5. A hand jerks a flask to and fro; without
//! the flask constraint its liquid goes through the glass.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use glam::{Quat, Vec3};
use serde::Serialize;
use vitriol_gpu::Gpu;
use vitriol_run::output::ColorType;
use vitriol_run::{Blame, Camera, Colour, FILM_SIZE, Failure, Format, Shot, device, emit, output};
use vitriol_shaders::Library;
use vitriol_sim::bodies::Hand;
use vitriol_sim::flask::Region;
use vitriol_sim::pose::Pose;
use vitriol_sim::scene::Scene;
use vitriol_sim::solver::SolverState;
use vitriol_sim::world::{StepInput, World};

use crate::cli::Fig5Args;

/// The scene of Fig. 5.
const SCENE: &str = "moving-flask";
/// Simulated frames: at rest first, then the motion, then at rest again.
const FRAMES: [u32; 3] = [30, 60, 30];
/// How far the flask is jerked to either side, in its own radii.
const SWING: f32 = 0.25;
/// Frames of one jerk and of the rest after it.
const JERK: [u32; 2] = [2, 8];

/// Results of `vitriol fig5`.
#[derive(Debug, Serialize)]
pub struct Fig5 {
    /// Fluid particles.
    pub fluid_particles: u32,
    /// Highest speed of the flask, particle spacings per frame.
    pub spacings_per_frame: f32,
    /// Result without the flask constraint.
    pub without: Count,
    /// Result with it.
    pub with: Count,
}

/// Where a run's particles are at the end.
#[derive(Debug, Serialize)]
pub struct Count {
    /// Particles that went through the glass.
    pub through_glass: usize,
    /// Particles that left over the rim.
    pub over_rim: usize,
    /// Particles in the flask at the end.
    pub in_flask: usize,
}

/// Runs `vitriol fig5`.
///
/// # Errors
/// [`Failure::NoDevice`]; [`Failure::Input`] where a picture exists already;
/// [`Failure::Other`] where device or folder fails.
pub fn run(args: &Fig5Args, format: Format) -> Result<(), Failure> {
    let names = ["fig5-without.png", "fig5-with.png"];
    let pictures = output::new_files(args.out.as_deref(), names)?;
    let gpu = device::open(args.device.as_deref())?;
    let scene = Scene::builtin(SCENE).input()?;
    let result = compare(&gpu, &scene, pictures.as_ref())?;
    emit(format, &result, describe)
}

/// Jerks the first flask of `scene` without the flask constraint and with it;
/// takes a picture of each end where there are paths for them.
///
/// # Errors
/// The error of the device or of the folder.
pub fn compare(gpu: &Gpu, scene: &Scene, pictures: Option<&[PathBuf; 2]>) -> Result<Fig5, Failure> {
    let library = Library::embedded();
    let free = World::without_flask_constraint(gpu, &library, scene, 0).other()?;
    let without = count(gpu, free, pictures.map(|[path, _]| &**path))?;
    let held = World::new(gpu, &library, scene, 0).other()?;
    let fluid_particles = held.solver().count();
    let with = count(gpu, held, pictures.map(|[_, path]| &**path))?;
    let jump = 2.0 * SWING * scene.flasks[0].profile.outer_radius() as f32 / JERK[0] as f32;
    Ok(Fig5 {
        fluid_particles,
        spacings_per_frame: jump / scene.scale.spacing as f32,
        without,
        with,
    })
}

/// Runs the motion and classifies particles that leave the flask, frame by frame, by geometry alone: membership is the constraint's own.
fn count(gpu: &Gpu, mut world: World, picture: Option<&Path>) -> Result<Count, Failure> {
    let scene = world.scene().clone();
    let flask = &scene.flasks[0];
    let start = flask.stage_from_flask;
    let reach = flask.profile.outer_radius() as f32;
    let grip = Vec3::new(reach, 0.5 * flask.profile.rim_height() as f32, 0.0);
    let (mut through, mut over) = (BTreeSet::new(), BTreeSet::new());
    let mut inside: BTreeSet<u32> = (0..world.solver().count()).collect();
    for frame in 0..FRAMES.iter().sum() {
        let offset = Vec3::X * (SWING * reach * side(frame));
        let hand = Hand {
            stage_from_grip: Pose::new(start.position + grip + offset, Quat::IDENTITY),
            squeeze: 1.0,
            present: true,
        };
        world
            .step(&StepInput::of_hands([Hand::ABSENT, hand]))
            .other()?;
        let state = world.snapshot().other()?.solver;
        inside.retain(|&id| !through.contains(&id) && !over.contains(&id));
        for (id, region) in regions(&state, world.poses()[0], flask) {
            match region {
                Region::Outside if inside.contains(&id) => _ = through.insert(id),
                Region::Above if inside.contains(&id) => _ = over.insert(id),
                _ => {}
            }
        }
    }
    if let Some(path) = picture {
        shoot(gpu, &world, path)?;
    }
    let state = world.snapshot().other()?.solver;
    let end = regions(&state, world.poses()[0], flask);
    Ok(Count {
        through_glass: through.len(),
        over_rim: over.len(),
        in_flask: end.filter(|(_, region)| *region == Region::Inside).count(),
    })
}

/// The flask's displacement at a frame's end: −1, 0 or 1, or between.
fn side(frame: u32) -> f32 {
    let Some(moving) = frame.checked_sub(FRAMES[0]).filter(|&n| n < FRAMES[1]) else {
        return 0.0;
    };
    let period = JERK[0] + JERK[1];
    let target = |jerk: u32| if jerk.is_multiple_of(2) { 1.0 } else { -1.0 };
    let (jerk, within) = (moving / period, moving % period);
    let from = if jerk == 0 { 0.0 } else { target(jerk - 1) };
    let way = ((within + 1) as f32 / JERK[0] as f32).min(1.0);
    from + (target(jerk) - from) * way
}

/// Identity and region of each particle.
fn regions<'a>(
    state: &'a SolverState,
    stage_from_flask: Pose,
    flask: &'a vitriol_sim::scene::Flask,
) -> impl Iterator<Item = (u32, Region)> + 'a {
    let flask_from_stage = stage_from_flask.inverse();
    // Rounding in the stage's frame must not count as a way through the glass.
    let tolerance = 1e-3 * flask.profile.wall();
    (0..state.positions.len()).map(move |slot| {
        let [x, y, z, _] = state.positions[slot];
        let local = flask_from_stage
            .transform_point(Vec3::new(x, y, z))
            .as_dvec3();
        let depth = flask
            .profile
            .signed_distance_inner(local.x.hypot(local.z), local.y);
        let region = match Region::of(&flask.profile, local) {
            Region::Outside if depth > -tolerance => Region::Inside,
            region => region,
        };
        (state.tags[slot][1], region)
    })
}

fn shoot(gpu: &Gpu, world: &World, path: &Path) -> Result<(), Failure> {
    let shot = Shot::of(FILM_SIZE);
    let camera = Camera::new(gpu, &Library::embedded(), world.scene(), &shot)?;
    let picture = camera.shoot(world, Colour::Speed)?;
    let file = output::png(&picture, FILM_SIZE, ColorType::Rgba)?;
    output::write_new(path, &file)
}

fn describe(result: &Fig5) -> String {
    let line = |name: &str, count: &Count| {
        format!(
            "{name}: {} through the glass, {} over the rim, {} in the flask at the end",
            count.through_glass, count.over_rim, count.in_flask
        )
    };
    format!(
        "{} particles; the flask jumps up to {:.0} particle spacings a frame\n{}\n{}",
        result.fluid_particles,
        result.spacings_per_frame,
        line("without the flask constraint", &result.without),
        line("with it", &result.with)
    )
}
