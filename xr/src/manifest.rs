//! The file that names the active OpenXR runtime: where OpenXR's loader finds it, and whether it leads to a runtime.
//!
//! The loader has one answer for everything that is wrong with it, and prints lines of its own. So it is checked before the loader is
//! asked.

// Opening a library runs foreign code; the blocks state why that is valid.
#![allow(unsafe_code)]

use std::error::Error;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use libloading::Library;
use serde_json::Value;

use crate::files::{self, FileError};

/// Runtimes of this system's headsets.
#[cfg(windows)]
pub(crate) const RUNTIMES: &str =
    "SteamVR or Meta Quest Link, and make it the active one in its settings";
#[cfg(not(windows))]
pub(crate) const RUNTIMES: &str = "SteamVR, WiVRn or Monado";

/// The function of a runtime's library that the loader calls first (OpenXR loader specification, "Runtime negotiation").
const NEGOTIATE: &str = "xrNegotiateLoaderRuntimeInterface";
/// The only format of the file that is specified so far.
const FORMAT: &str = "1.0.0";
/// Length that no such file has, B.
const LIMIT: u64 = 1 << 20;

/// Why there is no runtime to ask.
#[derive(Debug, thiserror::Error)]
pub(crate) enum ManifestError {
    /// No file is named, and none is where the loader looks.
    #[error(
        "No OpenXR runtime is chosen: install and start your headset's, such as {}, or name its file in XR_RUNTIME_JSON.",
        RUNTIMES
    )]
    Unchosen,
    /// The file leads to no runtime.
    #[error(
        "The OpenXR runtime's file {} {fault}, or name another runtime's file in XR_RUNTIME_JSON.",
        .manifest.display()
    )]
    Faulty { manifest: PathBuf, fault: Fault },
}

/// What is wrong with the file, and how to mend it.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Fault {
    #[error("is not there: install the runtime that it belongs to")]
    Absent,
    #[error("cannot be read ({0}): mend that")]
    Unreadable(String),
    #[error("is empty: install its runtime again")]
    Empty,
    #[error("breaks off ({0}): install its runtime again, which writes it whole")]
    BreaksOff(serde_json::Error),
    #[error("is no JSON ({0}): correct it")]
    NoJson(serde_json::Error),
    #[error("names no library (it lacks runtime.library_path): install a runtime that does")]
    NoPath,
    #[error(
        "lacks the file_format_version {}, without which the loader refuses it: add it",
        FORMAT
    )]
    OtherFormat,
    #[error("names the library {}, which is not there: install the runtime again", .0.display())]
    NoLibrary(PathBuf),
    #[error("names the library {}, which cannot be loaded ({cause}): update the runtime", .library.display())]
    Unloadable { library: PathBuf, cause: String },
    #[error("names the library {}, which is no OpenXR runtime (it lacks {function}): correct the path", .library.display())]
    NoRuntime { library: PathBuf, function: String },
}

/// Whether a runtime is chosen, and its file leads to a library that is one. It calls nothing of the library.
pub(crate) fn check() -> Result<(), ManifestError> {
    let manifest = find().ok_or(ManifestError::Unchosen)?;
    leads_to_a_runtime(&manifest).map_err(|fault| ManifestError::Faulty { manifest, fault })
}

/// The file that names the active runtime, by the loader's own rules (OpenXR loader specification, "Desktop active
/// runtime file location").
pub(crate) fn find() -> Option<PathBuf> {
    variable("XR_RUNTIME_JSON").map_or_else(active, |named| Some(named.into()))
}

/// That environment variable, unless it is empty: the loader takes an empty one for none.
fn variable(name: &str) -> Option<std::ffi::OsString> {
    std::env::var_os(name).filter(|value| !value.is_empty())
}

/// On Windows the registry names it.
#[cfg(windows)]
fn active() -> Option<PathBuf> {
    let key = windows_registry::LOCAL_MACHINE.open(r"SOFTWARE\Khronos\OpenXR\1");
    let named = key.and_then(|key| key.get_string("ActiveRuntime"));
    named.ok().map(PathBuf::from)
}

