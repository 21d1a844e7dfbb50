//! `vitriol replay`: a track through the simulation to film and report.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use serde::Serialize;
use vitriol_experiment::output::{FILM, FILM_TEMPERATURE, OutDir, REPORT_HTML, REPORT_JSON};
use vitriol_experiment::track::{DEVICE, DRIVER, PRESET, STATE_HASH};
use vitriol_experiment::units::{grouped, mass, percent, three_digits, with_unit};
use vitriol_experiment::{
    Blame, Colour, Experiment, FILM_FPS, FILM_SIZE, Failure, Film, Format, Observations, Observer,
    Outcome, Sample, Scenes, Setup, Span, device, emit, in_a_line, track,
};
use vitriol_shaders::Library;
use vitriol_sim::scene::{Feature, Preset, Scene};
use vitriol_xr::track::{TrackMetadata, TrackSource, limits};

use crate::budget;
use crate::cli::{CameraName, ReplayArgs};
use crate::command::recorded::{
    changes_scene, differences, head, own_solver, preset_of, scene_of, whole,
};
use crate::report::{FilmStatement, RecordingStatement, Report, SceneStatement, SolverStatement};

/// What `vitriol replay --json` prints: the report without its time series, and
/// where things are.
#[derive(Debug, Serialize)]
struct Replayed {
    #[serde(flatten)]
    report: Report,
    report_json: String,
    report_html: String,
}

/// Runs `vitriol replay`; `prepare` makes the experiment.
///
/// # Errors
/// [`Failure::Input`] for bad track, scene or folder, [`Failure::NoDevice`],
/// [`Failure::Other`]; no report, film or new folder is left then.
pub fn run(
    args: &ReplayArgs,
    format: Format,
    prepare: impl FnOnce(&Setup<'_>) -> Result<Box<dyn Experiment>, Failure>,
) -> Result<(), Failure> {
    let track = track::load(&args.track)?;
    let mut track = whole(&args.track, track, args.accept_truncated)?;
    let mut scenes = Scenes::default();
    let name = scene_of(&mut scenes, &args.track, args.scene.as_deref(), &track)?;
    let asked = args.solver.is_some() || args.budget_ms.is_some();
    if asked && changes_scene(&track) {
        // The scenes that it changes to have presets of their own.
        return Err(
            "--solver and --budget-ms are for one scene, and the track changes it; \
                    choose a --preset"
                .to_owned(),
        )
        .input();
    }
    if own_solver((asked, args.preset), (&name, &scenes), &mut track) {
        tracing::warn!(
            "the track's own changes of substeps and iterations are left out: it is replayed as asked for"
        );
    }
    let preset = preset_of(args.preset, &track);
    let scene = scenes.get(&name)?.with_preset(preset);
    if is_recording(&track.metadata) {
        let asked = asked_otherwise(args, &track.metadata);
        for difference in differences(&track.metadata, (&name, &scenes), None, &asked) {
            tracing::warn!("bits may differ: {difference}");
        }
    }
    let gpu = || device::open(args.device.as_deref());
    let chosen = budget::chosen(args.solver, args.budget_ms, &scene, gpu)?;
    let scene = chosen.map_or_else(|| scene.clone(), |effort| scene.with_effort(effort));
    let head = head(args.camera, &args.track, &track)?;
    let colours = colours(args, &scene, &name)?;
    let mut out = OutDir::take(args.out.as_deref(), &stem(&args.track))?;
    let seed = args.seed.unwrap_or(track.metadata.seed);
    let mut experiment = prepare(&Setup {
        scene: &scene,
        scene_name: &name,
        scenes: &scenes,
        preset,
        seed,
        device: args.device.as_deref(),
        picture: (!args.no_video).then_some(FILM_SIZE),
        colours: colours.clone(),
        eyes: 1,
        filter: args.filter,
        head,
        shaders: Arc::new(Library::watching()),
    })?;
    let seconds = args.seconds.unwrap_or_else(|| track.duration());
    let recorded = (track.metadata.clone(), track.outcome.clone());
    let span = Span::covering(seconds, scene.scale.frame_time);
    if span.steps > limits::FRAMES as u64 {
        return Err(format!(
            "{} steps of {} s are more than a run of {} takes; give fewer --seconds",
            span.steps,
            scene.scale.frame_time,
            limits::FRAMES
        ))
        .input();
    }

    let [width, height] = FILM_SIZE;
    let films = colours.iter().enumerate().map(|(index, _)| {
        let path = out.join(film_name(index));
        Film::create(&path, width, height, FILM_FPS)
    });
    let films = films.collect::<Result<_, _>>().other()?;
    let mut observer = Observer::new(span, films);
    vitriol_experiment::run(
        &mut TrackSource::new(track),
        experiment.as_mut(),
        span,
        &mut observer,
    )?;
    let observations = observer.finish()?;
    for film in &observations.films {
        out.adopt(film.clone());
    }
    let outcome = experiment.outcome()?;
    let name_of_start = name.clone();
    let (name, scene) = match &outcome.scene {
        Some(switched) => (switched.clone(), scenes.get(switched)?.with_preset(preset)),
        None => (name, scene),
    };
    let scene = scene.with_effort(outcome.effort);
    let recording = recording(args, (&name_of_start, &scenes), &recorded, &outcome);
    let mut report = assemble(
        (args, chosen),
        &colours,
        preset,
        seed,
        (&name, &scene),
        outcome,
        observations,
    );
    report.recording = recording;
    // The page first and the numbers last: a folder with `report.json` is a whole run.
    out.write(REPORT_HTML, report.to_html().as_bytes())?;
    out.write(REPORT_JSON, &serde_json::to_vec_pretty(&report).other()?)?;

    let replayed = Replayed {
        report: report.without_series(),
        report_json: out.join(REPORT_JSON).display().to_string(),
        report_html: out.join(REPORT_HTML).display().to_string(),
    };
    let folder = out.path.clone();
    out.complete();
    emit(format, &replayed, |done| describe(done, &folder))
}

/// Whether the track is a recording, and not made of keyframes, which say their own name.
fn is_recording(metadata: &TrackMetadata) -> bool {
    !metadata.parameters.contains_key("track")
}

/// Options that ask for something else than was recorded.
fn asked_otherwise(args: &ReplayArgs, metadata: &TrackMetadata) -> Vec<&'static str> {
    let preset = metadata.parameters.get(PRESET).map(String::as_str);
    let options = [
        ("--seconds", args.seconds.is_some()),
        (
            "--seed",
            args.seed.is_some_and(|seed| seed != metadata.seed),
        ),
        ("--solver", args.solver.is_some()),
        ("--budget-ms", args.budget_ms.is_some()),
        ("--accept-truncated", args.accept_truncated),
        (
            "--preset",
            args.preset
                .is_some_and(|asked| Some(asked.name()) != preset),
        ),
    ];
    let given = options.into_iter().filter(|(_, given)| *given);
    given.map(|(option, _)| option).collect()
}

