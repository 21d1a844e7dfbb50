//! The cost of each feature of a scene.

use vitriol_gpu::Gpu;
use vitriol_run::{Failure, scenes};
use vitriol_sim::scene::Scene;
use vitriol_sim::world::World;

use super::frame::{QUEUED, passes, queued, settled};
use super::report::FeatureRow;
use crate::cli::BenchArgs;

/// Rounds in which a scene with and one without a feature take turns, so that other work of the machine affects both alike.
const ROUNDS: usize = 9;

/// The cost of each feature of the scene `name`.
///
/// # Errors
/// [`Failure::Input`] for a scene that does not exist; otherwise the device's error.
pub fn costs(
    timed: &Gpu,
    plain: &Gpu,
    name: &str,
    args: &BenchArgs,
) -> Result<Vec<FeatureRow>, Failure> {
    let scene = scenes::load(name)?.with_preset(args.preset).without_sleep();
    let whole = settled(plain, &scene)?;
    let dispatches = dispatches(timed, &scene)?;
    scene
        .model
        .iter()
        .map(|&feature| {
            let (less, gone) = scene.without(feature);
            let without = settled(plain, &less)?;
            let mut differences = differences(plain, &whole, &without, args.frames)?;
            differences.sort_by(f64::total_cmp);
            let bytes = |world: &World| world.solver().bytes_per_particle() as i64;
            Ok(FeatureRow {
                feature: feature.name(),
                also_off: gone[1..].iter().map(|feature| feature.name()).collect(),
                cost_ms: differences[ROUNDS / 2],
                range_ms: [differences[0], differences[ROUNDS - 1]],
                dispatches: dispatches - self::dispatches(timed, &less)?,
                bytes_per_particle: bytes(&whole) - bytes(&without),
            })
        })
        .collect()
}

/// Time of a frame of `whole` less that of `without`, ms, in each round.
fn differences(
    gpu: &Gpu,
    whole: &World,
    without: &World,
    frames: u32,
) -> Result<Vec<f64>, Failure> {
    let times = frames.div_ceil(QUEUED).div_ceil(ROUNDS as u32);
    let time = |world: &World| -> Result<f64, Failure> {
        let mut sum = 0.0;
        for _ in 0..times {
            sum += queued(gpu, world, &mut Vec::new())?;
        }
        Ok(sum / f64::from(times))
    };
    (0..ROUNDS)
        .map(|_| Ok(time(whole)? - time(without)?))
        .collect()
}

/// Dispatches in a frame of `scene`.
fn dispatches(gpu: &Gpu, scene: &Scene) -> Result<i64, Failure> {
    let (rows, _) = passes(gpu, scene, 1)?;
    Ok(rows.iter().map(|row| i64::from(row.dispatches)).sum())
}
