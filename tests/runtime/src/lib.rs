//! An OpenXR runtime without a headset and without a clock, for tests: a script controls it, and it writes calls to a log. It is strict:
//! it refuses calls that the specification forbids.
//!
//! Tests load it by OpenXR's own loader (`vitriol_tests::mock` has the details) and exchange data with it by two files in the folder that
//! the environment's [`FOLDER`] names: [`script`] is read on at each xrPollEvent, xrGetSystem, xrEnumerateInstanceExtensionProperties,
//! xrCreateInstance and xrWaitFrame, and [`calls`] is written at each call that is of interest. So a test may be in the client's process
//! or in another.
//!
//! Each xrWaitFrame advances the time by one period and sleeps for a millisecond.
// Test code: where the script or the files are wrong, it ends with a message.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
// OpenXR and Vulkan are unsafe interfaces; every block states why its call is valid.
#![allow(unsafe_code)]

mod abi;
mod actions;
pub mod calls;
mod display;
mod events;
mod files;
mod frame;
mod hands;
mod haptics;
mod inputs;
mod instance;
mod layers;
mod number;
mod pictures;
mod pose;
mod profiles;
pub mod script;
mod session;
mod space;
mod state;
mod swapchain;
mod table;
#[cfg(test)]
mod tests;
mod views;
mod vulkan;
mod world;

pub use files::{CALLS, FOLDER, SCRIPT};

use openxr::sys;
use sys::Result as R;

/// The supported version of the loader's interface and of OpenXR.
const INTERFACE: u32 = 1;
const API: sys::Version = sys::Version::new(1, 0, 34);

/// The entry point of OpenXR's loader.
///
/// # Safety
/// As the loader's interface has it: `info` and `request` are structures of their types.
#[unsafe(no_mangle)]
pub unsafe extern "system" fn xrNegotiateLoaderRuntimeInterface(
    info: *const sys::NegotiateLoaderInfo,
    request: *mut sys::NegotiateRuntimeRequest,
) -> R {
    // SAFETY: by this function's own contract.
    let (info, request) = unsafe { (info.as_ref(), request.as_mut()) };
    let (Some(info), Some(request)) = (info, request) else {
        return R::ERROR_INITIALIZATION_FAILED;
    };
    let is_known = info.struct_type == sys::NegotiateLoaderInfo::TYPE
        && request.struct_type == sys::NegotiateRuntimeRequest::TYPE
        && (info.min_interface_version..=info.max_interface_version).contains(&INTERFACE)
        && (info.min_api_version..=info.max_api_version).contains(&API);
    if !is_known {
        return R::ERROR_INITIALIZATION_FAILED;
    }
    request.runtime_interface_version = INTERFACE;
    request.runtime_api_version = API;
    request.get_instance_proc_addr = Some(table::get_instance_proc_addr);
    R::SUCCESS
}
