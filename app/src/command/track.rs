//! `vitriol track`: converts keyframes, lists built-in tracks, looks into one.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

use serde::Serialize;
use vitriol_xr::track::{self, Existing, Track, TrackError, builtin};

use crate::cli::TrackArgs;
use crate::console::{Format, emit};
use crate::failure::Failure;
use crate::report::units::three_digits;

/// What a track holds.
#[derive(Debug, Serialize)]
struct TrackInfo {
    track: String,
    scene: String,
    seed: u64,
    duration_s: f64,
    frames: usize,
    switches: usize,
    /// The file had no end, as after a crash, and was read as far as it goes.
    recovered: bool,
    program_version: String,
    parameters: BTreeMap<String, String>,
}

#[derive(Debug, Serialize)]
struct TrackList {
    tracks: Vec<TrackInfo>,
}

#[derive(Debug, Serialize)]
struct Conversion {
    input: String,
    output: String,
    frames: u64,
    duration_s: f64,
}

/// Runs `vitriol track`.
///
/// # Errors
/// [`Failure::Input`] for a track that is missing, malformed or in the way,
/// [`Failure::Other`] where the system refuses.
pub fn run(args: &TrackArgs, format: Format) -> Result<(), Failure> {
    match (&args.input, &args.output) {
        (Some(input), Some(output)) => convert(input, output, format),
        (Some(input), None) => emit(format, &look_into(input)?, describe),
        (None, _) => {
            let tracks = builtin::NAMES.iter().map(|name| look_into(name));
            let tracks = tracks.collect::<Result<_, _>>()?;
            emit(format, &TrackList { tracks }, |list| {
                list.tracks.iter().map(line).collect()
            })
        }
    }
}

/// Reads a track by name or file.
///
/// # Errors
/// [`Failure::Input`], or [`Failure::Other`] where the system refuses.
pub fn load(name: &str) -> Result<Track, Failure> {
    track::load(name).map_err(blame)
}

fn convert(input: &str, output: &Path, format: Format) -> Result<(), Failure> {
    let written = track::convert(input, output, Existing::Refuse).map_err(blame)?;
    let conversion = Conversion {
        input: input.to_owned(),
        output: output.display().to_string(),
        frames: written.frames,
        duration_s: written.end_ns as f64 * 1e-9,
    };
    emit(format, &conversion, |done| {
        format!(
            "{}: {} frames, {} s",
            done.output,
            done.frames,
            three_digits(done.duration_s)
        )
    })
}

fn look_into(name: &str) -> Result<TrackInfo, Failure> {
    let track = load(name)?;
    Ok(TrackInfo {
        track: name.to_owned(),
        duration_s: track.duration(),
        frames: track.frames.len(),
        switches: track.frames.iter().map(|frame| frame.scenario.len()).sum(),
        recovered: track.recovered,
        scene: track.metadata.scene,
        seed: track.metadata.seed,
        program_version: track.metadata.program_version,
        parameters: track.metadata.parameters,
    })
}

fn line(info: &TrackInfo) -> String {
    format!(
        "{:<16} {:>6} s  {:>5} frames  scene {}\n",
        info.track,
        three_digits(info.duration_s),
        info.frames,
        info.scene
    )
}

fn describe(info: &TrackInfo) -> String {
    let mut text = line(info);
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "seed {}, {} switches, recorded by version {}",
        info.seed,
        info.switches,
        if info.program_version.is_empty() {
            "unknown"
        } else {
            &info.program_version
        }
    );
    for (name, value) in &info.parameters {
        let _ = writeln!(text, "  {name} = {value}");
    }
    if info.recovered {
        text.push_str("The recording broke off; it was read as far as it goes.\n");
    }
    text
}

/// Whose fault a track's error is.
pub fn blame(error: TrackError) -> Failure {
    match &error {
        // A folder, or a file that this user may not read, was named.
        TrackError::Io { action, .. } if *action != "read" => Failure::Other(error.into()),
        _ => Failure::Input(error.into()),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use vitriol_sim::scene::Scene;

    #[test]
    fn each_built_in_track_names_a_built_in_scene() {
        for name in builtin::NAMES {
            let scene = look_into(name).unwrap().scene;
            assert!(Scene::builtin_names().contains(&scene.as_str()), "{name}");
        }
    }
}