/// How the run stands to the recording that it replays; `None` where the track is none.
fn recording(
    args: &ReplayArgs,
    scene: (&str, &Scenes),
    (metadata, said): &(TrackMetadata, BTreeMap<String, String>),
    outcome: &Outcome,
) -> Option<RecordingStatement> {
    if !is_recording(metadata) {
        return None;
    }
    let state_hash = said.get(STATE_HASH).cloned();
    let same = state_hash
        .as_ref()
        .map(|recorded| *recorded == format!("{:016x}", outcome.state_hash));
    let asked = asked_otherwise(args, metadata);
    let differs = differences(metadata, scene, Some(&outcome.device), &asked);
    if same == Some(false) && differs.is_empty() {
        tracing::warn!(
            "the final state is not the recorded one, and nothing that is known differs; report it"
        );
    }
    Some(RecordingStatement {
        program_version: metadata.program_version.clone(),
        device: metadata.parameters.get(DEVICE).cloned(),
        driver: metadata.parameters.get(DRIVER).cloned(),
        state_hash,
        same_state: same,
        differs,
    })
}

/// What the films' colours stand for; the first is the film, the second, if
/// there is one, that of temperature.
fn colours(args: &ReplayArgs, scene: &Scene, name: &str) -> Result<Vec<Colour>, Failure> {
    let heat = scene.models(Feature::Heat);
    match args.colour {
        _ if args.no_video => Ok(Vec::new()),
        None if heat => Ok(vec![Colour::Liquid, Colour::Temperature]),
        None => Ok(vec![Colour::Liquid]),
        Some(colour) if heat || !colour.is_of_heat() => Ok(vec![colour]),
        Some(colour) => Err(format!(
            "--colour {}: the scene {name} models no heat; take --colour liquid or speed",
            colour.name()
        ))
        .input(),
    }
}

/// A film's name in the output folder.
fn film_name(index: usize) -> &'static str {
    if index == 0 { FILM } else { FILM_TEMPERATURE }
}

/// The track's name without folder and ending, for the output folder's name.
fn stem(track: &str) -> String {
    let stem = Path::new(track).file_stem();
    stem.map_or_else(|| "run".into(), |stem| stem.to_string_lossy().into_owned())
}

