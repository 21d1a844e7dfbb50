//! Options for opening a device.

use std::path::PathBuf;

/// Work that the device's clock measures; see [`Ticket::timings`](crate::Ticket::timings).
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
    /// Work that is measured by the device's clock.
    pub timestamps: Timestamps,
    /// Marks each pass as the device reaches it, so that
    /// [`GpuError::DeviceLost`](crate::GpuError::DeviceLost) can name the last one.
    pub markers: bool,
    /// Folder in which compiled pipelines are kept for the next run; `None` keeps none.
    pub pipelines: Option<PathBuf>,
}

impl Options {
    /// Whether each pass has a marker or a time of its own: a [`Bundle`](crate::Bundle) would hide them.
    pub fn tells_passes(&self) -> bool {
        self.markers || self.timestamps == Timestamps::Passes
    }
}
