//! `vitriol vr`: in the headset, or on its stand-in.

#[cfg(feature = "vr")]
mod headset;
mod report;

use std::io::IsTerminal;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

use vitriol_gpu::{Gpu, PlainLoader, Timestamps, vk};
use vitriol_lesson::Texts;
use vitriol_run::{Blame, Failure, Format, Scenes, device, emit, track};
use vitriol_sound::Device;
use vitriol_xr::Headset;

use crate::cli::VrArgs;
use crate::command::course;
use crate::command::keeping::{self, Sitting};
use crate::command::recorded::whole;
use vitriol_live::{Serving, Watchers};
use vitriol_run::budget;
use vitriol_session::decision::Decision;
use vitriol_session::menu;
use vitriol_session::mirror::Window;
use vitriol_session::session::{Course, Options, Session};
use vitriol_session::stand_in::{StandIn, StandInSpec, Timing};
use vitriol_session::workbench::Plan;

/// Runs `vitriol vr`.
///
/// # Errors
/// [`Failure::NoDevice`] without runtime or device; [`Failure::Input`] for a scene or track that is
/// not there or a recording that is; [`Failure::Other`].
pub fn run(args: &VrArgs, format: Format) -> Result<(), Failure> {
    #[cfg(not(feature = "vr"))]
    if args.stand_in.is_none() {
        return no_headset();
    }
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
        // A pseudonym is there so that the name is not.
        student: args
            .console
            .name
            .clone()
            .filter(|_| args.keep.pseudonym.is_none()),
    };
    // Before the console's address is printed: without a runtime there is nothing to direct.
    #[cfg(feature = "vr")]
    if args.stand_in.is_none() {
        headset::check()?;
    }
    // Before the headset is waited for, so that who directs the session may come in meanwhile.
    let serving = match args.no_console {
        true => None,
        false => Some(Arc::new(Serving::begin(
            &args.console,
            args.language,
            true,
        )?)),
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
        let texts = Texts::of(args.language).other()?;
        eprintln!("{}", menu::lines(&texts, invites, mode));
    }
    let course = options.course.as_ref();
    let rubric = course.map(|it| it.lesson.rubric()).unwrap_or_default();
    let worn = |headset: &mut dyn Headset| -> Result<_, Failure> {
        let options = with_solver(args, options, headset.gpu())?;
        let session = begin(headset, options, !args.no_mirror, &serving)?;
        if args.stand_in.is_some() && format == Format::Text {
            eprintln!("the stand-in runs; Ctrl-C ends it");
        }
        let outcome = session.run(headset)?;
        Ok((headset.name().to_owned(), outcome))
    };
    let ((name, outcome), stand_in) = match &args.stand_in {
        Some(wearer) => {
            let track = whole(wearer, track::load(wearer)?, true)?;
            let gpu = device::timed(args.device.as_deref(), timestamps)?;
            if format == Format::Text {
                eprintln!("{}", starting(&gpu.info().name, gpu.info().kind));
            }
            let spec = StandInSpec {
                extent: args.size,
                rate_hz: args.rate,
                timing: Timing::Real,
            };
            let opened = gpu.options().clone();
            let mut headset = StandIn::new(&gpu, track, spec).other()?;
            headset = headset.reopening(move || Gpu::open(&mut PlainLoader::default(), &opened));
            (worn(&mut headset)?, Some((spec, headset.ready())))
        }
        #[cfg(feature = "vr")]
        None => (worn(&mut headset::open(args.foveation, timestamps)?)?, None),
        #[cfg(not(feature = "vr"))]
        None => return no_headset(),
    };
    let mut report = report::report(name, &outcome, stand_in)?;
    report.watched = watchers.map(Watchers::report);
    let sitting = Sitting {
        session: sitting(args, begun),
        source: args.record.as_deref(),
        out: None,
        rubric: &rubric,
    };
    let kept = keeping::keep_under(&args.keep, &keeper, &sitting, &report.attempts);
    // What could not be kept is at least reported.
    let failure = match kept {
        Ok(kept) => {
            report.kept = kept;
            None
        }
        Err(failure) => Some(failure),
    };
    emit(format, &report, report::describe)?;
    failure.map_or(Ok(()), Err)
}

/// Says that the build has no OpenXR.
#[cfg(not(feature = "vr"))]
fn no_headset() -> Result<(), Failure> {
    use crate::cli::left_out::REMEDY;
    Err(format!(
        "this build leaves headsets out: give --stand-in, or {REMEDY}"
    ))
    .input()
}

/// Says that the stand-in starts on that device, which may take minutes, and whether it will be fast enough.
fn starting(device: &str, kind: vk::PhysicalDeviceType) -> String {
    let mut text = format!("the stand-in starts on {device}: scene and shaders are made ready");
    if kind == vk::PhysicalDeviceType::CPU {
        text += "\nthat is a software driver, on which this is no session in real time: its frames take longer than \
                 they are shown; choose a graphics card with --device (see `vitriol doctor`)";
    }
    text
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

/// A session that takes the computer's keys, and has a window there if it is to be `mirrored` and
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
        // A session that has ended takes no decisions.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Who waits for a stand-in is told of a device that is too slow, and of no other.
    #[test]
    fn a_software_driver_is_no_real_time() {
        for (kind, slow) in [
            (vk::PhysicalDeviceType::CPU, true),
            (vk::PhysicalDeviceType::DISCRETE_GPU, false),
        ] {
            let text = starting("Voodoo", kind);
            assert!(text.contains("starts on Voodoo"), "{text}");
            assert_eq!(text.contains("no session in real time"), slow, "{text}");
        }
    }
}
