//! The simulated world and its picture on a Vulkan device, as the loop drives
//! them.

use vitriol_gpu::{Gpu, GpuError, Options, PlainLoader};
use vitriol_sim::scene::Scene;

use crate::cli::{BenchArgs, ReplayArgs};
use crate::command::bench::Bench;
use crate::failure::{Blame, Failure};
use crate::replay::Experiment;

/// The experiment of a scene on the device that was asked for.
///
/// # Errors
/// [`Failure::NoDevice`], or [`Failure::Input`] for a device that is not there.
pub fn prepare(args: &ReplayArgs, _scene: &Scene) -> Result<Box<dyn Experiment>, Failure> {
    let _gpu = open(args.device.as_deref(), false)?;
    Err("the world is not wired to the loop yet").other()
}

/// Measures what `vitriol bench` was asked for.
///
/// # Errors
/// As for [`prepare`].
pub fn measure(args: &BenchArgs) -> Result<Bench, Failure> {
    let _gpu = open(args.device.as_deref(), true)?;
    Err("the world is not wired to the bench yet").other()
}

/// Opens the device that was asked for, or the best.
fn open(device: Option<&str>, timestamps: bool) -> Result<Gpu, Failure> {
    let options = Options {
        device: device.map(str::to_owned),
        timestamps,
        ..Options::default()
    };
    Gpu::open(&mut PlainLoader::default(), &options).map_err(blame)
}

fn blame(error: GpuError) -> Failure {
    match error {
        GpuError::NoSuchDevice { .. } => Failure::Input(error.into()),
        GpuError::NoLoader { .. }
        | GpuError::NoInstance { .. }
        | GpuError::NoDevice
        | GpuError::Unsuitable { .. } => Failure::NoDevice(error.into()),
        _ => Failure::Other(error.into()),
    }
}
