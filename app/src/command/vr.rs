//! `vitriol vr`: in the headset, or on its stand-in.

use std::fmt::Write;
use std::io::IsTerminal;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

use serde::Serialize;
use vitriol_experiment::units::{grouped, three_digits};
use vitriol_experiment::{Blame, DeviceStatement, Failure, Format, Scenes, device, emit, track};
use vitriol_gpu::{Gpu, PlainLoader, Timestamps};
use vitriol_lesson::Attempt;
use vitriol_lesson::procedure::Verdict;
use vitriol_sound::Device;
use vitriol_xr::{Headset, OpenXr, OpenXrOptions};

use crate::budget;
use crate::cli::VrArgs;
use crate::command::course;
use crate::command::keeping::{self, Kept, Sitting};
use crate::command::recorded::whole;
use crate::live::{Serving, WatchReport, Watchers};
use crate::vr::blame::blame;
use crate::vr::decision::Decision;
use crate::vr::first_minute::FirstMinuteReport;
use crate::vr::foveating::Foveating;
use crate::vr::menu;
use crate::vr::mirror::Window;
use crate::vr::panel::PANEL;
use crate::vr::record::RecordingStatus;
use crate::vr::session::{
    Contacts, Course, FramesWith, GovernorReport, Options, Session, SessionOutcome, SoundReport,
    Spilt, WARM_UP,
};
use crate::vr::stand_in::{Ready, StandIn, StandInSpec, Timing};
use crate::vr::tally::{FramesReport, Holdings, Spread, WaitsReport};
use crate::vr::workbench::Plan;

