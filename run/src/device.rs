//! The device that a command runs on.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use vitriol_gpu::{Gpu, GpuError, Options, PlainLoader, Timestamps};

use crate::failure::Failure;

/// The device and driver of a run.
#[derive(Debug, Clone, Default, PartialEq, JsonSchema, Serialize, Deserialize)]
pub struct DeviceStatement {
    /// The device's name.
    pub name: String,
    /// The driver and its version.
    pub driver: String,
    /// Vulkan API version.
    pub api: String,
}

/// Opens the device that was asked for, or the best.
///
/// # Errors
/// [`Failure::NoDevice`], or [`Failure::Input`] for a device that is not there.
pub fn open(device: Option<&str>) -> Result<Gpu, Failure> {
    timed(device, Timestamps::None)
}

/// Opens the device that was asked for as [`open`] does, with a choice of the device's timestamps.
///
/// # Errors
/// As for [`open`].
pub fn timed(device: Option<&str>, timestamps: Timestamps) -> Result<Gpu, Failure> {
    let options = Options {
        device: device.map(str::to_owned),
        timestamps,
        pipelines: pipelines(),
        ..Options::default()
    };
    Gpu::open(&mut PlainLoader::default(), &options).map_err(blame)
}

/// The user's folder in which compiled pipelines are kept, where there is one.
pub fn pipelines() -> Option<PathBuf> {
    dirs::cache_dir().map(|folder| folder.join("vitriol").join("pipelines"))
}

/// The device and driver as a report names them.
pub fn statement(gpu: &Gpu) -> DeviceStatement {
    let info = gpu.info();
    DeviceStatement {
        name: info.name.clone(),
        driver: info.driver.clone(),
        api: info.api.clone(),
    }
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
