//! The names of the entry points.

use std::ffi::c_char;

use openxr::sys;
use sys::pfn::VoidFunction;
use sys::{Handle as _, Result as R};

use crate::abi::Text;
use crate::state::locked;
use crate::{
    actions, display, events, frame, hands, haptics, inputs, instance, session, space, swapchain,
    views, vulkan,
};

/// The function of that name and the extension that it belongs to, if any.
macro_rules! table {
    ($name:expr, $($entry:literal $extension:literal $function:path;)*) => {
        match $name {
            // SAFETY: both are function pointers; the loader casts it back by the name.
            $($entry => Some(($extension, unsafe {
                std::mem::transmute::<*const (), VoidFunction>($function as *const ())
            })),)*
            _ => None,
        }
    };
}

fn find(name: &str) -> Option<(&'static str, VoidFunction)> {
    table!(name,
        "xrGetInstanceProcAddr" "" get_instance_proc_addr;
        "xrEnumerateApiLayerProperties" "" instance::enumerate_api_layer_properties;
        "xrEnumerateInstanceExtensionProperties" "" instance::enumerate_instance_extension_properties;
        "xrCreateInstance" "" instance::create_instance;
        "xrDestroyInstance" "" instance::destroy_instance;
        "xrGetInstanceProperties" "" instance::get_instance_properties;
        "xrPollEvent" "" events::poll_event;
        "xrResultToString" "" instance::result_to_string;
        "xrStructureTypeToString" "" instance::structure_type_to_string;
        "xrGetSystem" "" instance::get_system;
        "xrGetSystemProperties" "" instance::get_system_properties;
        "xrEnumerateEnvironmentBlendModes" "" instance::enumerate_environment_blend_modes;
        "xrCreateSession" "" session::create_session;
        "xrDestroySession" "" session::destroy_session;
        "xrEnumerateReferenceSpaces" "" space::enumerate_reference_spaces;
        "xrCreateReferenceSpace" "" space::create_reference_space;
        "xrGetReferenceSpaceBoundsRect" "" space::get_reference_space_bounds_rect;
        "xrCreateActionSpace" "" space::create_action_space;
        "xrLocateSpace" "" space::locate_space;
        "xrDestroySpace" "" space::destroy_space;
        "xrEnumerateViewConfigurations" "" views::enumerate_view_configurations;
        "xrGetViewConfigurationProperties" "" views::get_view_configuration_properties;
        "xrEnumerateViewConfigurationViews" "" views::enumerate_view_configuration_views;
        "xrEnumerateSwapchainFormats" "" swapchain::enumerate_swapchain_formats;
        "xrCreateSwapchain" "" swapchain::create_swapchain;
        "xrDestroySwapchain" "" swapchain::destroy_swapchain;
        "xrEnumerateSwapchainImages" "" swapchain::enumerate_swapchain_images;
        "xrAcquireSwapchainImage" "" swapchain::acquire_swapchain_image;
        "xrWaitSwapchainImage" "" swapchain::wait_swapchain_image;
        "xrReleaseSwapchainImage" "" swapchain::release_swapchain_image;
        "xrBeginSession" "" session::begin_session;
        "xrEndSession" "" session::end_session;
        "xrRequestExitSession" "" session::request_exit_session;
        "xrWaitFrame" "" frame::wait_frame;
        "xrBeginFrame" "" frame::begin_frame;
        "xrEndFrame" "" frame::end_frame;
        "xrLocateViews" "" views::locate_views;
        "xrStringToPath" "" instance::string_to_path;
        "xrPathToString" "" instance::path_to_string;
        "xrCreateActionSet" "" actions::create_action_set;
        "xrDestroyActionSet" "" actions::destroy_action_set;
        "xrCreateAction" "" actions::create_action;
        "xrDestroyAction" "" actions::destroy_action;
        "xrSuggestInteractionProfileBindings" "" actions::suggest_interaction_profile_bindings;
        "xrAttachSessionActionSets" "" actions::attach_session_action_sets;
        "xrGetCurrentInteractionProfile" "" actions::get_current_interaction_profile;
        "xrGetActionStateBoolean" "" inputs::get_action_state_boolean;
        "xrGetActionStateFloat" "" inputs::get_action_state_float;
        "xrGetActionStateVector2f" "" inputs::get_action_state_vector2f;
        "xrGetActionStatePose" "" inputs::get_action_state_pose;
        "xrSyncActions" "" actions::sync_actions;
        "xrEnumerateBoundSourcesForAction" "" inputs::enumerate_bound_sources_for_action;
        "xrGetInputSourceLocalizedName" "" inputs::get_input_source_localized_name;
        "xrApplyHapticFeedback" "" haptics::apply_haptic_feedback;
        "xrStopHapticFeedback" "" haptics::stop_haptic_feedback;
        "xrGetVulkanGraphicsRequirements2KHR" "XR_KHR_vulkan_enable2" vulkan::get_graphics_requirements;
        "xrCreateVulkanInstanceKHR" "XR_KHR_vulkan_enable2" vulkan::create_vulkan_instance;
        "xrCreateVulkanDeviceKHR" "XR_KHR_vulkan_enable2" vulkan::create_vulkan_device;
        "xrGetVulkanGraphicsDevice2KHR" "XR_KHR_vulkan_enable2" vulkan::get_vulkan_graphics_device;
        "xrGetVisibilityMaskKHR" "XR_KHR_visibility_mask" display::get_visibility_mask;
        "xrCreateHandTrackerEXT" "XR_EXT_hand_tracking" hands::create_hand_tracker;
        "xrDestroyHandTrackerEXT" "XR_EXT_hand_tracking" hands::destroy_hand_tracker;
        "xrLocateHandJointsEXT" "XR_EXT_hand_tracking" hands::locate_hand_joints;
        "xrEnumerateDisplayRefreshRatesFB" "XR_FB_display_refresh_rate" display::enumerate_display_refresh_rates;
        "xrGetDisplayRefreshRateFB" "XR_FB_display_refresh_rate" display::get_display_refresh_rate;
        "xrRequestDisplayRefreshRateFB" "XR_FB_display_refresh_rate" display::request_display_refresh_rate;
    )
}

