//! Tracks by name, and to a file.

use std::path::Path;

use crate::files::{self, suggested};

use super::{Annex, Existing, Keyframes, Track, TrackError, TrackWriter, Written, builtin};

/// JSON schema of events and progress where a track is written again: any object.
const ANY_OBJECT: &str = r#"{"type":"object"}"#;

/// The track of that name: a built-in one, else a file, keyframes where its name ends in
/// `.toml` and MCAP otherwise.
///
/// # Errors
/// [`TrackError::Unknown`] where it is neither; otherwise the error of the file.
pub fn load(name: &str) -> Result<Track, TrackError> {
    if let Some(text) = builtin::text(name) {
        return Ok(Keyframes::parse(text, &builtin::file(name))?.sample_track());
    }
    let file = Path::new(name);
    if files::is_absent(file) {
        return Err(TrackError::Unknown {
            name: name.into(),
            known: suggested(name, &builtin::NAMES),
        });
    }
    if file
        .extension()
        .is_some_and(|extension| extension == "toml")
    {
        return Ok(Keyframes::open(file)?.sample_track());
    }
    Track::open(file)
}

/// Writes `track` to the MCAP file `output`. The remains of a failed write are removed.
///
/// # Errors
/// Those of [`TrackWriter`].
pub fn save(track: &Track, output: &Path, existing: Existing) -> Result<Written, TrackError> {
    let writer = TrackWriter::create(output, &track.metadata, existing)?;
    let written = fill(writer, track);
    if written.is_err() {
        // The write's own error is the one to report.
        let _ = std::fs::remove_file(output);
    }
    written
}

fn fill(mut writer: TrackWriter, track: &Track) -> Result<Written, TrackError> {
    for (frame, flasks) in track.frames.iter().zip(&track.stage_from_flasks) {
        writer.write(frame, flasks)?;
    }
    for (time_ns, json) in &track.events {
        let schema = ANY_OBJECT;
        writer.add(*time_ns, &Annex::Event { json, schema })?;
    }
    for (time_ns, json) in &track.progress {
        let schema = ANY_OBJECT;
        writer.add(*time_ns, &Annex::Progress { json, schema })?;
    }
    writer.conclude(&track.outcome)?;
    writer.finish()
}
