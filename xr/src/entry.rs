//! OpenXR's loader.

// Loading it runs foreign code; the block states why that is valid.
#![allow(unsafe_code)]

use openxr::Entry;

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
