//! What all sessions have, in a headset or in a window, from their arguments to the report at their end.

pub mod report;

use std::io::IsTerminal;
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::Sender;

use vitriol_gpu::{Gpu, Timestamps, vk};
use vitriol_lesson::Texts;
use vitriol_run::{Blame, Failure, Format, Scenes, emit, track};
use vitriol_sim::scene::{Preset, Scene};
use vitriol_sound::Device;
use vitriol_xr::files;
use vitriol_xr::track::TrackError;

use self::report::SessionReport;
use crate::cli::SessionArgs;
use crate::command::course;
use crate::command::keeping::{self, Keeper, Sitting};
use vitriol_live::Serving;
use vitriol_run::budget;
use vitriol_session::decision::Decision;
use vitriol_session::menu;
use vitriol_session::placement::Posture;
use vitriol_session::session::{Course, Options};
use vitriol_session::workbench::Plan;

/// A session that is about to begin: its console serves, and the class's file was opened.
pub struct Prepared<'a> {
    args: &'a SessionArgs,
    format: Format,
    options: Options,
    serving: Option<Arc<Serving>>,
    keeper: Keeper,
    begun: vitriol_record::Session,
}

impl<'a> Prepared<'a> {
    /// Prepares a session with these options. The console's address goes to standard error, and so do the terminal's keys where somebody
    /// can type.
    ///
    /// # Errors
    /// [`Failure::Input`] for a console or a class's file that cannot be had.
    pub fn new(
        args: &'a SessionArgs,
        format: Format,
        mut options: Options,
    ) -> Result<Self, Failure> {
        let (keeper, begun) = (keeping::keeper(&args.keep)?, vitriol_record::Session::now());
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
        if format == Format::Text && std::io::stdin().is_terminal() {
            let invites = !args.no_console && args.console.hub.is_none();
            let mode = options.course.as_ref().map(|it| it.mode);
            let texts = Texts::of(args.language).other()?;
            eprintln!("{}", menu::lines(&texts, invites, mode, options.pointer));
        }
        Ok(Self {
            args,
            format,
            options,
            serving,
            keeper,
            begun,
        })
    }

    /// The instructor's end, if there is one.
    pub fn serving(&self) -> Option<&Arc<Serving>> {
        self.serving.as_ref()
    }

    /// Its options, with the substeps and iterations that are asked for, or that hold the budget on this device.
    ///
    /// # Errors
    /// [`Failure::Input`] for a budget that no setting holds; an error of the device.
    pub fn solved(&self, gpu: &Gpu) -> Result<Options, Failure> {
        let mut options = self.options.clone();
        if self.args.solver.is_some() || self.args.budget_ms.is_some() {
            let plan = &mut options.plan;
            let scene = plan.scenes.get(&plan.scene)?.with_preset(plan.preset);
            let gpu = || Ok(gpu.clone());
            plan.solver = budget::chosen(self.args.solver, self.args.budget_ms, &scene, gpu)?;
        }
        Ok(options)
    }

    /// Sends what is typed into the terminal to `decisions`, a line each; and the end, where the program is asked for it
    /// (Ctrl-C, SIGTERM): so the recording is whole.
    ///
    /// # Errors
    /// [`Failure::Other`] where the system lets nobody ask.
    pub fn take_keys(&self, decisions: Sender<Decision>) -> Result<(), Failure> {
        let asked = decisions.clone();
        ctrlc::set_handler(move || {
            // A session that has ended takes no decisions.
            let _ = asked.send(Decision::End);
        })
        .other()?;
        if !std::io::stdin().is_terminal() {
            return Ok(());
        }
        let serving = self.serving.clone();
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
        Ok(())
    }

    /// Keeps the attempts under the pseudonym that was given, and prints the report.
    ///
    /// # Errors
    /// What could not be kept, after the report; [`Failure::Other`] where that cannot be written.
    pub fn end(self, mut report: SessionReport) -> Result<(), Failure> {
        let course = self.options.course.as_ref();
        let sitting = Sitting {
            session: sitting(self.args, self.begun),
            source: self.args.record.as_deref(),
            out: None,
            lesson: course.map(|it| &it.lesson),
        };
        let attempts = &report.outcome.attempts;
        let kept = keeping::keep_under(&self.args.keep, &self.keeper, &sitting, attempts);
        // What could not be kept is at least reported.
        let failure = match kept {
            Ok(kept) => {
                report.kept = kept;
                None
            }
            Err(failure) => Some(failure),
        };
        let recorded = report.outcome.recorded.is_some();
        let file = self.args.record.as_deref().filter(|_| recorded);
        let lesson = self.args.lesson.as_deref();
        // Built-in scenes are accepted as they are, and a lesson's are.
        let is_own = |scene: &&str| lesson.is_none() && Scene::builtin_text(scene).is_none();
        let own_scene = Some(self.args.scene.as_str()).filter(is_own);
        let next = file.map(|file| report::next(file, (lesson, self.args.mode), own_scene));
        emit(self.format, &report, |it| {
            report::describe(it) + next.as_deref().unwrap_or_default()
        })?;
        failure.map_or(Ok(()), Err)
    }
}

