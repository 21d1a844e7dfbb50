//! `vitriol track`: converts keyframes, lists built-in tracks, looks into one.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Serialize;
use vitriol_run::track::BROKEN_OFF;
use vitriol_run::units::{count, three_digits};
use vitriol_run::{Failure, Format, emit, in_a_line, track};
use vitriol_sim::scene::Scene;
use vitriol_xr::files;
use vitriol_xr::track::{self as tracks, Existing, builtin};

use crate::cli::TrackArgs;

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
    /// Steps that are missing.
    missing_steps: u64,
    /// Those of them that are missing before its first frame.
    missing_first_steps: u64,
    program_version: String,
    parameters: BTreeMap<String, String>,
    /// Names of the scenes that it carries.
    scenes: Vec<String>,
    /// Values that its recorder wrote at the end, by name.
    outcome: BTreeMap<String, String>,
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
            let tracks: Vec<TrackInfo> = tracks.collect::<Result<_, _>>()?;
            let list = BTreeMap::from([("tracks", &tracks)]);
            emit(format, &list, |_| tracks.iter().map(line).collect())
        }
    }
}

fn convert(input: &str, output: &Path, format: Format) -> Result<(), Failure> {
    let mut track = track::load(input)?;
    if track.recovered {
        let cause = "its file had no end".to_owned();
        track.outcome.insert(BROKEN_OFF.to_owned(), cause);
    }
    // It stands alone then.
    let name = &track.metadata.scene;
    if let Some(text) = Scene::builtin_text(name) {
        let scenes = &mut track.metadata.scenes;
        scenes
            .entry(name.clone())
            .or_insert_with(|| Scene::complete(text).into_owned());
    }
    let written = tracks::save(&track, output, Existing::Refuse).map_err(track::blame)?;
    let conversion = Conversion {
        input: input.to_owned(),
        output: output.display().to_string(),
        frames: written.frames,
        duration_s: written.end_ns as f64 / 1e9,
    };
    emit(format, &conversion, |done| {
        format!(
            "{}: {}, {} s",
            done.output,
            count(done.frames, "frame"),
            three_digits(done.duration_s)
        )
    })
}

fn look_into(name: &str) -> Result<TrackInfo, Failure> {
    let track = track::load(name)?;
    let missing_first_steps = track.missing_first();
    let holes: u64 = track.holes().map(|hole| hole.steps).sum();
    Ok(TrackInfo {
        track: name.to_owned(),
        duration_s: track.duration(),
        frames: track.frames.len(),
        switches: track.frames.iter().map(|frame| frame.scenario.len()).sum(),
        recovered: track.recovered,
        missing_steps: missing_first_steps + holes,
        missing_first_steps,
        scenes: track.metadata.scenes.into_keys().collect(),
        outcome: track.outcome,
        scene: track.metadata.scene,
        seed: track.metadata.seed,
        program_version: track.metadata.program_version,
        parameters: track.metadata.parameters,
    })
}

fn line(info: &TrackInfo) -> String {
    format!(
        "{:<16} {:>6} s  {:>12}  scene {}\n",
        info.track,
        three_digits(info.duration_s),
        count(info.frames as u64, "frame"),
        in_a_line(&info.scene)
    )
}

fn describe(info: &TrackInfo) -> String {
    let mut text = line(info);
    let version = in_a_line(&info.program_version);
    text += &format!(
        "seed {}, {}, recorded by version {}\n",
        info.seed,
        count(info.switches as u64, "switch"),
        if info.program_version.is_empty() {
            "unknown"
        } else {
            &version
        }
    );
    for (name, value) in info.parameters.iter().chain(&info.outcome) {
        text += &format!("  {} = {}\n", in_a_line(name), in_a_line(value));
    }
    if !info.scenes.is_empty() {
        let scenes: Vec<_> = info.scenes.iter().map(|name| in_a_line(name)).collect();
        text += &format!("carries the scenes {}\n", scenes.join(", "));
    }
    let builtin = Scene::builtin_names();
    if !builtin.contains(&info.scene.as_str()) && !info.scenes.contains(&info.scene) {
        let suggested = files::suggested(&info.scene, &builtin);
        let scene = in_a_line(&info.scene);
        text += &format!(
            "The scene {scene} is neither built in nor in the track: {suggested}; `vitriol replay --scene` names a file.\n"
        );
    }
    text += &match info.missing_steps {
        0 => String::new(),
        1 => "A step is missing.\n".to_owned(),
        steps => format!("{} are missing.\n", count(steps, "step")),
    };
    if info.missing_first_steps > 0 {
        text += &format!(
            "It begins at step {}, so that nothing of it can be replayed: it was cut or filtered; take the whole file, or record it again.\n",
            info.missing_first_steps
        );
    }
    if info.recovered {
        text.push_str("The recording broke off; it was read as far as it goes.\n");
    }
    text
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn each_built_in_track_names_a_built_in_scene() {
        for name in builtin::NAMES {
            let scene = look_into(name).unwrap().scene;
            assert!(Scene::builtin_names().contains(&scene.as_str()), "{name}");
        }
    }

    #[test]
    fn a_scene_that_nobody_has_is_told() {
        let mut info = look_into("two-flasks").unwrap();
        assert!(!describe(&info).contains("neither"));
        info.scene = "two-flask".to_owned();
        let said = describe(&info);
        assert!(
            said.contains(
                "two-flask is neither built in nor in the track: did you mean two-flasks?"
            ),
            "{said}"
        );
        info.scenes = vec![info.scene.clone()];
        assert!(!describe(&info).contains("neither"));
    }
}
