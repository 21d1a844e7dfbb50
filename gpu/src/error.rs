//! Failures between this program and the device, and their remedies.

use ash::vk;

use crate::advice::{DRIVER, LOADER, VALIDATION};

/// Every failure of this crate; each message names cause and remedy.
#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    /// The Vulkan loader (libvulkan) is not installed.
    #[error("the Vulkan loader cannot be loaded ({cause}); {LOADER}")]
    NoLoader {
        /// The system's message.
        cause: String,
    },
    /// The loader is there, but no driver made an instance.
    #[error("no Vulkan instance can be created ({result}); {DRIVER}")]
    NoInstance {
        /// The loader's result.
        result: vk::Result,
    },
    /// Drivers are there but offer no device.
    #[error("Vulkan offers no device; {DRIVER}")]
    NoDevice,
    /// No device fits `Options::device`.
    #[error(
        "no Vulkan device is named \"{wanted}\"; the devices are: {offered}. Choose by index or part of the name"
    )]
    NoSuchDevice {
        /// The device that was asked for.
        wanted: String,
        /// Index and name of each device.
        offered: String,
    },
    /// The device lacks something that this crate is built on.
    #[error(
        "device \"{device}\" cannot be used: it lacks {missing}; update its driver or choose another device"
    )]
    Unsuitable {
        /// Device name.
        device: String,
        /// What is missing, comma-separated.
        missing: String,
    },
    /// An instance extension that was asked for is not offered.
    #[error("the Vulkan instance lacks {missing}; update the Vulkan loader and the driver")]
    MissingInstanceExtension {
        /// Extension name.
        missing: String,
    },
    /// `Options::validation` without the layer.
    #[error(
        "the Khronos validation layer is not installed; {VALIDATION}, or open the device without validation"
    )]
    NoValidationLayer,
    /// The provider (plain loader, OpenXR runtime) refused.
    #[error("{provider} could not {step}: {cause}")]
    Provider {
        /// Name of the provider.
        provider: String,
        /// The step that it refused.
        step: &'static str,
        /// Cause and remedy in the provider's words.
        cause: String,
    },
    /// Device or host memory is used up.
    #[error(
        "no memory for \"{label}\"{}: {cause}; use fewer particles or a smaller \
         picture, or close other programs that use the device",
        match bytes { Some(bytes) => format!(" ({bytes} bytes)"), None => String::new() }
    )]
    OutOfMemory {
        /// Label of the resource, or the call that failed.
        label: String,
        /// Bytes asked for; `None` of a call whose need of memory only the driver has.
        bytes: Option<u64>,
        /// The allocator's message, or the call's result.
        cause: String,
    },
    /// A buffer is larger than a shader may bind.
    #[error(
        "buffer \"{label}\" of {bytes} bytes is over this device's limit of {limit} bytes for one \
         binding; use fewer particles or another device"
    )]
    BufferTooLarge {
        /// Label of the buffer.
        label: String,
        /// Bytes asked for.
        bytes: u64,
        /// `maxStorageBufferRange` or `maxUniformBufferRange`.
        limit: u64,
    },
    /// An image's size, layers or format are outside what the device has.
    #[error("image \"{label}\" cannot be made: {cause}")]
    ImageUnsupported {
        /// Label of the image.
        label: String,
        /// The property that is not supported.
        cause: String,
    },
    /// A Vulkan call failed for a reason that has no variant of its own.
    #[error(
        "{call} failed: {result}; if it repeats, update the driver and report it with the output of `vitriol doctor`"
    )]
    Vulkan {
        /// The call.
        call: &'static str,
        /// Its result.
        result: vk::Result,
    },
    /// The device stopped answering (hang, reset, driver crash).
    #[error(
        "the device was lost{}; restart the program, and if it repeats, update the driver",
        match last_pass { Some(pass) => format!(" (last pass reached: {pass})"), None => " (open with markers to learn the pass)".to_owned() }
    )]
    DeviceLost {
        /// Label of the last pass that the device reached, when markers are on.
        last_pass: Option<String>,
    },
    /// A bundle contains something that is known within one submission only, or is executed where it cannot be.
    #[error(
        "no bundle can be recorded or executed: {0}; images and readbacks go to the submission's own recorder, and \
         a bundle to the queue that it was recorded for"
    )]
    Bundle(
        /// The content or place that is not allowed.
        String,
    ),
    /// A shader declares something that this crate does not bind.
    #[error("shader \"{shader}\": {cause}")]
    Shader {
        /// Label of the shader.
        shader: String,
        /// What is not supported and what would be.
        cause: String,
    },
    /// A pass names its resources wrongly: unknown, missing, given twice, of
    /// another kind, or read and written against the shader's declaration.
    #[error("pass \"{pass}\", binding \"{binding}\": {cause}")]
    Binding {
        /// Label of the pass.
        pass: String,
        /// Name of the binding.
        binding: String,
        /// What is wrong and what would be right.
        cause: String,
    },
    /// Immediates of the wrong size.
    #[error(
        "pass \"{pass}\": the shader declares {declared} bytes of immediates and was given {given}"
    )]
    Constants {
        /// Label of the pass.
        pass: String,
        /// Bytes of the shader's `var<immediate>`.
        declared: u32,
        /// Bytes given.
        given: usize,
    },
    /// More workgroups than the device dispatches at once.
    #[error(
        "pass \"{pass}\": {groups:?} workgroups are over this device's limit of {limit:?}; use fewer particles or larger workgroups"
    )]
    TooManyWorkgroups {
        /// Label of the pass.
        pass: String,
        /// Workgroups asked for.
        groups: [u32; 3],
        /// `maxComputeWorkGroupCount`.
        limit: [u32; 3],
    },
    /// A raster scope and its draws do not fit each other.
    #[error("raster \"{pass}\": {cause}")]
    Raster {
        /// Label of the scope or draw.
        pass: String,
        /// The property in which they differ.
        cause: String,
    },
    /// A copy, upload or read reaches past a buffer's end or is unaligned.
    #[error("\"{label}\": bytes {offset}..{} are not within its {size} bytes in whole elements", offset + bytes)]
    OutOfRange {
        /// Label of the buffer.
        label: String,
        /// First byte.
        offset: u64,
        /// Number of bytes.
        bytes: u64,
        /// Size of the buffer.
        size: u64,
    },
    /// The host accessed memory that only the device can access.
    #[error(
        "buffer \"{label}\" is not visible to the host; use `read_back` or `upload`, or make it with `Buffer::readback` or `Buffer::staging`"
    )]
    NotHostVisible {
        /// Label of the buffer.
        label: String,
    },
    /// A buffer was used in a way that it was not made for.
    #[error("buffer \"{label}\" was not made for {usage:?}; make it with `Buffer::storage`")]
    WrongBuffer {
        /// Label of the buffer.
        label: String,
        /// The usage that it would need.
        usage: vk::BufferUsageFlags,
    },
    /// A result was asked for before the device had it.
    #[error("the submission is not finished; wait for its ticket first")]
    NotDone,
    /// Source and destination of a copy are one buffer.
    #[error("buffer \"{0}\" is copied to itself; copy through a second buffer")]
    CopyToItself(String),
}

impl GpuError {
    /// For a call that cannot report device loss (creation of objects).
    pub(crate) fn vulkan(call: &'static str) -> impl Fn(vk::Result) -> Self {
        move |result| match result {
            vk::Result::ERROR_DEVICE_LOST => Self::DeviceLost { last_pass: None },
            _ => Self::Vulkan { call, result },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a driver needed is told where it is known, and a size that nobody asked for is not.
    #[test]
    fn a_lack_of_memory_tells_a_size_that_is_known() {
        let message = |bytes| {
            let label = "list".to_owned();
            let cause = "full".to_owned();
            GpuError::OutOfMemory {
                label,
                bytes,
                cause,
            }
            .to_string()
        };
        let known = message(Some(4096));
        assert!(
            known.starts_with("no memory for \"list\" (4096 bytes): full; use"),
            "{known}"
        );
        let unknown = message(None);
        assert!(
            unknown.starts_with("no memory for \"list\": full; use"),
            "{unknown}"
        );
    }
}
