//! `vitriol export`: a run in other programs' formats.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::Serialize;
use vitriol_export::{Export, Format as Exported, Origin, TableFormat, Times};
use vitriol_run::output::{OutDir, REPORT_JSON};
use vitriol_run::progress::Runs;
use vitriol_run::track::{DEVICE, DRIVER, PRESET};
use vitriol_run::units::{count, data};
use vitriol_run::{
    Blame, Colour, Experiment, FILM_SIZE, Failure, Format, Laboratory, Setup, device, emit,
};
use vitriol_shaders::Library;
use vitriol_sim::scene::{Preset, Scene};
use vitriol_xr::files;
use vitriol_xr::track::{TrackMetadata, TrackSource};

use crate::cli::ExportArgs;
use crate::command::plan::{Ask, ReplayPlan};
use crate::command::stem;
use crate::report::{LAYOUT, Report};

/// Most of a report's file, B: a run of a million steps of 1/90 s has 111,000 samples of 1 to 2 kB.
const REPORT: u64 = 256 << 20;

/// What `vitriol export` prints.
#[derive(Debug, Serialize)]
struct Done {
    /// The folder.
    folder: PathBuf,
    /// The formats.
    formats: Vec<&'static str>,
    /// Moments that were written.
    moments: u64,
    /// Files in all, and their bytes.
    files: usize,
    bytes: u64,
    /// Hash of the final state, hexadecimal, where the run was simulated.
    state_hash: Option<String>,
    /// Whether it is that of the report, where a whole run was exported.
    same_state: Option<bool>,
}

/// Runs `vitriol export`.
///
/// # Errors
/// [`Failure::Input`] for bad run, track, scene or folder, [`Failure::NoDevice`], [`Failure::Other`]; no file or new folder
/// is left then.
pub fn run(args: &ExportArgs, format: Format) -> Result<(), Failure> {
    let report = report(&args.input)?;
    if args.at.is_some() && args.format.iter().any(|format| format.table().is_some()) {
        return Err(
            "--at: a table has samples over time; leave csv and parquet out, or take --seconds"
                .to_owned(),
        )
        .input();
    }
    // Once each.
    let mut formats: Vec<Exported> = Vec::new();
    for format in &args.format {
        if !formats.contains(format) {
            formats.push(*format);
        }
    }
    let out = OutDir::take(args.out.as_deref(), &stem(&args.input))?;
    let tables: Option<Vec<_>> = formats.iter().map(|format| format.table()).collect();
    let done = match (&report, tables) {
        (Some(report), Some(tables)) if is_whole(args) => of_report(report, &tables, out)?,
        _ => simulated(args, report.as_ref(), &formats, format, out)?,
    };
    emit(format, &done, describe)
}

/// Whether nothing but the run as it was is asked for.
fn is_whole(args: &ExportArgs) -> bool {
    args.at.is_none()
        && args.from.is_none()
        && args.seconds.is_none()
        && args.scene.is_none()
        && args.preset.is_none()
        && args.solver.is_none()
        && args.seed.is_none()
}

/// The report, where the input is a run's folder or its report.
fn report(input: &str) -> Result<Option<Report>, Failure> {
    let path = Path::new(input);
    let file = if path.is_dir() {
        path.join(REPORT_JSON)
    } else if path.file_name().is_some_and(|name| name == REPORT_JSON) {
        path.to_owned()
    } else {
        return Ok(None);
    };
    let text = files::read_text(&file, "report", REPORT).input()?;
    // The layout first: another one may not even be read.
    #[derive(serde::Deserialize)]
    struct Layout {
        layout: Option<u32>,
    }
    let wrong = |error| {
        let file = file.display();
        format!("{file}: is no report of a run: {error}; make it again with `vitriol replay`")
    };
    let layout: Layout = serde_json::from_str(&text).map_err(wrong).input()?;
    // Reports of the first one name none.
    let layout = layout.layout.unwrap_or(1);
    if layout != LAYOUT {
        return Err(format!(
            "{}: has the layout {layout}, and this program reads {LAYOUT}; export it with the program that made it",
            file.display()
        ))
        .input();
    }
    serde_json::from_str(&text).map(Some).map_err(wrong).input()
}

/// Tables of what a report has already.
fn of_report(report: &Report, formats: &[TableFormat], mut out: OutDir) -> Result<Done, Failure> {
    if report.series.is_empty() {
        return Err("the report has no series, as what `vitriol replay --json` prints has none; give the run's folder".to_owned())
            .input();
    }
    vitriol_export::tables(&report.series, report.scenes_before, formats, &mut out)?;
    finished(out, formats.iter().map(|format| format.name()), 0)
}

