//! What of OpenXR is there: loader, runtime, extensions; and what is missing,
//! with the remedy.

use std::path::PathBuf;

use openxr::{ApplicationInfo, ExtensionSet, Version};

use crate::entry::entry;

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
    let entry = match entry() {
        Ok(entry) => entry,
        Err(remedy) => {
            found.missing.push(remedy);
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

/// Runtimes of this system's headsets.
#[cfg(windows)]
const RUNTIMES: &str = "SteamVR or Meta Quest Link, and make it the active one in its settings";
#[cfg(not(windows))]
const RUNTIMES: &str = "SteamVR or Monado";

/// A loader without a runtime that answers.
pub(crate) fn no_runtime(error: openxr::sys::Result) -> String {
    match manifest() {
        Some(manifest) => format!(
            "The OpenXR runtime of {} does not answer ({error}): start it, or name another one's \
             file in XR_RUNTIME_JSON.",
            manifest.display()
        ),
        None => format!(
            "No OpenXR runtime is chosen ({error}): install and start your headset's, such as {RUNTIMES}, or name its \
             file in XR_RUNTIME_JSON."
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

/// The file that names the active runtime, by the loader's own rules (OpenXR loader specification, "Desktop active
/// runtime file location").
fn manifest() -> Option<PathBuf> {
    let named = std::env::var_os("XR_RUNTIME_JSON");
    named.map(PathBuf::from).or_else(active_manifest)
}

/// On Windows the registry names it.
#[cfg(windows)]
fn active_manifest() -> Option<PathBuf> {
    let key = windows_registry::LOCAL_MACHINE.open(r"SOFTWARE\Khronos\OpenXR\1");
    let named = key.and_then(|key| key.get_string("ActiveRuntime"));
    named.ok().map(PathBuf::from)
}

/// Elsewhere the first of these files is it.
#[cfg(not(windows))]
fn active_manifest() -> Option<PathBuf> {
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
