//! What of OpenXR is there: loader, runtime, extensions; and what is missing,
//! with the remedy.

// Loading the loader runs foreign code; the one block states why that is valid.
#![allow(unsafe_code)]

use std::path::PathBuf;

use openxr::{ApplicationInfo, Entry, ExtensionSet, Version};

/// What a look at OpenXR found.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Probe {
    /// The loader could be loaded.
    pub loader: bool,
    /// The file that names the runtime, where the loader is told by one.
    pub manifest: Option<PathBuf>,
    /// Name and version of the runtime that answered.
    pub runtime: Option<String>,
    /// Wanted extensions and whether the runtime offers them; the first one is
    /// needed, the others are used where they are offered.
    pub extensions: Vec<(&'static str, bool)>,
    /// What is missing, each in a sentence with its remedy.
    pub missing: Vec<String>,
}

/// Looks for loader and runtime. It makes an instance and destroys it; no
/// session and no device.
pub fn probe() -> Probe {
    let mut found = Probe {
        manifest: manifest(),
        ..Probe::default()
    };
    // SAFETY: the library of that name in the system's search path is the
    // Khronos loader, as for every OpenXR program; the entry is not used after
    // it is dropped.
    let entry = match unsafe { Entry::load(&()) } {
        Ok(entry) => entry,
        Err(error) => {
            found.missing.push(no_loader(&error));
            return found;
        }
    };
    found.loader = true;
    let offered = match entry.enumerate_extensions() {
        Ok(offered) => offered,
        Err(error) => {
            found.missing.push(no_runtime(error));
            return found;
        }
    };
    found.extensions = wanted(&offered);
    let instance = entry.create_instance(&application(), &ExtensionSet::default(), &[], &());
    match instance.and_then(|instance| instance.properties()) {
        Ok(properties) => {
            found.runtime = Some(format!(
                "{} {}",
                properties.runtime_name, properties.runtime_version
            ));
        }
        Err(error) => found.missing.push(no_runtime(error)),
    }
    if !offered.khr_vulkan_enable2 {
        found.missing.push(NO_VULKAN.to_owned());
    }
    found
}

/// What the program tells a runtime of itself.
pub(crate) fn application() -> ApplicationInfo<'static> {
    ApplicationInfo {
        application_name: "vitriol",
        application_version: 0,
        engine_name: "vitriol",
        engine_version: 0,
        // The loader of Debian 12 refuses API 1.1.
        api_version: Version::new(1, 0, 0),
    }
}

/// A runtime without the extension that everything is built on.
pub(crate) const NO_VULKAN: &str = "The OpenXR runtime lacks XR_KHR_vulkan_enable2: update it, or \
                                    choose another runtime in XR_RUNTIME_JSON.";

/// A machine without the loader.
pub(crate) fn no_loader(error: &openxr::EntryError) -> String {
    format!(
        "The OpenXR loader cannot be loaded ({error}): install it (Debian: package \
         libopenxr-loader1) to use a headset."
    )
}

/// A loader without a runtime that answers.
pub(crate) fn no_runtime(error: openxr::sys::Result) -> String {
    match manifest() {
        Some(manifest) => format!(
            "The OpenXR runtime of {} does not answer ({error}): start it, or name another one's \
             file in XR_RUNTIME_JSON.",
            manifest.display()
        ),
        None => format!(
            "No OpenXR runtime is chosen ({error}): install and start your headset's, such as \
             SteamVR or Monado, or name its file in XR_RUNTIME_JSON."
        ),
    }
}

fn wanted(offered: &ExtensionSet) -> Vec<(&'static str, bool)> {
    vec![
        ("XR_KHR_vulkan_enable2", offered.khr_vulkan_enable2),
        (
            "XR_KHR_composition_layer_depth",
            offered.khr_composition_layer_depth,
        ),
        ("XR_KHR_visibility_mask", offered.khr_visibility_mask),
        ("XR_EXT_local_floor", offered.ext_local_floor),
        ("XR_EXT_hand_interaction", offered.ext_hand_interaction),
        ("XR_EXT_hand_tracking", offered.ext_hand_tracking),
        ("XR_EXT_user_presence", offered.ext_user_presence),
        (
            "XR_FB_display_refresh_rate",
            offered.fb_display_refresh_rate,
        ),
        (
            "XR_BD_controller_interaction",
            offered.bd_controller_interaction,
        ),
    ]
}

/// The file that names the active runtime, by the loader's own rules on Linux
/// (OpenXR loader specification, "Desktop active runtime file location"); on
/// Windows the registry names it, and only the variable is looked at.
fn manifest() -> Option<PathBuf> {
    if let Some(path) = std::env::var_os("XR_RUNTIME_JSON") {
        return Some(path.into());
    }
    let variable = |name: &str| std::env::var_os(name).map(PathBuf::from);
    let user = variable("XDG_CONFIG_HOME").or_else(|| Some(variable("HOME")?.join(".config")));
    let system = [
        PathBuf::from("/etc/xdg"),
        PathBuf::from("/usr/local/etc"),
        PathBuf::from("/etc"),
    ];
    user.into_iter()
        .chain(system)
        .map(|folder| folder.join("openxr/1/active_runtime.json"))
        .find(|path| path.exists())
}
