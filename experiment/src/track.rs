//! Pose tracks by name or file, and whose fault it is where one cannot be read.

use vitriol_xr::track::{self, Track, TrackError};

use crate::failure::Failure;

/// Reads a track by name or file.
///
/// # Errors
/// [`Failure::Input`], or [`Failure::Other`] where the system refuses.
pub fn load(name: &str) -> Result<Track, Failure> {
    track::load(name).map_err(blame)
}

/// Whose fault a track's error is.
pub fn blame(error: TrackError) -> Failure {
    match &error {
        // A folder, or a file that this user may not read, was named.
        TrackError::Io { action, .. } if *action != "read" => Failure::Other(error.into()),
        _ => Failure::Input(error.into()),
    }
}