/// What `vitriol vr` prints at the session's end.
#[derive(Debug, Serialize)]
struct SessionReport {
    /// The headset, or what stood in for it.
    headset: String,
    device: DeviceStatement,
    scene: String,
    fluid_particles: u64,
    lost_particles: u64,
    nan_particles: u64,
    /// Frames that count.
    frames: u64,
    steps: u64,
    simulated_s: f64,
    /// Time that was shown as slow motion, s.
    slow_motion_s: f64,
    /// Display periods without a picture of their own.
    missed_frames: u64,
    /// Times that a lost session was found again.
    renewals: u64,
    /// Times that a device was lost and the bench was brought back on another.
    devices_lost: u32,
    /// What was done to keep pace with the display.
    governor: GovernorReport,
    /// Where the pictures were to be sharp; absent where that was the governor's to say.
    #[serde(skip_serializing_if = "Option::is_none")]
    foveation: Option<Foveating>,
    /// Processor time of a frame from begin to end, ms.
    #[serde(skip_serializing_if = "Option::is_none")]
    cpu_ms: Option<Spread>,
    /// Of these, frames with nothing beside them.
    #[serde(skip_serializing_if = "Option::is_none")]
    frames_alone: Option<FramesReport>,
    /// Frames while a bench or a picture was built on another thread.
    #[serde(skip_serializing_if = "Option::is_none")]
    frames_while_building: Option<FramesReport>,
    /// The solver's time on the device in a frame, ms.
    #[serde(skip_serializing_if = "Option::is_none")]
    gpu_solver_ms: Option<Spread>,
    /// The picture's, ms.
    #[serde(skip_serializing_if = "Option::is_none")]
    gpu_picture_ms: Option<Spread>,
    /// From a frame's begin to the end of all its work on the device, ms; of a stand-in.
    #[serde(skip_serializing_if = "Option::is_none")]
    ready_ms: Option<Spread>,
    /// Length of a display period, ms; of a stand-in.
    #[serde(skip_serializing_if = "Option::is_none")]
    period_ms: Option<f64>,
    /// From the eyes' location to the picture's submission, ms.
    #[serde(skip_serializing_if = "Option::is_none")]
    pose_age_ms: Option<Spread>,
    /// From the hand's pose to the flask in the picture, simulation steps.
    #[serde(skip_serializing_if = "Option::is_none")]
    input_to_flask_steps: Option<Spread>,
    /// The same, displayed frames.
    #[serde(skip_serializing_if = "Option::is_none")]
    input_to_flask_frames: Option<Spread>,
    /// Sound, and how much of it is buffered.
    sound: SoundReport,
    /// What lies beside the flasks at the end, real mL.
    spilt_ml: Spilt,
    /// Acid that touched the user.
    acid_touched: Contacts,
    /// Flasks that broke.
    flasks_broken: u32,
    /// What was done and what went wrong, from each start of a scene on.
    attempts: Vec<Attempt>,
    /// What the lesson came to.
    #[serde(skip_serializing_if = "Option::is_none")]
    lesson: Option<Verdict>,
    /// What was kept under a pseudonym.
    #[serde(skip_serializing_if = "Option::is_none")]
    kept: Option<Kept>,
    /// What pages saw that looked meanwhile.
    #[serde(skip_serializing_if = "Option::is_none")]
    watched: Option<WatchReport>,
    /// Which of the signs' four steps were done, and when.
    #[serde(skip_serializing_if = "Option::is_none")]
    first_minute: Option<FirstMinuteReport>,
    /// What the process held after warming up and at the end.
    #[serde(skip_serializing_if = "Option::is_none")]
    holdings: Option<[Holdings; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    recording: Option<RecordingStatus>,
    state_hash: String,
}

/// Runs `vitriol vr`.
///
/// # Errors
/// [`Failure::NoDevice`] without runtime or device; [`Failure::Input`] for a scene or track that is
/// not there or a recording that is; [`Failure::Other`].
pub fn run(args: &VrArgs, format: Format) -> Result<(), Failure> {
    let mut scenes = Scenes::default();
    let course = course(args)?;
    let scene = course
        .as_ref()
        .map_or(&args.scene, |it| &it.lesson.scene)
        .clone();
    let mut options = Options {
        plan: Plan {
            scene: scenes.open(&scene)?,
            scenes,
            preset: args.preset,
            breakable: args.breakable,
            seed: args.seed,
            solver: None,
            filter: None,
            tint: args.drawn.tint,
            room: args.drawn.room,
        },
        posture: args.posture,
        grip: args.grip,
        frames: args.frames,
        record: args.record.clone(),
        sound: sound(args),
        governed: !args.fixed,
        foveating: args.foveation,
        hints: !args.no_hints,
        console: None,
        course,
        language: args.language,
    };
    // Before the headset is waited for, so that who directs the session may come in meanwhile.
    let serving = match args.no_console {
        true => None,
        false => Some(Arc::new(Serving::begin(&args.console, true)?)),
    };
    if let Some(serving) = &serving {
        options.console = Some(serving.console().clone());
        serving.invite(format)?;
    }
    let watchers = match (&serving, args.watchers) {
        (Some(serving), Some(count)) => Some(serving.watched(count)?),
        _ => None,
    };
    let (keeper, begun) = (keeping::keeper(&args.keep)?, vitriol_record::Session::now());
    // Nobody reads what nobody governs or measures.
    let timestamps = if options.governed || options.frames.is_some() {
        Timestamps::Whole
    } else {
        Timestamps::None
    };
    if format == Format::Text && std::io::stdin().is_terminal() {
        let invites = !args.no_console && args.console.hub.is_none();
        let mode = options.course.as_ref().map(|it| it.mode);
        eprintln!("{}", menu::lines(invites, mode));
    }
    let worn = |headset: &mut dyn Headset| -> Result<_, Failure> {
        let options = with_solver(args, options, headset.gpu())?;
        let session = begin(headset, options, !args.no_mirror, &serving)?;
        let outcome = session.run(headset)?;
        Ok((headset.name().to_owned(), outcome))
    };
    let ((name, outcome), stand_in) = match &args.stand_in {
        Some(wearer) => {
            let gpu = device::timed(args.device.as_deref(), timestamps)?;
            let spec = StandInSpec {
                extent: args.size,
                rate_hz: args.rate,
                timing: Timing::Real,
            };
            let opened = gpu.options().clone();
            let mut headset =
                StandIn::new(&gpu, whole(wearer, track::load(wearer)?, true)?, spec).other()?;
            headset = headset.reopening(move || Gpu::open(&mut PlainLoader::default(), &opened));
            (worn(&mut headset)?, Some((spec, headset.ready())))
        }
        None => {
            let opened = OpenXrOptions {
                gpu: vitriol_gpu::Options {
                    timestamps,
                    pipelines: device::pipelines(),
                    ..vitriol_gpu::Options::default()
                },
                instance_extensions: Vec::new(),
                device_extensions: Vec::new(),
                gaze: args.foveation == Some(Foveating::Eye),
                panel: PANEL,
            };
            let mut told = false;
            let waits = |remedy: &str| {
                if !std::mem::replace(&mut told, true) {
                    eprintln!("{remedy} Waiting for it; Ctrl-C ends.");
                }
                true
            };
            let mut headset = OpenXr::open(opened, waits).map_err(blame)?;
            (worn(&mut headset)?, None)
        }
    };
    let mut report = state(name, &outcome, stand_in)?;
    report.watched = watchers.map(Watchers::report);
    let sitting = Sitting {
        session: sitting(args, begun),
        source: args.record.as_deref(),
        out: None,
    };
    let kept = keeping::keep_under(&args.keep, &keeper, &sitting, &report.attempts);
    // What could not be kept is at least said.
    let failure = match kept {
        Ok(kept) => {
            report.kept = kept;
            None
        }
        Err(failure) => Some(failure),
    };
    emit(format, &report, describe)?;
    failure.map_or(Ok(()), Err)
}

/// The lesson that is asked for, which its scene has all for.
fn course(args: &VrArgs) -> Result<Option<Course>, Failure> {
    let Some(name) = &args.lesson else {
        return Ok(None);
    };
    let (lesson, mode) = course::named(name, args.mode)?;
    Ok(Some(Course {
        lesson,
        mode,
        language: args.language,
    }))
}

/// This sitting; with a recording that recording's, so that its replay keeps nothing twice.
fn sitting(args: &VrArgs, begun: vitriol_record::Session) -> vitriol_record::Session {
    let content = args
        .record
        .as_ref()
        .and_then(|file| std::fs::read(file).ok());
    content.map_or(begun, |content| {
        vitriol_record::Session::of_recording(&content, begun.begun)
    })
}

/// Where sound is played: nobody hears a stand-in unless an output is named.
fn sound(args: &VrArgs) -> Device {
    match args.sound.as_deref() {
        Some("none") => Device::Silent,
        Some(name) => Device::Named(name.to_owned()),
        None if args.stand_in.is_some() => Device::Silent,
        None => Device::Default,
    }
}

/// A session that hears the computer's keys, and has a window there if it is to be `mirrored` and
/// there is a screen.
fn begin(
    headset: &dyn Headset,
    options: Options,
    mirrored: bool,
    serving: &Option<Arc<Serving>>,
) -> Result<Session, Failure> {
    let (decisions, taken) = keys(serving.clone())?;
    let session = Session::new(headset, options, taken)?;
    if !mirrored {
        return Ok(session);
    }
    match Window::open(headset.extent(), decisions) {
        Ok(window) => session.mirrored(window),
        Err(cause) => {
            tracing::warn!("no mirror window: {cause}");
            Ok(session)
        }
    }
}

/// These with the substeps and iterations that are asked for, or hold the budget.
fn with_solver(args: &VrArgs, mut options: Options, gpu: &Gpu) -> Result<Options, Failure> {
    if args.solver.is_some() || args.budget_ms.is_some() {
        let plan = &mut options.plan;
        let scene = plan.scenes.get(&plan.scene)?.with_preset(plan.preset);
        let gpu = || Ok(gpu.clone());
        plan.solver = budget::chosen(args.solver, args.budget_ms, &scene, gpu)?;
    }
    Ok(options)
}

/// What is typed into the terminal, a line each; and the end, where the program is asked for it
/// (Ctrl-C, SIGTERM): the runtime is told, and the recording is whole.
fn keys(serving: Option<Arc<Serving>>) -> Result<(Sender<Decision>, Receiver<Decision>), Failure> {
    let (decisions, taken) = channel();
    let of_window = decisions.clone();
    let asked = decisions.clone();
    ctrlc::set_handler(move || {
        // A session that has ended hears nothing.
        let _ = asked.send(Decision::End);
    })
    .other()?;
    if std::io::stdin().is_terminal() {
        std::thread::spawn(move || {
            for line in std::io::stdin().lines().map_while(Result::ok) {
                let key = line.trim().chars().next();
                if key.is_some_and(|key| key.eq_ignore_ascii_case(&menu::INVITE)) {
                    let invited = serving.as_ref().map(|it| it.invite(Format::Text));
                    if let Some(Err(failure)) = invited {
                        tracing::warn!("nobody is let in: {failure}");
                    }
                }
                let decided = key.and_then(menu::decision);
                if decided.is_some_and(|decided| decisions.send(decided).is_err()) {
                    return;
                }
            }
        });
    }
    Ok((of_window, taken))
}

fn state(
    headset: String,
    outcome: &SessionOutcome,
    stand_in: Option<(StandInSpec, Vec<Ready>)>,
) -> Result<SessionReport, Failure> {
    let world = &outcome.bench.world;
    let measured = world.measure().other()?;
    let tally = &outcome.tally;
    let counted: Vec<f64> = stand_in.as_ref().map_or_else(Vec::new, |(_, ready)| {
        let counted = ready.iter().filter(|frame| frame.index >= WARM_UP);
        counted
            .map(|frame| 1e3 * frame.after.as_secs_f64())
            .collect()
    });
    let period = stand_in.as_ref().map(|(spec, _)| 1e3 / spec.rate_hz);
    let late = counted.iter().filter(|ready| Some(**ready) > period);
    Ok(SessionReport {
        headset,
        device: device::statement(world.gpu()),
        scene: outcome.bench.plan.scene.clone(),
        fluid_particles: world.solver().count().into(),
        lost_particles: measured.lost_particles,
        nan_particles: measured.nan_particles,
        frames: outcome.frames.saturating_sub(WARM_UP),
        steps: outcome.steps,
        simulated_s: outcome.simulated,
        slow_motion_s: outcome.slowed,
        missed_frames: outcome.skipped + late.count() as u64,
        renewals: outcome.renewals,
        devices_lost: outcome.devices_lost,
        governor: outcome.governor.clone(),
        foveation: outcome.foveating,
        cpu_ms: Spread::of(&tally.cpu_ms),
        frames_alone: tally.alone.report(),
        frames_while_building: tally.building.report(),
        gpu_solver_ms: Spread::of(&tally.solve_ms),
        gpu_picture_ms: Spread::of(&tally.picture_ms),
        ready_ms: Spread::of(&counted),
        period_ms: period,
        pose_age_ms: Spread::of(&tally.pose_age_ms),
        input_to_flask_steps: Spread::of(&tally.delay_steps),
        input_to_flask_frames: Spread::of(&tally.delay_frames),
        sound: outcome.sound.clone(),
        spilt_ml: outcome.spilt,
        acid_touched: outcome.contacts,
        flasks_broken: outcome.broken,
        attempts: outcome.attempts.clone(),
        lesson: outcome.verdict.clone(),
        kept: None,
        watched: None,
        first_minute: outcome.first_minute,
        holdings: match outcome.holdings {
            [Some(before), Some(after)] => Some([before, after]),
            _ => None,
        },
        recording: outcome.recorded.clone(),
        state_hash: format!("{:016x}", world.snapshot().other()?.solver.hash()),
    })
}

/// What the governor did, a line for each setting.
fn governed(governor: &GovernorReport) -> String {
    if !governor.on {
        let cause = governor.cause.as_deref().unwrap_or("as was asked for");
        return format!("settings fixed: {cause}\n");
    }
    let mut text = format!("settings changed {} times to keep pace\n", governor.changes);
    for FramesWith { setting, frames } in &governor.settings {
        let [substeps, iterations] = setting.solver;
        let picture = 100.0 * setting.resolution;
        let aside = match setting.foveated {
            true => ", fewer pixels aside",
            false => "",
        };
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "  {substeps} × {iterations}, picture {picture:.0} %{aside}, {:?}: {} frames",
            setting.filter,
            grouped(*frames)
        );
    }
    text
}