/// The options of a session in a headset, whose posture and foveation are not asked for. Nothing is opened yet, no window either, when a
/// recording that cannot be made is refused.
///
/// # Errors
/// [`Failure::Input`] for a scene or a lesson that is not there, or a recording that is; [`Failure::Other`] for one in a folder that is not.
pub fn options(args: &SessionArgs) -> Result<Options, Failure> {
    if let Some(file) = &args.record {
        can_be_made(file).map_err(track::blame)?;
    }
    let mut scenes = Scenes::default();
    let course = course(args)?;
    let scene = course
        .as_ref()
        .map_or(&args.scene, |it| &it.lesson.scene)
        .clone();
    Ok(Options {
        plan: Plan {
            scene: scenes.open(&scene)?,
            scenes,
            preset: args.preset.unwrap_or(Preset::Balanced),
            breakable: args.breakable,
            seed: args.seed,
            solver: None,
            filter: None,
            tint: args.drawn.tint,
            room: args.drawn.room,
        },
        posture: Posture::default(),
        grip: args.grip,
        pointer: false,
        frames: args.frames,
        record: args.record.clone(),
        sound: match args.sound.as_deref() {
            Some("none") => Device::Silent,
            Some(name) => Device::Named(name.to_owned()),
            None => Device::Default,
        },
        governed: !args.fixed,
        foveating: None,
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
    })
}

/// Whether a recording can be made there, as far as can be told without making it.
fn can_be_made(file: &Path) -> Result<(), TrackError> {
    let at = || file.to_owned();
    if !files::is_absent(file) {
        return Err(TrackError::Exists { file: at() });
    }
    // That of a bare name is empty.
    let folder = file.parent().filter(|it| !it.as_os_str().is_empty());
    let there = folder.map_or(Ok(()), |it| std::fs::metadata(it).map(drop));
    there.map_err(|source| TrackError::Io {
        file: at(),
        action: "create",
        source,
    })
}

/// The lesson that is asked for, which its scene has all for.
fn course(args: &SessionArgs) -> Result<Option<Course>, Failure> {
    let Some(name) = &args.lesson else {
        return Ok(None);
    };
    let (lesson, mode) = course::named(name, args.mode, args.language)?;
    Ok(Some(Course {
        lesson,
        mode,
        language: args.language,
    }))
}

/// The timestamps that a session with these options needs: nobody reads what nobody governs or measures.
pub fn timestamps(options: &Options) -> Timestamps {
    match options.governed || options.frames.is_some() {
        true => Timestamps::Whole,
        false => Timestamps::None,
    }
}

/// Says that `what` starts on that device, which may take minutes, and whether it will be fast enough.
pub fn starting(what: &str, device: &str, kind: vk::PhysicalDeviceType) -> String {
    let mut text = format!("{what} starts on {device}: scene and shaders are made ready");
    if kind == vk::PhysicalDeviceType::CPU {
        text += "\nthat is a software driver, on which this is no session in real time: its frames take longer than \
                 they are shown, so it runs in slow motion; choose a graphics card with --device (see `vitriol doctor`)";
    }
    text
}

/// This sitting; with a recording that recording's, so that its replay keeps nothing twice.
fn sitting(args: &SessionArgs, begun: vitriol_record::Session) -> vitriol_record::Session {
    let content = args
        .record
        .as_ref()
        .and_then(|file| std::fs::read(file).ok());
    content.map_or(begun, |content| {
        vitriol_record::Session::of_recording(&content, begun.begun)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Who waits for a session is told of a device that is too slow, and of no other.
    #[test]
    fn a_software_driver_is_no_real_time() {
        for (kind, slow) in [
            (vk::PhysicalDeviceType::CPU, true),
            (vk::PhysicalDeviceType::DISCRETE_GPU, false),
        ] {
            let text = starting("the stand-in", "Voodoo", kind);
            assert!(text.contains("starts on Voodoo"), "{text}");
            assert_eq!(text.contains("no session in real time"), slow, "{text}");
        }
    }
}
