//! Vulkan for Vitriol: device, memory, pipelines, queues and a pass recorder.
//!
//! A pass is one expression that names its pipeline, what it reads, what it
//! writes and its size; barriers, debug labels, timestamps and the "last pass
//! reached" marker follow from it:
//!
//! ```no_run
//! # use vitriol_gpu::*;
//! # fn f(compiled: &vitriol_shaders::Compiled) -> Result<(), GpuError> {
//! let gpu = Gpu::open(&mut PlainLoader::default(), &Options::default())?;
//! let lambda_pass = ComputePipeline::new(&gpu, compiled)?;
//! let position = Buffer::storage(&gpu, "position", 16 * 1024)?;
//! let lambda = Buffer::storage(&gpu, "lambda", 4 * 1024)?;
//! let mut rec = gpu.recorder(QueueKind::Main)?;
//! rec.pass(&lambda_pass)
//!     .read("position", &position)
//!     .write("lambda", &lambda)
//!     .invocations(1024)?;
//! gpu.submit(rec)?.wait()?;
//! # Ok(()) }
//! ```
//!
//! `sim`, `render` and `xr` share one device and none of them owns it; that is
//! why this crate lies beneath all three. Instance and device are created
//! through [`Provider`], so an OpenXR runtime can create them instead of the
//! plain loader.
//!
//! Rules that hold everywhere:
//! - Device requirements are Vulkan 1.3 (dynamic rendering, synchronization2,
//!   timeline semaphores) and `VK_KHR_push_descriptor`.
//! - A handle ([`Buffer`], [`Image`], pipelines) is a cheap clone; resources that a recorder uses live until the device has finished with
//!   them.
//! - Submissions on one queue are ordered; between queues [`Gpu::submit_after`] alone orders them.
//! - Nothing here panics because of a user, file or driver.
// Vulkan is an unsafe interface; every block states why its call is valid.
#![allow(unsafe_code)]

pub mod advice;
mod barrier;
mod device;
mod error;
mod gpu;
mod memory;
mod pipeline;
mod queue;
mod recorder;
mod submission;
mod ticket;

pub use ash;
pub use ash::vk;
pub use bytemuck::NoUninit;

pub use device::{
    BindingLimits, Candidate, Core, DeviceInfo, DeviceRequest, DeviceSummary, EnabledFeatures,
    InstanceRequest, LockWaits, NEEDS, Needs, Options, PlainLoader, Provider, QueueRequest,
    Timestamps, Waits, list_devices,
};
pub use error::GpuError;
pub use gpu::{DeviceHandles, Gpu};
pub use memory::{Buffer, Image, ImageDesc, Sampler, bytes_of_elements};
pub use pipeline::{ComputePipeline, RasterPipeline};
pub use queue::QueueKind;
pub use recorder::{Bundle, CopyRegion, Draw, Pass, Raster, Readback, Recorder};
pub use submission::PassTiming;
pub use ticket::Ticket;
