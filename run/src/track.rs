//! Pose tracks by name or file, how they spell actions, and whose fault it is where one cannot be read.

mod spelling;

use vitriol_xr::files::FileError;
use vitriol_xr::track::{self, Track, TrackError};

use crate::failure::Failure;

pub use spelling::{SpellingError, key};

// Names of a recording's metadata on how it was made and how it ended.

/// The preset.
pub const PRESET: &str = "preset";
/// The device's name.
pub const DEVICE: &str = "device";
/// Its driver and version.
pub const DRIVER: &str = "driver";
/// The lesson that it goes through.
pub const LESSON: &str = "lesson";
/// Hash of that lesson's text.
pub const LESSON_HASH: &str = "lesson_hash";
/// The mode in which it goes through the lesson.
pub const MODE: &str = "mode";
/// The language of the lesson's texts.
pub const LANGUAGE: &str = "language";
/// The student's name, where it was given.
pub const STUDENT: &str = "student";
/// Hash of the final state, hexadecimal.
pub const STATE_HASH: &str = "state_hash";

/// Why the recording is not whole: written in place of the hash, and where a track that breaks off is saved again.
pub const BROKEN_OFF: &str = "broken_off";

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
        // Such as a file that this user may not read.
        TrackError::Io { .. } | TrackError::File(FileError::Io { .. }) => {
            Failure::Other(error.into())
        }
        _ => Failure::Input(error.into()),
    }
}
