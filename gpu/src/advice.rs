//! Where to get missing parts of Vulkan on this system: halves of sentences for messages.

/// Loader and driver of Vulkan.
#[cfg(windows)]
pub const LOADER: &str =
    "install your graphics card's driver from its maker: it brings the loader along";
/// A driver of Vulkan.
#[cfg(windows)]
pub const DRIVER: &str = "install your graphics card's driver from its maker";
/// The layer that checks a program's calls of Vulkan.
#[cfg(windows)]
pub const VALIDATION: &str = "install LunarG's Vulkan SDK";

/// Loader and driver of Vulkan.
#[cfg(not(windows))]
pub const LOADER: &str = "install it (Debian: package libvulkan1), and a driver: your graphics card's, or the software one \
                          (Debian: mesa-vulkan-drivers)";
/// A driver of Vulkan.
#[cfg(not(windows))]
pub const DRIVER: &str = "install a driver: your graphics card's, or the software one (Debian: package mesa-vulkan-drivers)";
/// The layer that checks a program's calls of Vulkan.
#[cfg(not(windows))]
pub const VALIDATION: &str = "install it (Debian: package vulkan-validationlayers)";