fn assemble(
    (args, chosen): (&ReplayArgs, Option<[u32; 2]>),
    colours: &[Colour],
    preset: Preset,
    seed: u64,
    (name, scene): (&str, &Scene),
    outcome: Outcome,
    observations: Observations,
) -> Report {
    let samples = &observations.samples;
    // The filling is not the solver's work, so the start does not count.
    let solved = || samples.iter().skip(1);
    let count = solved().count().max(1) as f64;
    let [width, height] = FILM_SIZE;
    let film = |index: usize| {
        colours.get(index).map(|colour| FilmStatement {
            path: film_name(index).into(),
            width,
            height,
            fps: FILM_FPS,
            frames: observations.film_frames,
            colour: colour.name().into(),
        })
    };
    Report {
        program: concat!("vitriol ", env!("CARGO_PKG_VERSION")).into(),
        command: command_line(args, preset, seed, chosen),
        track: args.track.clone(),
        preset: preset.name().into(),
        seed,
        fluid_particles: outcome.fluid_particles,
        lost_particles: outcome.lost_particles,
        nan_particles: outcome.nan_particles,
        density_error_mean: solved().map(|s| s.density_error_mean).sum::<f64>() / count,
        density_error_p99: solved().map(|s| s.density_error_p99).fold(0.0, f64::max),
        frames: observations.time.steps(),
        simulated_s: observations.time.seconds(),
        wall_s: observations.wall.as_secs_f64(),
        state_hash: format!("{:016x}", outcome.state_hash),
        mass_kg: samples
            .last()
            .map(|s| s.mass_kg.clone())
            .unwrap_or_default(),
        boiling_particle_seconds: boiling(samples),
        film: film(0),
        film_temperature: film(1),
        device: outcome.device,
        scene: SceneStatement::of(name, scene),
        solver: SolverStatement::of(scene),
        counters: outcome.counters,
        recording: None,
        series: observations.samples,
    }
}

/// Particles above their boiling point times the time since the sample before,
/// by flask.
fn boiling(samples: &[Sample]) -> BTreeMap<String, f64> {
    let mut sums = BTreeMap::new();
    for pair in samples.windows(2) {
        let flasks = pair[1].heat.iter().flat_map(|heat| &heat.boiling_in_flasks);
        for (flask, &count) in flasks {
            *sums.entry(flask.clone()).or_insert(0.0) += count as f64 * (pair[1].t_s - pair[0].t_s);
        }
    }
    sums
}

/// The command line that makes the run again; without `--out`, since that
/// folder is taken now.
fn command_line(args: &ReplayArgs, preset: Preset, seed: u64, solver: Option<[u32; 2]>) -> String {
    let head = (args.camera == CameraName::Head).then(|| "head".to_owned());
    let options = [
        ("scene", args.scene.as_deref().map(quoted)),
        ("preset", Some(preset.name().to_owned())),
        ("seed", Some(seed.to_string())),
        ("solver", solver.map(|[a, b]| format!("{a}x{b}"))),
        ("seconds", args.seconds.map(|seconds| seconds.to_string())),
        ("device", args.device.as_deref().map(quoted)),
        ("camera", head),
        ("colour", args.colour.map(|it| it.name().to_owned())),
        ("filter", args.filter.map(|it| it.name().to_owned())),
    ];
    let truncated = if args.accept_truncated {
        " --accept-truncated"
    } else {
        ""
    };
    let mut line = format!("vitriol replay {}", quoted(&args.track));
    for (name, value) in options {
        line.extend(value.map(|value| format!(" --{name} {value}")));
    }
    line += truncated;
    if args.no_video {
        line += " --no-video";
    }
    line
}

/// An argument as a POSIX shell takes it.
fn quoted(argument: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./:=+,@%".contains(c);
    if !argument.is_empty() && argument.chars().all(plain) {
        argument.to_owned()
    } else {
        format!("'{}'", argument.replace('\'', r"'\''"))
    }
}

fn describe(done: &Replayed, out: &Path) -> String {
    let report = &done.report;
    let unit = mass(report.mass_kg.total());
    let places: Vec<String> = report
        .mass_kg
        .places()
        .map(|(place, kg)| format!("{} {}", in_a_line(place), with_unit(kg, unit)))
        .collect();
    let mut lines = vec![
        format!(
            "{} particles, {} s simulated in {} s on {}",
            grouped(report.fluid_particles),
            three_digits(report.simulated_s),
            three_digits(report.wall_s),
            report.device.name
        ),
        format!(
            "density error: mean {}, 99th percentile {}; lost {}, not finite {}",
            percent(report.density_error_mean),
            percent(report.density_error_p99),
            report.lost_particles,
            report.nan_particles
        ),
        format!("at the end: {}", places.join(", ")),
        format!("state {}", report.state_hash),
    ];
    lines.extend(report.recording.iter().map(RecordingStatement::text));
    lines.push(String::new());
    for film in report.film.iter().chain(&report.film_temperature) {
        lines.push(format!("film    {}", out.join(&film.path).display()));
    }
    lines.push(format!("report  {}", done.report_html));
    lines.push(format!("numbers {}", done.report_json));
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_survive_a_shell() {
        assert_eq!(quoted("two-flasks"), "two-flasks");
        assert_eq!(quoted("my tracks/a'b"), r"'my tracks/a'\''b'");
        assert_eq!(quoted(""), "''");
    }
}
