//! `vitriol replay`: a track through the simulation to film and report.

mod assemble;
#[cfg(feature = "class")]
mod class;
mod compare;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::Serialize;
use vitriol_lesson::procedure::{Progress, Verdict};
use vitriol_lesson::{Event, Score, Texts, incidents_csv};
use vitriol_run::output::{
    self, ColorType, FILM, FILM_TEMPERATURE, INCIDENTS_CSV, OutDir, POSTERS, REPORT_HTML,
    REPORT_JSON,
};
use vitriol_run::progress::Runs;
use vitriol_run::track::{DEVICE, DRIVER, STATE_HASH};
use vitriol_run::units::{count, mass, percent, three_digits, with_unit};
use vitriol_run::{
    Blame, Colour, Experiment, FILM_FPS, FILM_SIZE, Failure, Film, Format, Observer, Outcome,
    Scenes, Setup, emit, in_a_line,
};
use vitriol_shaders::Library;
use vitriol_sim::scene::{Feature, Scene};
use vitriol_xr::track::{TrackMetadata, TrackSource};

use crate::cli::{CameraName, ReplayArgs};
use crate::command::course::{self, AskedLesson};
#[cfg(feature = "class")]
use crate::command::keeping::Kept;
use crate::command::plan::{Ask, ReplayPlan};
use crate::command::recorded::{
    differences, head, is_recording, recorded_events, recorded_progress,
};
use crate::command::stem;
use crate::report::{RecordingStatement, Report};

use assemble::assemble;

/// What `vitriol replay --json` prints: the report without its time series, and
/// where things are.
#[derive(Debug, Serialize)]
struct Replayed {
    #[serde(flatten)]
    report: Report,
    /// Texts of the summary, in the report's language.
    #[serde(skip)]
    texts: Texts,
    report_json: String,
    report_html: String,
    /// `None` of a run without attempts.
    #[serde(skip_serializing_if = "Option::is_none")]
    incidents_csv: Option<String>,
    /// What was kept under a pseudonym.
    #[cfg(feature = "class")]
    #[serde(skip_serializing_if = "Option::is_none")]
    kept: Option<Kept>,
}

/// What `vitriol replay --json` prints of several tracks.
#[derive(Debug, Serialize)]
struct Several {
    /// As of one track each, or what it failed with, in the order in which they were given.
    runs: Vec<Ended>,
}

#[derive(Debug, Serialize)]
#[serde(untagged)]
enum Ended {
    Well(Box<Replayed>),
    Failed { track: String, error: String },
}