/// "3 times, 0.12 ms in all, 0.08 ms at most".
fn waited(waits: &WaitsReport) -> String {
    let WaitsReport {
        waits,
        total_ms,
        longest_ms,
    } = waits;
    if *waits == 0 {
        return "never".into();
    }
    format!(
        "{} times, {total_ms:.3} ms in all, {longest_ms:.3} ms at most",
        grouped(*waits)
    )
}

fn describe(session: &SessionReport) -> String {
    let mut text = format!(
        "{}\n{}, {} particles; {} steps, {} s simulated, {} s of slow motion; lost {}, not finite {}\n\
         {} frames, {} missed\n",
        session.headset,
        session.scene,
        grouped(session.fluid_particles),
        session.steps,
        three_digits(session.simulated_s),
        three_digits(session.slow_motion_s),
        session.lost_particles,
        session.nan_particles,
        session.frames,
        session.missed_frames,
    );
    text += &governed(&session.governor);
    text += match session.foveation {
        Some(Foveating::Off) => "every pixel shaded\n",
        Some(Foveating::Eye) => {
            "every pixel shaded about where the user looks, if known, fewer beyond\n"
        }
        Some(Foveating::Fixed) => "every pixel shaded about the lenses' axes, fewer beyond\n",
        // The settings say it.
        None => "",
    };
    let rows = [
        ("processor, a frame, ms", session.cpu_ms),
        (
            "  while one builds, ms",
            session.frames_while_building.map(|frames| frames.cpu_ms),
        ),
        ("device, solver, ms", session.gpu_solver_ms),
        ("device, picture, ms", session.gpu_picture_ms),
        ("from begin to done, ms", session.ready_ms),
        ("age of the eyes' pose, ms", session.pose_age_ms),
        ("hand to flask, steps", session.input_to_flask_steps),
        ("hand to flask, frames", session.input_to_flask_frames),
        (
            "from a page's order to done, ms",
            session.watched.as_ref().and_then(|it| it.switch_ms),
        ),
    ];
    text += "                                median      95 %      99 %      most\n";
    for (name, spread) in rows {
        if let Some(Spread { p50, p95, p99, max }) = spread {
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "{name:<28} {p50:>9.3} {p95:>9.3} {p99:>9.3} {max:>9.3}"
            );
        }
    }
    for (kind, frames) in [
        ("alone", session.frames_alone),
        ("while one builds", session.frames_while_building),
    ] {
        if let Some(FramesReport {
            frames,
            queue_lock,
            memory_lock,
            ..
        }) = frames
        {
            let _ = writeln!(
                text,
                "{} frames {kind}: waited for the queue {}, for memory {}",
                grouped(frames),
                waited(&queue_lock),
                waited(&memory_lock)
            );
        }
    }
    if let (Some(period), Some(ready)) = (session.period_ms, session.ready_ms) {
        let _ = writeln!(
            text,
            "left of {period:.2} ms: {:.2} ms in the 99th percentile",
            period - ready.p99
        );
    }
    let sound = &session.sound;
    let _ = match (&sound.buffered_ms, &sound.cause) {
        (Some(held), None) => writeln!(
            text,
            "sound: {held:.1} ms buffered, ran dry {} times",
            sound.underflows
        ),
        (_, Some(cause)) => writeln!(text, "no sound: {cause}"),
        (None, None) => Ok(()),
    };
    if let Some([before, after]) = session.holdings {
        let _ = writeln!(
            text,
            "memory {} to {} MB, {} to {} handles",
            before.memory / 1_000_000,
            after.memory / 1_000_000,
            before.handles,
            after.handles
        );
    }
    if let Some(recording) = &session.recording {
        let _ = writeln!(
            text,
            "recorded {} steps, not {}{}",
            grouped(recording.steps),
            recording.unwritten,
            recording
                .cause
                .as_ref()
                .map_or_else(String::new, |cause| format!(": {cause}"))
        );
    }
    if let Some(verdict) = &session.lesson {
        let Verdict {
            lesson, points, of, ..
        } = verdict;
        let _ = writeln!(text, "lesson {lesson}: {points} of {of} points");
    }
    let _ = write!(text, "state {}", session.state_hash);
    text
}
