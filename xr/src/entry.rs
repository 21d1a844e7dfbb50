//! OpenXR's loader.

// Loading it runs foreign code, and what it prints is set in the environment; the blocks state why that is valid.
#![allow(unsafe_code)]

use openxr::Entry;

/// The environment variable that says what the loader prints; it is read when the loader is first called.
const PRINTED: &str = "XR_LOADER_DEBUG";

/// Keeps the loader from printing lines of its own before this program's message, unless the user has set XR_LOADER_DEBUG.
///
/// To be called before the first other thread: with threads it does nothing, except on Windows. There is no other means that every
/// loader has: XR_EXT_debug_utils adds a recipient of its lines and silences none.
pub fn quiet_loader() {
    if std::env::var_os(PRINTED).is_none() && is_alone() {
        // SAFETY: no other thread reads or writes the environment meanwhile, as there is none; on Windows the system guards it.
        unsafe { std::env::set_var(PRINTED, "none") };
    }
}

/// Whether the environment may be changed: this is the process's only thread, or the system guards it.
fn is_alone() -> bool {
    let only = || std::fs::read_dir("/proc/self/task").is_ok_and(|threads| threads.count() == 1);
    cfg!(windows) || only()
}

/// The loader. Windows has none of its own and no folder where programs agree to put one, so there it is part of the
/// program; elsewhere the system's is loaded, as distributions patch its search paths.
///
/// # Errors
/// A sentence that names what is missing, with its remedy.
pub(crate) fn entry() -> Result<Entry, String> {
    #[cfg(windows)]
    {
        Entry::linked(&()).map_err(|error| format!("The OpenXR loader does not start ({error})."))
    }
    #[cfg(not(windows))]
    {
        // SAFETY: the library of that name in the system's search path is the Khronos loader, as for every OpenXR
        // program; handles made by it keep it loaded.
        unsafe { Entry::load(&()) }.map_err(|error| {
            format!(
                "The OpenXR loader cannot be loaded ({error}): install it (Debian: package \
                 libopenxr-loader1) to use a headset."
            )
        })
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    #[test]
    fn the_environment_of_several_threads_is_left_as_it_is() {
        let (end, ended) = std::sync::mpsc::channel::<()>();
        std::thread::scope(|scope| {
            scope.spawn(move || ended.recv());
            let before = std::env::var_os(PRINTED);
            quiet_loader();
            assert_eq!(std::env::var_os(PRINTED), before);
            assert!(!is_alone());
            drop(end);
        });
    }
}
