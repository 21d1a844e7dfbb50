//! Instances, the headset, and queries of both.

use std::ffi::c_char;

use openxr::sys;
use serde_json::json;
use sys::{Handle as _, Result as R};

use crate::abi::{
    Answer, Buffer, Text, fill, fill_text, fill_with, given, list, place, put_text, text_of,
};
use crate::state::{Instance, State, call, locked, told};

/// The one headset.
pub(crate) const SYSTEM: u64 = 1;
/// Greatest width and height of a swapchain's images.
pub(crate) const LARGEST: u32 = 4096;
/// Most layers of a frame.
pub(crate) const LAYERS: u32 = 16;
/// The runtime's name.
const NAME: &str = "Mock";

impl State {
    /// Checks that the instance is valid and the system is the headset.
    pub(crate) fn system(
        &mut self,
        instance: sys::Instance,
        system: sys::SystemId,
    ) -> Result<&mut Instance, R> {
        let instance = self.instance(instance)?;
        match system.into_raw() == SYSTEM {
            true => Ok(instance),
            false => Err(R::ERROR_SYSTEM_INVALID),
        }
    }
}

pub(crate) extern "system" fn enumerate_api_layer_properties(
    capacity: u32,
    count: Option<&mut u32>,
    layers: Buffer<sys::ApiLayerProperties>,
) -> R {
    fill(capacity, count, &layers, 0, |_, _| {}).unwrap_or_else(|answer| answer)
}

pub(crate) extern "system" fn enumerate_instance_extension_properties(
    layer: *const c_char,
    capacity: u32,
    count: Option<&mut u32>,
    properties: Buffer<sys::ExtensionProperties>,
) -> R {
    call("xrEnumerateInstanceExtensionProperties", |state| {
        state.listen();
        if !layer.is_null() {
            return Err(R::ERROR_API_LAYER_NOT_PRESENT);
        }
        let names = &state.world.extensions;
        fill(capacity, count, &properties, names.len(), |index, slot| {
            put_text(&mut slot.extension_name, &names[index]);
            slot.extension_version = 1;
        })
    })
}

pub(crate) extern "system" fn create_instance(
    info: Option<&sys::InstanceCreateInfo>,
    instance: Option<&mut sys::Instance>,
) -> R {
    locked(State::listen);
    let names = info.map(extensions).unwrap_or_default();
    let create = |state: &mut State, with: &mut serde_json::Value| {
        let info = given!(info, sys::InstanceCreateInfo);
        let version = info.application_info.api_version;
        if (version.major(), version.minor()) != (1, 0) {
            return Err(R::ERROR_API_VERSION_UNSUPPORTED);
        }
        let name = text_of(&info.application_info.application_name);
        if name.is_empty() {
            return Err(R::ERROR_NAME_INVALID);
        }
        with["application"] = json!(name);
        let offered = |name: &String| state.world.extensions.contains(name);
        if !names.iter().all(offered) {
            return Err(R::ERROR_EXTENSION_NOT_PRESENT);
        }
        let raw = state.handle();
        let made = Instance {
            extensions: names.clone(),
            ..Instance::default()
        };
        state.instances.insert(raw, made);
        with["instance"] = json!(raw);
        *place!(instance) = sys::Instance::from_raw(raw);
        Ok(R::SUCCESS)
    };
    let with = json!({ "extensions": names });
    locked(|state| state.told("xrCreateInstance", with, &names, create))
}

fn extensions(info: &sys::InstanceCreateInfo) -> Vec<String> {
    // SAFETY: OpenXR's callers pass an array of so many names.
    let names = unsafe {
        list(
            info.enabled_extension_count,
            info.enabled_extension_names.cast(),
        )
    };
    let names: &[Text] = names.unwrap_or_default();
    names.iter().filter_map(|name| name.read().ok()).collect()
}

pub(crate) extern "system" fn destroy_instance(instance: sys::Instance) -> R {
    told(
        "xrDestroyInstance",
        json!({ "instance": instance.into_raw() }),
        |state, _| {
            let raw = instance.into_raw();
            state
                .instances
                .remove(&raw)
                .ok_or(R::ERROR_HANDLE_INVALID)?;
            let sessions = state.sessions.iter().filter(|(_, s)| s.instance == raw);
            let sessions: Vec<u64> = sessions.map(|(&session, _)| session).collect();
            for session in sessions {
                state.drop_session(session);
            }
            state.sets.retain(|_, set| set.instance != raw);
            let sets = &state.sets;
            state
                .actions
                .retain(|_, action| sets.contains_key(&action.set));
            Ok(R::SUCCESS)
        },
    )
}

pub(crate) extern "system" fn get_instance_properties(
    instance: sys::Instance,
    properties: Option<&mut sys::InstanceProperties>,
) -> R {
    call("xrGetInstanceProperties", |state| {
        state.instance(instance)?;
        let properties = given!(properties, sys::InstanceProperties);
        properties.runtime_version = sys::Version::new(1, 2, 3);
        put_text(&mut properties.runtime_name, NAME);
        Ok(R::SUCCESS)
    })
}

/// Writes a constant's name into a field of the caller.
fn put_name<const N: usize>(
    state: &mut State,
    instance: sys::Instance,
    buffer: Option<&mut [c_char; N]>,
    name: &str,
) -> Answer {
    state.instance(instance)?;
    let name: String = name.chars().take(N - 1).collect();
    put_text(place!(buffer), &name);
    Ok(R::SUCCESS)
}

