//! What a session is opened with.

use std::ffi::CString;

/// What the session is opened with, and opened with again after a loss.
#[derive(Clone, Debug)]
pub struct OpenXrOptions {
    /// How to open the device; which one it is says the runtime.
    pub gpu: vitriol_gpu::Options,
    /// Further instance extensions, such as those of a window's surface.
    pub instance_extensions: Vec<CString>,
    /// Further device extensions, such as `VK_KHR_swapchain`.
    pub device_extensions: Vec<CString>,
    /// Whether the runtime is asked where the user looks, if it can tell: some ask the user for leave.
    pub gaze: bool,
    /// Whether a second pair of pictures is asked for, which follows the gaze where the runtime lets it.
    pub inset: bool,
    /// Width and height of the panel, pixels.
    pub panel: [u32; 2],
}