/// What a run is simulated for.
fn simulated(
    args: &ExportArgs,
    report: Option<&Report>,
    formats: &[Exported],
    format: Format,
    out: OutDir,
) -> Result<Done, Failure> {
    let made = match report {
        Some(report) => made(report)?,
        None => Ask {
            track: &args.input,
            ..Ask::default()
        },
    };
    let ask = Ask {
        track: args.track.as_deref().unwrap_or(made.track),
        scene: args.scene.as_deref().or(made.scene),
        preset: args.preset.or(made.preset),
        // That of the run belongs to its scene and preset.
        solver: args.solver.or(made
            .solver
            .filter(|_| args.preset.is_none() && args.scene.is_none())),
        seconds: args.at.or(args.seconds).or(made.seconds),
        seed: args.seed.or(made.seed),
        device: args.device.as_deref(),
        accept_truncated: args.accept_truncated || made.accept_truncated,
        ..made
    };
    let plan = ReplayPlan::new(&ask)?;
    let times = times(args, &plan, made.seconds)?;
    let gpu = device::open(args.device.as_deref())?;
    let films = formats.contains(&Exported::Mcap);
    let mut laboratory = Laboratory::new(
        &gpu,
        &Setup {
            picture: films.then_some(FILM_SIZE),
            colours: films.then_some(Colour::Liquid).into_iter().collect(),
            shaders: Arc::new(Library::watching()),
            ..plan.setup(args.device.as_deref())
        },
    )?;
    let origin = Origin {
        metadata: metadata(&plan, &device::statement(&gpu)),
        solver: plan.chosen,
    };
    let progress = Runs::new(format).of(&args.input, plan.span);
    let mut export = Export::new(formats, times, (plan.span, progress), &origin, out)?;
    let span = plan.span;
    vitriol_run::replay(
        &mut TrackSource::new(plan.track),
        &mut laboratory,
        span,
        &mut export,
    )?;
    let outcome = laboratory.outcome()?;
    let (out, moments) = export.finish(outcome.state_hash)?;
    let names = formats.iter().map(|format| format.name());
    let mut done = finished(out, names, moments)?;
    let hash = format!("{:016x}", outcome.state_hash);
    let whole = report.filter(|_| is_whole(args));
    done.same_state = whole.map(|report| report.state_hash == hash);
    if done.same_state == Some(false) {
        tracing::warn!(
            "the final state is not the report's: device, driver or version differ, or the track did change"
        );
    }
    done.state_hash = Some(hash);
    Ok(done)
}

/// How a report's run was made.
///
/// A report may come from anyone, as a track may: a scene's file is opened where the user names it, and not the report.
/// (The track's is: the track reader's error for another kind of file reveals nothing of its contents.)
fn made(report: &Report) -> Result<Ask<'_>, Failure> {
    let name = &report.preset;
    let preset = Preset::ALL.into_iter().find(|preset| preset.name() == name);
    if preset.is_none() {
        return Err(format!(
            "the report names a preset {name:?}, which there is not"
        ))
        .input();
    }
    let made = Ask {
        track: &report.track,
        preset,
        seed: Some(report.seed),
        ..Ask::default()
    };
    let Some(asked) = &report.asked else {
        return Ok(Ask {
            scene: Scene::builtin_text(&report.scene.name).map(|_| &*report.scene.name),
            solver: Some([report.solver.substeps, report.solver.iterations]),
            seconds: Some(report.simulated_s),
            ..made
        });
    };
    if let Some(scene) = &asked.scene
        && Scene::builtin_text(scene).is_none()
    {
        return Err(format!(
            "the report names the scene's file {scene:?}; if you trust it, name it with --scene"
        ))
        .input();
    }
    Ok(Ask {
        scene: asked.scene.as_deref(),
        solver: asked.solver,
        seconds: asked.seconds,
        breakable: asked.breakable,
        accept_truncated: asked.accept_truncated,
        ..made
    })
}

/// When moments are exported.
fn times(args: &ExportArgs, plan: &ReplayPlan, whole: Option<f64>) -> Result<Times, Failure> {
    let from = args.at.or(args.from).unwrap_or(0.0);
    // With --at the span is as long as that.
    let end = match args.at {
        Some(_) => whole.unwrap_or_else(|| plan.track.duration()),
        None => plan.span.seconds(),
    };
    plan.reaches(from, end)?;
    Ok(Times {
        from,
        rate: args.at.is_none().then_some(args.rate),
    })
}

/// The metadata of an exported recording: it replays like one that was recorded.
fn metadata(plan: &ReplayPlan, device: &vitriol_run::DeviceStatement) -> TrackMetadata {
    let mut metadata = TrackMetadata {
        scene: plan.name.clone(),
        seed: plan.seed,
        program_version: env!("CARGO_PKG_VERSION").into(),
        ..plan.track.metadata.clone()
    };
    let own = plan
        .scenes
        .own()
        .filter_map(|name| Some((name, plan.scenes.text(name)?)));
    metadata
        .scenes
        .extend(own.map(|(name, text)| (name.to_owned(), text.into_owned())));
    // Of keyframes, which it is not any more.
    metadata.parameters.remove("track");
    for (key, value) in [
        (PRESET, plan.preset.name()),
        (DEVICE, &device.name),
        (DRIVER, &device.driver),
    ] {
        metadata.parameters.insert(key.into(), value.into());
    }
    metadata
}

/// Counts what is there, and keeps it.
fn finished(
    out: OutDir,
    formats: impl Iterator<Item = &'static str>,
    moments: u64,
) -> Result<Done, Failure> {
    let (files, bytes) = out.sizes()?;
    let folder = out.path.clone();
    out.complete();
    Ok(Done {
        folder,
        formats: formats.collect(),
        moments,
        files,
        bytes,
        state_hash: None,
        same_state: None,
    })
}

fn describe(done: &Done) -> String {
    let mut text = format!(
        "{} of {} in {}",
        count(done.files as u64, "file"),
        data(done.bytes),
        done.folder.display()
    );
    if done.moments > 0 {
        text += &format!(", {}", count(done.moments, "moment"));
    }
    if let Some(hash) = &done.state_hash {
        text += &format!("\nstate {hash}");
    }
    if done.same_state == Some(true) {
        text += ", the report's to the bit";
    }
    text
}
