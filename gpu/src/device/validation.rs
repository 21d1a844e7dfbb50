//! Messages of the validation layer: traced and collected.

use std::ffi::{CStr, c_void};
use std::sync::{Arc, Mutex};

use ash::vk;

use super::lock::lock;

/// Name of the Khronos layer.
pub(crate) const LAYER: &CStr = c"VK_LAYER_KHRONOS_validation";

/// Where messages go; shared with the callback.
#[derive(Clone, Default)]
pub(crate) struct Messages(Arc<Mutex<Vec<String>>>);

impl Messages {
    pub(crate) fn list(&self) -> Vec<String> {
        lock(&self.0).clone()
    }

    pub(crate) fn take(&self) -> Vec<String> {
        std::mem::take(&mut *lock(&self.0))
    }

    /// Create info whose callback writes here; `self` must outlive the
    /// messenger.
    pub(crate) fn create_info(&self) -> vk::DebugUtilsMessengerCreateInfoEXT<'static> {
        vk::DebugUtilsMessengerCreateInfoEXT::default()
            .message_severity(
                vk::DebugUtilsMessageSeverityFlagsEXT::WARNING
                    | vk::DebugUtilsMessageSeverityFlagsEXT::ERROR,
            )
            // Not GENERAL: that is the loader talking about other drivers.
            .message_type(vk::DebugUtilsMessageTypeFlagsEXT::VALIDATION)
            .pfn_user_callback(Some(callback))
            .user_data(Arc::as_ptr(&self.0).cast_mut().cast())
    }
}

/// SAFETY contract of the type: the layer calls it with valid data and the
/// `user_data` of `create_info`.
unsafe extern "system" fn callback(
    severity: vk::DebugUtilsMessageSeverityFlagsEXT,
    _kind: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    user_data: *mut c_void,
) -> vk::Bool32 {
    // SAFETY: the layer passes valid data or null, and a message that is
    // null-terminated or null.
    let message = unsafe {
        data.as_ref()
            .filter(|data| !data.p_message.is_null())
            .map(|data| {
                CStr::from_ptr(data.p_message)
                    .to_string_lossy()
                    .into_owned()
            })
    };
    // SAFETY: `user_data` points into the `Messages` that outlives the
    // messenger, and is only read through the mutex.
    let list = unsafe { user_data.cast::<Mutex<Vec<String>>>().as_ref() };
    if let (Some(message), Some(list)) = (message, list) {
        if severity.contains(vk::DebugUtilsMessageSeverityFlagsEXT::ERROR) {
            tracing::error!(target: "vitriol_gpu::validation", "{message}");
        } else {
            tracing::warn!(target: "vitriol_gpu::validation", "{message}");
        }
        lock(list).push(message);
    }
    vk::FALSE
}