/// Elsewhere the first of these files is it. Loaders since 2023 prefer the one of the processor's architecture in each folder.
#[cfg(not(windows))]
fn active() -> Option<PathBuf> {
    let home = || Some(PathBuf::from(variable("HOME")?).join(".config"));
    let user = variable("XDG_CONFIG_HOME").map(PathBuf::from).or_else(home);
    let shared = variable("XDG_CONFIG_DIRS").unwrap_or_else(|| "/etc/xdg".into());
    let names = [
        format!("openxr/1/active_runtime.{}.json", std::env::consts::ARCH),
        "openxr/1/active_runtime.json".to_owned(),
    ];
    user.into_iter()
        .chain(std::env::split_paths(&shared))
        .chain(["/usr/local/etc", "/etc"].map(PathBuf::from))
        .flat_map(|folder| names.each_ref().map(|name| folder.join(name)))
        .find(|path| path.exists())
}

fn leads_to_a_runtime(manifest: &Path) -> Result<(), Fault> {
    let content = files::read(manifest, "OpenXR runtime's file", LIMIT);
    let content = content.map_err(|error| match error {
        FileError::Io { source, .. } if source.kind() == ErrorKind::NotFound => Fault::Absent,
        FileError::Io { source, .. } => Fault::Unreadable(source.to_string()),
        FileError::NotAFile { kind, .. } => Fault::Unreadable(format!("it is {kind}")),
        _ => Fault::Unreadable(format!("it is longer than {LIMIT} bytes")),
    })?;
    // The loader ignores a byte order mark too.
    let content = content.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&content);
    if content.trim_ascii().is_empty() {
        return Err(Fault::Empty);
    }
    let content: Value = serde_json::from_slice(content).map_err(|cause| match cause.is_eof() {
        true => Fault::BreaksOff(cause),
        false => Fault::NoJson(cause),
    })?;
    let runtime = &content["runtime"];
    let path = runtime["library_path"].as_str().ok_or(Fault::NoPath)?;
    if content["file_format_version"].as_str() != Some(FORMAT) {
        return Err(Fault::OtherFormat);
    }
    // A runtime may have the function under another name.
    let function = runtime["functions"][NEGOTIATE].as_str();
    exports(library(manifest, path)?, function.unwrap_or(NEGOTIATE))
}

/// The library that the file names.
fn library(manifest: &Path, path: &str) -> Result<PathBuf, Fault> {
    // The system searches for a bare name.
    if !path.contains(['/', '\\']) {
        return Ok(path.into());
    }
    let beside = |file: &Path| file.parent().unwrap_or(Path::new("")).join(path);
    // Where the manifest is a link, old loaders begin at the link and new ones at its target.
    let target = manifest.canonicalize();
    let places = [
        beside(target.as_deref().unwrap_or(manifest)),
        beside(manifest),
    ];
    let there = places.iter().find(|place| place.exists()).cloned();
    let [place, _] = places;
    there.ok_or(Fault::NoLibrary(place))
}

fn exports(library: PathBuf, function: &str) -> Result<(), Fault> {
    // SAFETY: the loader opens the same library next, and closes it with each instance; so its code for both may run at any time.
    let opened = match unsafe { open(&library) } {
        Ok(opened) => opened,
        Err(error) => {
            let cause = error
                .source()
                .map_or_else(|| error.to_string(), ToString::to_string);
            return Err(Fault::Unloadable { library, cause });
        }
    };
    // SAFETY: the function is not called.
    let found = unsafe { opened.get::<unsafe extern "system" fn()>(function) };
    match found {
        Ok(_) => Ok(()),
        Err(_) => Err(Fault::NoRuntime {
            library,
            function: function.to_owned(),
        }),
    }
}

/// Opens it as the loader does.
///
/// # Safety
/// What the library does when it is opened and closed must be valid.
#[cfg(not(windows))]
unsafe fn open(library: &Path) -> Result<Library, libloading::Error> {
    // SAFETY: the caller's promise.
    unsafe { Library::new(library) }
}

/// Opens it as the loader does: where that fails, libraries that it needs are searched for in its own folder too.
///
/// # Safety
/// What the library does when it is opened and closed must be valid.
#[cfg(windows)]
unsafe fn open(library: &Path) -> Result<Library, libloading::Error> {
    use libloading::os::windows::{
        LOAD_LIBRARY_SEARCH_DEFAULT_DIRS, LOAD_LIBRARY_SEARCH_DLL_LOAD_DIR, Library as Dll,
    };
    let wider = LOAD_LIBRARY_SEARCH_DEFAULT_DIRS | LOAD_LIBRARY_SEARCH_DLL_LOAD_DIR;
    // SAFETY: the caller's promise.
    let opened = unsafe { Library::new(library) };
    // SAFETY: as above.
    opened.or_else(|_| unsafe { Dll::load_with_flags(library, wider) }.map(Library::from))
}
