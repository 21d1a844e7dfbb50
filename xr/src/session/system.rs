//! Instance and headset: queries of the runtime before there is a device.

use openxr as xr;

use super::convert::{CallFailure, failed, refused};
use super::views::Views;
use crate::{HeadsetError, probe};

/// Name of the inset, in the warning that the session goes on without it.
pub(super) const INSET: &str = "an inset in each eye's picture (quad views)";

/// Properties of the connected headset, from the runtime.
pub(super) struct ConnectedHeadset {
    pub system: xr::SystemId,
    pub views: Views,
    /// Recommended size of each eye's picture, pixels.
    pub extent: [u32; 2],
    /// Recommended size of each picture of the inset, pixels; `None` without an inset.
    pub inset: Option<[u32; 2]>,
    pub blend: xr::EnvironmentBlendMode,
}

/// OpenXR's loader, where it has a runtime to load.
pub(super) fn entry() -> Result<xr::Entry, HeadsetError> {
    probe::check()?;
    crate::entry::entry().map_err(|remedy| HeadsetError::NoRuntime { remedy })
}

/// An instance with those of our extensions that the runtime offers, those of gaze and inset only where they are asked for. If the runtime
/// then makes none, it is made without those of the inset.
pub(super) fn instance(
    entry: &xr::Entry,
    gaze: bool,
    inset: bool,
) -> Result<xr::Instance, CallFailure> {
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
    wanted.varjo_quad_views = inset && offered.varjo_quad_views;
    // It is of no use without quad views.
    wanted.varjo_foveated_rendering = wanted.varjo_quad_views && offered.varjo_foveated_rendering;
    wanted.ext_hand_interaction = offered.ext_hand_interaction;
    wanted.ext_hand_tracking = offered.ext_hand_tracking;
    wanted.ext_user_presence = offered.ext_user_presence;
    wanted.fb_display_refresh_rate = offered.fb_display_refresh_rate;
    wanted.bd_controller_interaction = offered.bd_controller_interaction;
    let create =
        |wanted: &xr::ExtensionSet| entry.create_instance(&probe::application(), wanted, &[], &());
    let refusal = match create(&wanted) {
        // A runtime that cannot be reached just then returns no extensions.
        Err(answer)
            if wanted.varjo_quad_views && answer != xr::sys::Result::ERROR_RUNTIME_UNAVAILABLE =>
        {
            answer
        }
        made => return made.map_err(absent),
    };
    wanted.varjo_quad_views = false;
    wanted.varjo_foveated_rendering = false;
    let made = create(&wanted).map_err(absent)?;
    // Not `failed`: that takes some codes for a loss, and here the runtime is there.
    refused("xrCreateInstance", refusal.to_string()).do_without(INSET, made)
}

/// The headset of the instance's runtime, with an `inset` if that is wanted and there is one.
pub(super) fn headset(
    instance: &xr::Instance,
    inset: bool,
) -> Result<ConnectedHeadset, CallFailure> {
    let system = instance
        .system(xr::FormFactor::HEAD_MOUNTED_DISPLAY)
        .map_err(|answer| match answer {
            // For now, by the specification: it may be connected or wake at any time.
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
        let wanted = requirements.min_api_version_supported;
        let cause = format!("it wants Vulkan {wanted}, and Vitriol uses 1.3");
        return Err(refused("xrGetVulkanGraphicsRequirements2KHR", cause));
    }
    let views = match inset {
        true => {
            Views::offered(instance, system).or_else(|it| it.do_without(INSET, Views::Stereo))?
        }
        false => Views::Stereo,
    };
    match shape(instance, system, views) {
        Err(refusal) if views != Views::Stereo => {
            refusal.do_without(INSET, ())?;
            shape(instance, system, Views::Stereo)
        }
        shape => shape,
    }
}

/// The headset with those views.
fn shape(
    instance: &xr::Instance,
    system: xr::SystemId,
    views: Views,
) -> Result<ConnectedHeadset, CallFailure> {
    let (extent, inset) = views.extents(instance, system)?;
    let modes = instance
        .enumerate_environment_blend_modes(system, views.kind())
        .map_err(failed("xrEnumerateEnvironmentBlendModes"))?;
    // The first is the runtime's preference; a see-through headset has no opaque mode.
    let opaque = xr::EnvironmentBlendMode::OPAQUE;
    let blend = match modes.contains(&opaque) {
        true => opaque,
        false => modes.first().copied().unwrap_or(opaque),
    };
    Ok(ConnectedHeadset {
        system,
        views,
        extent,
        inset,
        blend,
    })
}

fn none(remedy: String) -> CallFailure {
    CallFailure::Fatal(HeadsetError::NoRuntime { remedy })
}