pub(crate) extern "system" fn result_to_string(
    instance: sys::Instance,
    value: R,
    buffer: Option<&mut [c_char; sys::MAX_RESULT_STRING_SIZE]>,
) -> R {
    call("xrResultToString", |state| {
        put_name(state, instance, buffer, &format!("XR_{value:?}"))
    })
}

pub(crate) extern "system" fn structure_type_to_string(
    instance: sys::Instance,
    value: sys::StructureType,
    buffer: Option<&mut [c_char; sys::MAX_STRUCTURE_NAME_SIZE]>,
) -> R {
    call("xrStructureTypeToString", |state| {
        put_name(state, instance, buffer, &format!("XR_TYPE_{value:?}"))
    })
}

pub(crate) extern "system" fn get_system(
    instance: sys::Instance,
    info: Option<&sys::SystemGetInfo>,
    system: Option<&mut sys::SystemId>,
) -> R {
    locked(State::listen);
    told("xrGetSystem", json!({}), |state, _| {
        state.instance(instance)?;
        let info = given!(info, sys::SystemGetInfo);
        if info.form_factor != sys::FormFactor::HEAD_MOUNTED_DISPLAY {
            return Err(R::ERROR_FORM_FACTOR_UNSUPPORTED);
        }
        if !state.world.connected {
            return Err(R::ERROR_FORM_FACTOR_UNAVAILABLE);
        }
        *place!(system) = sys::SystemId::from_raw(SYSTEM);
        Ok(R::SUCCESS)
    })
}

pub(crate) extern "system" fn get_system_properties(
    instance: sys::Instance,
    system: sys::SystemId,
    properties: Option<&mut sys::SystemProperties>,
) -> R {
    call("xrGetSystemProperties", |state| {
        state.system(instance, system)?;
        let properties = given!(properties, sys::SystemProperties);
        properties.system_id = system;
        properties.vendor_id = 0;
        put_text(&mut properties.system_name, NAME);
        properties.graphics_properties = sys::SystemGraphicsProperties {
            max_swapchain_image_height: LARGEST,
            max_swapchain_image_width: LARGEST,
            max_layer_count: LAYERS,
        };
        properties.tracking_properties = sys::SystemTrackingProperties {
            orientation_tracking: sys::TRUE,
            position_tracking: sys::TRUE,
        };
        let mut next = properties.next.cast::<sys::BaseOutStructure>();
        while !next.is_null() {
            // SAFETY: OpenXR's callers chain structures, which all begin like this one.
            let (ty, after) = unsafe { ((*next).ty, (*next).next) };
            if ty == sys::SystemHandTrackingPropertiesEXT::TYPE {
                // SAFETY: by its type it is this structure.
                let tracking = unsafe { &mut *next.cast::<sys::SystemHandTrackingPropertiesEXT>() };
                tracking.supports_hand_tracking = sys::TRUE;
            } else if ty == sys::SystemUserPresencePropertiesEXT::TYPE {
                // SAFETY: by its type it is this structure.
                let presence = unsafe { &mut *next.cast::<sys::SystemUserPresencePropertiesEXT>() };
                presence.supports_user_presence = sys::TRUE;
            } else if ty == sys::SystemFoveatedRenderingPropertiesVARJO::TYPE {
                type Foveated = sys::SystemFoveatedRenderingPropertiesVARJO;
                // SAFETY: by its type it is this structure.
                let foveated = unsafe { &mut *next.cast::<Foveated>() };
                foveated.supports_foveated_rendering = state.world.inset.follows.into();
            }
            next = after;
        }
        Ok(R::SUCCESS)
    })
}

pub(crate) extern "system" fn enumerate_environment_blend_modes(
    instance: sys::Instance,
    system: sys::SystemId,
    views: sys::ViewConfigurationType,
    capacity: u32,
    count: Option<&mut u32>,
    modes: Buffer<sys::EnvironmentBlendMode>,
) -> R {
    call("xrEnumerateEnvironmentBlendModes", |state| {
        state.system(instance, system)?;
        state.instance_offers(instance, views)?;
        let offered = state.world.blends.iter();
        let offered: Vec<_> = offered
            .map(|&raw| sys::EnvironmentBlendMode::from_raw(raw))
            .collect();
        fill_with(capacity, count, &modes, &offered)
    })
}

pub(crate) extern "system" fn string_to_path(
    instance: sys::Instance,
    text: Text,
    path: Option<&mut sys::Path>,
) -> R {
    call("xrStringToPath", |state| {
        state.instance(instance)?;
        let text = text.read()?;
        let known = |byte: u8| {
            byte.is_ascii_lowercase() || byte.is_ascii_digit() || b"-_./".contains(&byte)
        };
        let is_formed = text.starts_with('/')
            && text.len() < sys::MAX_PATH_LENGTH
            && text.bytes().all(known)
            && text[1..]
                .split('/')
                .all(|part| part.bytes().any(|byte| byte != b'.'));
        if !is_formed {
            return Err(R::ERROR_PATH_FORMAT_INVALID);
        }
        *place!(path) = state.path_of(&text);
        Ok(R::SUCCESS)
    })
}

pub(crate) extern "system" fn path_to_string(
    instance: sys::Instance,
    path: sys::Path,
    capacity: u32,
    count: Option<&mut u32>,
    buffer: Buffer<c_char>,
) -> R {
    call("xrPathToString", |state| {
        state.instance(instance)?;
        let text = state.path(path).ok_or(R::ERROR_PATH_INVALID)?;
        fill_text(capacity, count, &buffer, text)
    })
}
