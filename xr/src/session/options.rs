//! Options for opening a session.

use std::ffi::CString;

/// Options for opening a session, and for opening it again after a loss.
#[derive(Clone, Debug)]
pub struct OpenXrOptions {
    /// How to open the device; the runtime chooses which one.
    pub gpu: vitriol_gpu::Options,
    /// Further instance extensions, such as those of a window's surface.
    pub instance_extensions: Vec<CString>,
    /// Further device extensions, such as `VK_KHR_swapchain`.
    pub device_extensions: Vec<CString>,
    /// Whether to track the gaze, if the runtime can: some ask the user for permission.
    pub gaze: bool,
    /// Whether to ask for a second pair of pictures, which follows the gaze where the runtime supports that.
    pub inset: bool,
    /// Width and height of the panel, pixels.
    pub panel: [u32; 2],
}
