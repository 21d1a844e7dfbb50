//! How a device is opened.

use std::path::PathBuf;

/// What the device's clock is read for; see [`Ticket::timings`](crate::Ticket::timings).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Timestamps {
    /// Nothing.
    #[default]
    None,
    /// Each submission as a whole: two stamps, which cost 0.04 of 13 ms on the software driver.
    Whole,
    /// Every pass; costs 2 to 5 ms a frame there.
    Passes,
}

/// How to open the device.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Index or part of the name of the device; the best one when absent:
    /// discrete before integrated before virtual before CPU.
    pub device: Option<String>,
    /// Loads the Khronos validation layer with synchronisation validation;
    /// see [`Gpu::validation_messages`](crate::Gpu::validation_messages).
    pub validation: bool,
    /// What is measured by the device's clock.
    pub timestamps: Timestamps,
    /// Marks each pass as the device reaches it, so that
    /// [`GpuError::DeviceLost`](crate::GpuError::DeviceLost) can name the last one.
    pub markers: bool,
    /// Folder in which compiled pipelines are kept for the next run; none are without one.
    pub pipelines: Option<PathBuf>,
}

impl Options {
    /// Whether something is told of each pass: then a [`Bundle`](crate::Bundle) hides what is asked for.
    pub fn tells_passes(&self) -> bool {
        self.markers || self.timestamps == Timestamps::Passes
    }
}