/// Runs `vitriol replay`; `prepare` makes an experiment. Of several tracks one that fails stops no other.
///
/// # Errors
/// [`Failure::Input`] for bad track, scene or folder, [`Failure::NoDevice`],
/// [`Failure::Other`]; no report, film or new folder is left of that track then.
pub fn run(
    args: &ReplayArgs,
    format: Format,
    prepare: impl Fn(&Setup<'_>) -> Result<Box<dyn Experiment>, Failure>,
) -> Result<(), Failure> {
    let bars = Runs::new(format);
    #[cfg(feature = "class")]
    let prepare = {
        let console = class::ReplayConsole::begin(args, format)?;
        move |setup: &Setup<'_>| console.show(prepare(setup)?, setup.scene_name)
    };
    if let Some(scenes) = &args.compare {
        return compare::run((args, scenes), &bars, format, &prepare);
    }
    if let [track] = &args.tracks[..] {
        let done = replay((args, track), args.out.clone(), &bars, &prepare)?;
        return emit(format, &done, describe);
    }
    let (mut runs, mut failure) = (Vec::new(), None);
    let made = args.out.as_ref().filter(|out| !out.exists());
    for (track, name) in args.tracks.iter().zip(folders(&args.tracks)) {
        let out = args.out.as_ref().map(|out| out.join(name));
        runs.push(match replay((args, track), out, &bars, &prepare) {
            Ok(done) => Ended::Well(Box::new(done)),
            Err(error) => {
                let (track, text) = (track.clone(), error.to_string());
                failure.get_or_insert(error);
                Ended::Failed { track, error: text }
            }
        });
    }
    if let Some(out) = made {
        // Where all failed; else it is not empty, and stays.
        let _ = std::fs::remove_dir(out);
    }
    emit(format, &Several { runs }, |several| {
        let each = several.runs.iter().map(|run| match run {
            Ended::Well(done) => format!("{}\n{}\n", in_a_line(&done.report.track), describe(done)),
            Ended::Failed { track, error } => format!("{}\nfailed: {error}\n", in_a_line(track)),
        });
        each.collect::<Vec<_>>().join("\n")
    })?;
    failure.map_or(Ok(()), Err)
}

/// A folder's name for each of several tracks.
fn folders(tracks: &[String]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for track in tracks {
        let stem = stem(track);
        let more = (2..).map(|number| format!("{stem}-{number}"));
        let free = std::iter::once(stem.clone()).chain(more);
        // Some file systems do not tell capitals from small letters.
        let taken = |name: &String| names.iter().any(|other| other.eq_ignore_ascii_case(name));
        let name = free.into_iter().find(|name| !taken(name));
        names.extend(name);
    }
    names
}

/// Replays one track.
fn replay(
    (args, name): (&ReplayArgs, &str),
    out: Option<PathBuf>,
    bars: &Runs,
    prepare: &impl Fn(&Setup<'_>) -> Result<Box<dyn Experiment>, Failure>,
) -> Result<Replayed, Failure> {
    let ask = ask(args, name);
    let plan = ReplayPlan::new(&ask)?;
    let head = head(args.camera, name, &plan.track)?;
    let lesson = args.judge.chosen(args.language)?;
    let judging = lesson.as_ref().map(|(lesson, mode)| {
        let text = plan.scenes.text(&plan.name);
        let scene = (plan.name.as_str(), text.as_deref());
        course::judging((lesson, *mode), scene, args.language)
    });
    let judging = judging.transpose()?;
    let asked = ask.otherwise(&plan.track);
    #[cfg(feature = "class")]
    let record = class::Record::of((args, name), &plan.track, &asked)?;
    let colours = colours(args, &plan.scene, &plan.name)?;
    let mut out = OutDir::take(out.as_deref(), &stem(name))?;
    let mut experiment = prepare(&Setup {
        picture: (!args.no_video).then_some(FILM_SIZE),
        colours: colours.clone(),
        filter: args.filter,
        tint: args.drawn.tint,
        room: args.drawn.room,
        head,
        directed: args.camera == CameraName::Director,
        language: args.language,
        shaders: Arc::new(Library::watching()),
        ..plan.setup(args.device.as_deref())
    })?;
    if let Some(judging) = judging {
        experiment.judge(judging);
    }
    let went_through = lesson.as_ref().filter(|(lesson, mode)| {
        let asked = AskedLesson::of(lesson, *mode);
        asked.otherwise(&plan.track).is_none()
    });
    let recorded = is_recording(&plan.track.metadata).then(|| Recorded {
        metadata: plan.track.metadata.clone(),
        said: plan.track.outcome.clone(),
        asked,
        events: recorded_events(&plan.track),
        progress: went_through.map(|_| recorded_progress(&plan.track)),
    });

    let films = colours.iter().enumerate().map(|(index, _)| {
        let path = out.join(film_name(index));
        Film::with_sound(&path, FILM_SIZE, FILM_FPS)
    });
    let films = films.collect::<Result<_, _>>().other()?;
    let mut observer = Observer::new(plan.span, films, bars.of(name, plan.span));
    vitriol_run::replay(
        &mut TrackSource::new(plan.track),
        experiment.as_mut(),
        plan.span,
        &mut observer,
    )?;
    let mut observations = observer.finish()?;
    let posters = std::mem::take(&mut observations.posters);
    for film in &observations.films {
        out.adopt(film.clone());
    }
    let outcome = experiment.outcome()?;
    let (scene_name, scene) = match &outcome.scene {
        Some(switched) => {
            let scene = plan.scenes.get(switched)?.with_preset(plan.preset);
            (switched.clone(), scene)
        }
        None => (plan.name.clone(), plan.scene),
    };
    let scene = scene.with_effort(outcome.effort);
    let judged = lesson.as_ref();
    let rubric = judged.map(|(lesson, _)| lesson.rubric());
    let rubric = rubric.unwrap_or_default();
    let retold = judged.map(|(lesson, mode)| Verdict::retold(lesson, *mode, &outcome.progress));
    let recording = recorded.map(|recorded| recorded.against((&plan.name, &plan.scenes), &outcome));
    let mut report = assemble(
        (args, name, plan.chosen),
        &colours,
        plan.preset,
        plan.seed,
        (&scene_name, &scene),
        outcome,
        observations,
    )?;
    report.recording = recording;
    report.lesson = retold.unwrap_or_default();
    let mut texts = Texts::of(args.language).other()?;
    if let Some((lesson, _)) = judged {
        texts.learn(lesson);
    }
    report.judge(&rubric, &texts);
    for (name, picture) in POSTERS.iter().zip(&posters) {
        let file = output::png(picture, FILM_SIZE, ColorType::Rgba)?;
        out.write(name, &file)?;
    }
    // The page first and the numbers last: a folder with `report.json` is a whole run.
    out.write(REPORT_HTML, report.to_html(&texts).as_bytes())?;
    let incidents = (!report.attempts.is_empty()).then_some(INCIDENTS_CSV);
    if let Some(name) = incidents {
        out.write(name, &incidents_csv(&report.attempts).other()?)?;
    }
    out.write(REPORT_JSON, &serde_json::to_vec_pretty(&report).other()?)?;

    let folder = out.join("");
    // Whatever becomes of keeping, the run is whole.
    out.complete();
    let place = |name: &str| folder.join(name).display().to_string();
    Ok(Replayed {
        #[cfg(feature = "class")]
        kept: record.keep(&folder, judged.map(|(lesson, _)| lesson), &report.attempts)?,
        texts,
        report: report.without_series(),
        report_json: place(REPORT_JSON),
        report_html: place(REPORT_HTML),
        incidents_csv: incidents.map(place),
    })
}

/// What the options ask for of a track.
fn ask<'a>(args: &'a ReplayArgs, track: &'a str) -> Ask<'a> {
    Ask {
        track,
        scene: args.scene.as_deref(),
        preset: args.preset,
        budget_ms: args.budget_ms,
        solver: args.solver,
        seconds: args.seconds,
        seed: args.seed,
        device: args.device.as_deref(),
        breakable: args.breakable,
        accept_truncated: args.accept_truncated,
        language: args.language,
    }
}

/// What was recorded, and what is asked for otherwise.
struct Recorded {
    metadata: TrackMetadata,
    said: BTreeMap<String, String>,
    asked: Vec<&'static str>,
    events: Vec<Event>,
    /// Recorded progress of the lesson, where it went through the one that is judged.
    progress: Option<Vec<Progress>>,
}

impl Recorded {
    /// How the run stands to it.
    fn against(self, scene: (&str, &Scenes), outcome: &Outcome) -> RecordingStatement {
        let metadata = &self.metadata;
        let state_hash = self.said.get(STATE_HASH).cloned();
        let same = state_hash
            .as_ref()
            .map(|recorded| *recorded == format!("{:016x}", outcome.state_hash));
        let differs = differences(metadata, scene, Some(&outcome.device), &self.asked);
        if same == Some(false) && differs.is_empty() {
            tracing::warn!(
                "the final state is not the recorded one, and nothing that is known differs; report it"
            );
        }
        RecordingStatement {
            same_progress: self.progress.map(|said| said == outcome.progress),
            same_events: (!self.events.is_empty())
                .then(|| Event::are_same(&self.events, &outcome.events)),
            program_version: metadata.program_version.clone(),
            device: metadata.parameters.get(DEVICE).cloned(),
            driver: metadata.parameters.get(DRIVER).cloned(),
            state_hash,
            same_state: same,
            differs,
        }
    }
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

/// How violently a run boiled, in lines.
fn boiling(report: &Report, texts: &Texts) -> Vec<String> {
    let said = texts.boiling(&report.boiling).into_iter();
    said.map(|it| searchable(&format!("{}: {} ({})", it.name, it.value, it.note)))
        .collect()
}

/// Sentences in a line of a terminal, where spaces that no line breaks at help nobody who searches.
fn searchable(text: &str) -> String {
    in_a_line(text).replace('\u{a0}', " ")
}

fn describe(done: &Replayed) -> String {
    let out = Path::new(&done.report_html)
        .parent()
        .unwrap_or(Path::new(""));
    let report = &done.report;
    let unit = mass(report.mass_kg.total());
    let places: Vec<String> = report
        .mass_kg
        .places()
        .map(|(place, kg)| format!("{} {}", in_a_line(place), with_unit(kg, unit)))
        .collect();
    let mut lines = vec![
        format!(
            "{}, {} s simulated in {} s on {}",
            count(report.fluid_particles, "particle"),
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
    ];
    lines.extend(boiling(report, &done.texts));
    lines.push(format!("state {}", report.state_hash));
    lines.extend(report.recording.iter().map(RecordingStatement::text));
    for ((attempt, score), number) in report.attempts.iter().zip(&report.score).zip(1..) {
        let scene = in_a_line(&attempt.scene);
        let Score { points, of, .. } = score;
        let judged = match *of {
            0 => "nothing was done that could be judged".to_owned(),
            of => format!("{points} of {}", count(of.into(), "point")),
        };
        lines.push(format!("attempt {number}, {scene}: {judged}"));
        let caps = score.caps.iter().map(|it| done.texts.capped(it));
        lines.extend(caps.map(|it| format!("  {}", searchable(&it))));
    }
    for (verdict, number) in report.lesson.iter().zip(1..) {
        let Verdict { points, of, .. } = verdict;
        let (name, of) = (&verdict.lesson, count((*of).into(), "point"));
        lines.push(format!("attempt {number}, lesson {name}: {points} of {of}"));
    }
    lines.push(String::new());
    for film in report.film.iter().chain(&report.film_temperature) {
        lines.push(format!("film    {}", out.join(&film.path).display()));
    }
    lines.push(format!("report  {}", done.report_html));
    if let Some(table) = &done.incidents_csv {
        lines.push(format!("table   {table}"));
    }
    lines.push(format!("numbers {}", done.report_json));
    #[cfg(feature = "class")]
    lines.extend(done.kept.iter().flat_map(Kept::lines));
    lines.join("\n")
}
