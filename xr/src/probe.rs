//! Which parts of OpenXR are installed: loader, runtime, extensions; and what is missing, with the remedy.

use std::path::PathBuf;

use openxr::{ApplicationInfo, Entry, ExtensionSet, Version};

use crate::HeadsetError;
use crate::entry::entry;
use crate::manifest::{self, ManifestError, RUNTIMES};

/// Result of [`probe`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Probe {
    /// Whether the loader could be loaded.
    pub loader: bool,
    /// The file that names the runtime, where the loader uses one.
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
    let (chosen, entry) = (manifest::check(), entry());
    let mut found = Probe {
        loader: entry.is_ok(),
        manifest: manifest::find(),
        ..Probe::default()
    };
    found.missing.extend(chosen.err().map(|it| it.to_string()));
    let entry = match entry {
        Ok(entry) if found.missing.is_empty() => entry,
        entry => {
            found.missing.extend(entry.err());
            return found;
        }
    };
    let offered = match entry.enumerate_extensions() {
        Ok(offered) => offered,
        Err(error) => {
            found.missing.push(no_runtime(error));
            return found;
        }
    };
    found.extensions = wanted(&offered);
    match name_of(&entry) {
        Ok(name) => found.runtime = Some(name),
        Err(error) => found.missing.push(no_runtime(error)),
    }
    if !offered.khr_vulkan_enable2 {
        found.missing.push(no_vulkan(&entry));
    }
    found
}

/// Whether a runtime is chosen, and its file leads to a library that is one. The loader is not asked, and the runtime may still be off.
///
/// # Errors
/// [`HeadsetError::NoRuntime`] with the remedy.
pub fn check() -> Result<(), HeadsetError> {
    let none = |error: ManifestError| HeadsetError::NoRuntime {
        remedy: error.to_string(),
    };
    manifest::check().map_err(none)
}

/// Name and version of the runtime.
fn name_of(entry: &Entry) -> Result<String, openxr::sys::Result> {
    let instance = entry.create_instance(&application(), &ExtensionSet::default(), &[], &());
    let properties = instance.and_then(|instance| instance.properties())?;
    Ok(format!(
        "{} {}",
        properties.runtime_name, properties.runtime_version
    ))
}

/// The application's name and version, as a runtime gets them.
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

/// Message for a runtime without the extension that everything is built on, such as Microsoft's own: which other to choose.
pub(crate) fn no_vulkan(entry: &Entry) -> String {
    let name = name_of(entry).unwrap_or_else(|_| "of no name".to_owned());
    let others = others();
    let choose = match others.is_empty() {
        true => format!("install another, such as {RUNTIMES}"),
        false => {
            let paths = others.iter().map(|path| path.display().to_string());
            let paths = paths.collect::<Vec<_>>().join(", ");
            format!("choose another in XR_RUNTIME_JSON; here are {paths}")
        }
    };
    format!(
        "The OpenXR runtime {name} does without Vulkan (it lacks XR_KHR_vulkan_enable2): {choose}. \
         SteamVR has it, and becomes the active one in its settings under OpenXR."
    )
}

/// Message for a loader without a runtime that answers.
pub(crate) fn no_runtime(error: openxr::sys::Result) -> String {
    match manifest::find() {
        Some(manifest) => format!(
            "The OpenXR runtime of {} does not answer ({error}): start it, or name another one's \
             file in XR_RUNTIME_JSON.",
            manifest.display()
        ),
        None => ManifestError::Unchosen.to_string(),
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
        (
            "XR_EXT_eye_gaze_interaction",
            offered.ext_eye_gaze_interaction,
        ),
        ("XR_VARJO_quad_views", offered.varjo_quad_views),
        (
            "XR_VARJO_foveated_rendering",
            offered.varjo_foveated_rendering,
        ),
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

/// Files of runtimes that are installed beside the active one.
#[cfg(windows)]
fn others() -> Vec<PathBuf> {
    // A value for each, whose name is the path, and 0 where it may be chosen (OpenXR loader specification).
    let key = windows_registry::LOCAL_MACHINE.open(r"SOFTWARE\Khronos\OpenXR\1\AvailableRuntimes");
    let values =
        key.and_then(|key| Ok(key.values()?.map(|(name, _)| PathBuf::from(name)).collect()));
    let values: Vec<PathBuf> = values.unwrap_or_default();
    beside_the_active(values)
}

/// Files of runtimes that are installed beside the active one. Packages put them here; SteamVR's is in the user's Steam.
#[cfg(not(windows))]
fn others() -> Vec<PathBuf> {
    let home = std::env::var_os("HOME").map(PathBuf::from);
    let steam = home
        .map(|home| home.join(".local/share/Steam/steamapps/common/SteamVR/steamxr_linux64.json"));
    let packaged = std::fs::read_dir("/usr/share/openxr/1")
        .into_iter()
        .flatten();
    let packaged = packaged.filter_map(|entry| Some(entry.ok()?.path()));
    let packaged = packaged.filter(|path| path.extension().is_some_and(|it| it == "json"));
    let all = steam.into_iter().chain(packaged);
    let mut all: Vec<PathBuf> = all.filter(|path| path.exists()).collect();
    all.sort();
    beside_the_active(all)
}

fn beside_the_active(mut all: Vec<PathBuf>) -> Vec<PathBuf> {
    let real = |path: &PathBuf| path.canonicalize().unwrap_or_else(|_| path.clone());
    let active = manifest::find().as_ref().map(real);
    all.retain(|path| Some(real(path)) != active);
    all
}
