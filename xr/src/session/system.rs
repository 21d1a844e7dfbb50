//! Instance and headset: what is asked of the runtime before there is a device.

use openxr as xr;

use super::convert::{CallFailure, failed};
use crate::{HeadsetError, probe};

pub(super) const STEREO: xr::ViewConfigurationType = xr::ViewConfigurationType::PRIMARY_STEREO;

/// What the runtime says of the headset that is connected.
pub(super) struct ConnectedHeadset {
    pub system: xr::SystemId,
    /// Recommended size of each eye's picture, pixels.
    pub extent: [u32; 2],
    pub blend: xr::EnvironmentBlendMode,
}

/// OpenXR's loader.
pub(super) fn entry() -> Result<xr::Entry, HeadsetError> {
    crate::entry::entry().map_err(|remedy| HeadsetError::NoRuntime { remedy })
}

/// An instance with the extensions of ours that the runtime offers, that of the `gaze` only where it is asked for.
pub(super) fn instance(entry: &xr::Entry, gaze: bool) -> Result<xr::Instance, CallFailure> {
    let absent = |error| none(probe::no_runtime(error));
    let offered = entry.enumerate_extensions().map_err(absent)?;
    if !offered.khr_vulkan_enable2 {
        return Err(none(probe::no_vulkan(entry)));
    }
    let mut wanted = xr::ExtensionSet::default();
    wanted.khr_vulkan_enable2 = true;
    wanted.khr_composition_layer_depth = offered.khr_composition_layer_depth;
    wanted.khr_visibility_mask = offered.khr_visibility_mask;
    wanted.ext_local_floor = offered.ext_local_floor;
    wanted.ext_eye_gaze_interaction = gaze && offered.ext_eye_gaze_interaction;
    wanted.ext_hand_interaction = offered.ext_hand_interaction;
    wanted.ext_hand_tracking = offered.ext_hand_tracking;
    wanted.ext_user_presence = offered.ext_user_presence;
    wanted.fb_display_refresh_rate = offered.fb_display_refresh_rate;
    wanted.bd_controller_interaction = offered.bd_controller_interaction;
    entry
        .create_instance(&probe::application(), &wanted, &[], &())
        .map_err(absent)
}

/// The headset of the instance's runtime.
pub(super) fn headset(instance: &xr::Instance) -> Result<ConnectedHeadset, CallFailure> {
    let system = instance
        .system(xr::FormFactor::HEAD_MOUNTED_DISPLAY)
        .map_err(|answer| match answer {
            // For now, as the specification says: it may be connected or wake at any time.
            xr::sys::Result::ERROR_FORM_FACTOR_UNAVAILABLE => {
                CallFailure::Fatal(HeadsetError::Asleep {
                    remedy:
                        "The OpenXR runtime runs, but finds no headset: connect it, switch it on \
                             and put it on."
                            .to_owned(),
                })
            }
            xr::sys::Result::ERROR_FORM_FACTOR_UNSUPPORTED => none(
                "The OpenXR runtime runs, but is not one for headsets: choose your headset's, or \
                 name its file in XR_RUNTIME_JSON."
                    .to_owned(),
            ),
            answer => failed("xrGetSystem")(answer),
        })?;
    let requirements = instance
        .graphics_requirements::<xr::Vulkan>(system)
        .map_err(failed("xrGetVulkanGraphicsRequirements2KHR"))?;
    if requirements.min_api_version_supported > xr::Version::new(1, 3, 0) {
        return Err(CallFailure::Fatal(HeadsetError::Refused {
            call: "xrGetVulkanGraphicsRequirements2KHR",
            cause: format!(
                "it wants Vulkan {}, and Vitriol uses 1.3",
                requirements.min_api_version_supported
            ),
        }));
    }
    let views = instance
        .enumerate_view_configuration_views(system, STEREO)
        .map_err(failed("xrEnumerateViewConfigurationViews"))?;
    let [left, right] = views[..] else {
        return Err(CallFailure::Fatal(HeadsetError::Refused {
            call: "xrEnumerateViewConfigurationViews",
            cause: format!("stereo has {} views", views.len()),
        }));
    };
    // One image with a layer for each eye: as large as the larger one, within both limits.
    let size = |a: u32, b: u32, limit_a: u32, limit_b: u32| a.max(b).min(limit_a).min(limit_b);
    let extent = [
        size(
            left.recommended_image_rect_width,
            right.recommended_image_rect_width,
            left.max_image_rect_width,
            right.max_image_rect_width,
        ),
        size(
            left.recommended_image_rect_height,
            right.recommended_image_rect_height,
            left.max_image_rect_height,
            right.max_image_rect_height,
        ),
    ];
    let modes = instance
        .enumerate_environment_blend_modes(system, STEREO)
        .map_err(failed("xrEnumerateEnvironmentBlendModes"))?;
    // The first is the runtime's preference; a see-through headset has no opaque mode.
    let opaque = xr::EnvironmentBlendMode::OPAQUE;
    let blend = match modes.contains(&opaque) {
        true => opaque,
        false => modes.first().copied().unwrap_or(opaque),
    };
    Ok(ConnectedHeadset {
        system,
        extent,
        blend,
    })
}

fn none(remedy: String) -> CallFailure {
    CallFailure::Fatal(HeadsetError::NoRuntime { remedy })
}