/// Functions that can be queried without an instance.
const GLOBAL: [&str; 3] = [
    "xrEnumerateInstanceExtensionProperties",
    "xrEnumerateApiLayerProperties",
    "xrCreateInstance",
];

/// xrGetInstanceProcAddr
///
/// # Safety
/// As OpenXR requires: `name` is a string, and `function` may be written to.
pub(crate) unsafe extern "system" fn get_instance_proc_addr(
    instance: sys::Instance,
    name: *const c_char,
    function: *mut Option<VoidFunction>,
) -> R {
    // SAFETY: a `Text` is a pointer to a string, and a reference or `None` a pointer or null.
    let (name, function) = unsafe {
        (
            std::mem::transmute::<*const c_char, Text>(name),
            function.as_mut(),
        )
    };
    let (Ok(name), Some(function)) = (name.read(), function) else {
        return R::ERROR_VALIDATION_FAILURE;
    };
    *function = None;
    if instance == sys::Instance::NULL && !GLOBAL.contains(&name.as_str()) {
        return R::ERROR_HANDLE_INVALID;
    }
    let found = find(&name).filter(|(extension, _)| {
        let on = |state: &mut crate::state::State| {
            let held = state.instances.get(&instance.into_raw());
            held.is_some_and(|held| held.extensions.iter().any(|on| on == extension))
        };
        extension.is_empty() || locked(on)
    });
    match found {
        Some((_, found)) => {
            *function = Some(found);
            R::SUCCESS
        }
        None => R::ERROR_FUNCTION_UNSUPPORTED,
    }
}
