//! The session: from its first frame to its end, through whatever turns the runtime takes. A frame is in `frame`, with
//! the parts that it goes through, each in a file of its own.

mod around;
mod benches;
mod checkpoints;
mod choices;
mod close_up;
mod counts;
mod ended;
mod frame;
mod guide;
mod hints;
mod instructor;
mod interrupted;
mod label;
mod losses;
mod metadata;
mod pacing;
mod readings;
mod repaint;
mod sounds;
mod spills;
mod steps;
mod summary;
mod telling;

use std::path::PathBuf;
use std::sync::mpsc::Receiver;
use std::time::Instant;

use serde::Serialize;
use vitriol_gpu::Timestamps;
use vitriol_lesson::procedure::Verdict;
use vitriol_lesson::{Attempt, Language};
use vitriol_render::Bone;
use vitriol_run::device::statement;
use vitriol_run::hands::Joints;
use vitriol_run::run::{RecordingStatus, TrackRecording};
use vitriol_run::{Action, Blame, Failure, Judging, Run, track};
use vitriol_sim::world::World;
use vitriol_sound::Device;
use vitriol_xr::{Headset, Pause, Pose, Turn};

use vitriol_live::Console;

use super::blame::blame;
use super::decision::Decision;
use super::fade::Fade;
use super::first_minute::FirstMinuteReport;
use super::foveating::Foveating;
use super::handle::Handles;
use super::latch::{Grip, Latches};
use super::mirror::{Mirror, Window};
use super::panel::Panel;
use super::placement::{Placement, Posture};
use super::tally::{Holdings, Tally};
use super::workbench::{Plan, Workbench};
use vitriol_run::texts::Texts;

use benches::Benches;
use checkpoints::Checkpoints;
use choices::Choices;
use counts::Counts;
use ended::NoFrameOpen;
use guide::Guide;
use hints::Hints;
use instructor::Instructor;
use losses::Losses;
use metadata::metadata;
use pacing::Pacing;
use readings::Readings;
use sounds::Sounds;
use spills::Spills;
use steps::Steps;
use summary::Summary;

pub use counts::WARM_UP;
pub use guide::Course;
pub use pacing::{FramesWith, GovernorReport};
pub use sounds::SoundReport;
pub use spills::{Contacts, Spilt, Touched};

/// What a session is to be.
#[derive(Clone, Debug)]
pub struct Options {
    /// The bench to begin with.
    pub plan: Plan,
    /// How the user is at it.
    pub posture: Posture,
    /// How hands grip.
    pub grip: Grip,
    /// Whether mouse and keyboard move the hands: signs and panel show these in place of controllers, nothing is recentred, and it is
    /// the headset that keeps a hand closed from one press to the next.
    pub pointer: bool,
    /// Frames that are measured, after which the session ends; `None` for as long as the user likes.
    pub frames: Option<u64>,
    /// The track to be made.
    pub record: Option<PathBuf>,
    /// Where sound is played.
    pub sound: Device,
    /// Whether a governor gives solver and picture less to do where frames would not fit the display's period.
    pub governed: bool,
    /// Where the pictures are sharp; without it everywhere, but where the governor has to give way.
    pub foveating: Option<Foveating>,
    /// Whether signs show a first user what to do.
    pub hints: bool,
    /// The instructor's console, if there is one.
    pub console: Option<Console>,
    /// The lesson that it goes through, if it does.
    pub course: Option<Course>,
    /// Language of panel and announcements.
    pub language: Language,
    /// The student's name, for the recording.
    pub student: Option<String>,
}

/// A session as it ends. Serialized, it is the part of the report that needs no computation.
#[derive(Serialize)]
pub struct SessionOutcome {
    /// The bench.
    #[serde(skip)]
    pub bench: Workbench,
    /// Its world.
    #[serde(skip)]
    pub world: World,
    /// Steps taken.
    pub steps: u64,
    /// Simulated time, s.
    #[serde(rename = "simulated_s")]
    pub simulated: f64,
    /// Time that was shown as slow motion, s.
    #[serde(rename = "slow_motion_s")]
    pub slowed: f64,
    /// Frames, those of the warm-up included.
    #[serde(skip)]
    pub frames: u64,
    /// Display periods without a frame, of those that count.
    #[serde(skip)]
    pub skipped: u64,
    /// Where the pictures were to be sharp; `None` where the governor decided.
    #[serde(rename = "foveation", skip_serializing_if = "Option::is_none")]
    pub foveating: Option<Foveating>,
    /// Width and height of the pictures of the runtime's own inset, pixels, where there was one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inset: Option<[u32; 2]>,
    /// Times that a session was found again.
    pub renewals: u64,
    /// Times that a device was lost, and the bench was brought back on another.
    pub devices_lost: u32,
    /// Times of the frames that count.
    #[serde(skip)]
    pub tally: Tally,
    /// What the governor did in the frames that count.
    pub governor: GovernorReport,
    /// What the process held when counting began, and at the end.
    #[serde(skip)]
    pub holdings: [Option<Holdings>; 2],
    /// How the sound was played.
    pub sound: SoundReport,
    /// What lies beside the flasks at the end, real mL.
    #[serde(rename = "spilt_ml")]
    pub spilt: Spilt,
    /// Acid that touched the user.
    #[serde(rename = "acid_touched")]
    pub contacts: Contacts,
    /// Flasks that broke.
    #[serde(rename = "flasks_broken")]
    pub broken: u32,
    /// When each action of a first minute was done; `None` without hints.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub first_minute: Option<FirstMinuteReport>,
    /// State of the recording at the end, if there was one.
    #[serde(rename = "recording", skip_serializing_if = "Option::is_none")]
    pub recorded: Option<RecordingStatus>,
    /// What was done and what went wrong, from each start of a scene on.
    pub attempts: Vec<Attempt>,
    /// The lesson's result, if there was a lesson.
    #[serde(rename = "lesson", skip_serializing_if = "Option::is_none")]
    pub verdict: Option<Verdict>,
}

/// A session in a headset: the run and the parts that each frame goes through. Each part keeps one thing, and uses no other parts but those
/// that it is handed.
pub struct Session {
    /// The bench in use and the one that is being built.
    benches: Benches,
    /// What the user chose and is not done yet.
    choices: Choices,
    /// Where the bench stands, and the last frame's poses.
    placement: Placement,
    /// How much of the light is shown.
    fade: Fade,
    /// The table's handles.
    handles: Handles,
    /// Where one press grips and the next lets go.
    latches: Option<Latches>,
    /// Joints of the hands that are bare in the last frame, in the scene's stage.
    joints: [Option<Joints>; 2],
    /// Steps that are due.
    steps: Steps,
    /// The world, and what is observed, judged and recorded of it.
    run: Run,
    /// Temperature and acid in the flasks, as the panel shows them.
    readings: Readings,
    /// States from which the bench is restored where the device is lost.
    checkpoints: Checkpoints,
    /// Liquid that was spilt, and acid that touched the user.
    spills: Spills,
    /// What the user hears.
    sounds: Sounds,
    /// The signs for a first user.
    hints: Hints,
    /// The summary of the attempt.
    summary: Summary,
    /// The bones of the hands as they were drawn last, in the scene's stage, real metres.
    gloves: [Vec<Bone>; 2],
    /// The panel.
    panel: Panel,
    /// The lesson.
    guide: Guide,
    /// The instructor's end of the session.
    instructor: Instructor,
    /// The window on the computer, if there is one.
    mirror: Option<Mirror>,
    /// The governor, and what it has decided.
    pacing: Pacing,
    /// Frames, and what they took.
    counts: Counts,
    /// Frames after which it ends, those of the warm-up included.
    most: Option<u64>,
    renewals: u64,
    losses: Losses,
    /// The texts in the user's language.
    texts: Texts,
    /// Whether mouse and keyboard move the hands.
    pointer: bool,
    /// From where a screen's picture was seen last, in the scene's stage; `None` in a headset, whose eyes are the head's.
    eye: Option<Pose>,
    /// Benches so far, the present one included.
    scenes: u64,
}

impl Session {
    /// A session at its start, which does what comes from `decisions`.
    ///
    /// # Errors
    /// [`Failure::Input`] for a scene that is not there, or a recording that exists already; an error of the device.
    pub fn new(
        headset: &dyn Headset,
        mut options: Options,
        decisions: Receiver<Decision>,
    ) -> Result<Self, Failure> {
        if options.pointer {
            options.course = options.course.map(Course::at_desk);
        }
        let gpu = headset.gpu();
        // Without a governor nothing gives way. On a screen one looks anywhere.
        let even = !options.governed || headset.eyes() == 1;
        let fixed = even.then_some(Foveating::Off);
        let foveating = options.foveating.or(fixed);
        let (benches, world) = Benches::new(headset, &options.plan, foveating)?;
        let mut pacing = Pacing::new(gpu, &benches.current, options.governed);
        let counts = options.frames.is_some();
        let timed = gpu.options().timestamps != Timestamps::None;
        let tally = Tally::new(counts, timed && (counts || pacing.report.on));
        let texts = Texts::of(options.language)?;
        let panel = Panel::new(gpu, &benches.library)?.in_words(&texts.panel);
        let toggles = options.grip == Grip::Toggle;
        let pressed = (toggles, options.pointer);
        let hints = Hints::new(options.hints, pressed, gpu, &benches.library)?;
        // After what fails for a user's mistake, so that a session that never was leaves no file.
        let mut run = Run::new(&options.plan.scene, world);
        if let Some(file) = &options.record {
            let metadata = metadata(
                &options.plan,
                (options.course.as_ref(), options.student.as_deref()),
                &statement(gpu),
            );
            let recording = TrackRecording::create(file, &metadata);
            run.record(recording.map_err(track::blame)?);
        }
        if let Some(Course { lesson, mode, .. }) = &options.course {
            run.judge(Judging::new(lesson.clone(), *mode, &options.plan.scene));
        }
        if options.plan.breakable {
            run.act(Action::Glass(true))?;
        }
        pacing.begin(true, None, &benches.current, &mut run)?;
        let course = options.course.as_ref();
        let rubric = course.map(|it| it.lesson.rubric()).unwrap_or_default();
        let sounds = Sounds::new(options.sound, options.plan.seed);
        let made_for = (gpu, &*benches.library, benches.eyes.extent);
        let told = (options.language, options.record.as_deref());
        let instructor = Instructor::new(options.console, told, made_for)?;
        let summary = Summary::new(options.language, rubric)?;
        let mut readings = Readings::default();
        readings.begin(run.world.scene(), summary.texts());
        Ok(Self {
            benches,
            choices: Choices::new(decisions),
            placement: match options.pointer {
                true => Placement::of_scene(),
                false => Placement::new(options.posture),
            },
            fade: Fade::default(),
            handles: Handles::default(),
            latches: (toggles && !options.pointer).then(Latches::default),
            joints: [None; 2],
            steps: Steps::new(),
            run,
            readings,
            sounds,
            hints,
            summary,
            checkpoints: Checkpoints::default(),
            spills: Spills::default(),
            gloves: [const { Vec::new() }; 2],
            panel,
            guide: Guide::new(options.course)?,
            instructor,
            mirror: None,
            pacing,
            counts: Counts::new(tally),
            most: options.frames.map(|frames| WARM_UP + frames),
            renewals: 0,
            losses: Losses::default(),
            texts,
            pointer: options.pointer,
            eye: None,
            scenes: 1,
        })
    }

    /// This session, with the left eye's picture, or a screen's, shown in `window`.
    ///
    /// # Errors
    /// An error of the device.
    pub fn mirrored(mut self, window: Window) -> Result<Self, Failure> {
        let (gpu, benches) = (self.run.world.gpu(), &self.benches);
        let mirror = Mirror::new(gpu, &benches.library, benches.eyes.extent, window)?;
        self.mirror = Some(mirror);
        Ok(self)
    }

    /// Runs until the runtime, the user or the number of frames ends it.
    ///
    /// # Errors
    /// An error of headset or device.
    pub fn run(mut self, headset: &mut dyn Headset) -> Result<SessionOutcome, Failure> {
        let mut lost = false;
        // The window of a pointer is there before its picture: who clicks and types in it meanwhile sees nothing.
        if self.pointer && self.choices.forget(Instant::now()) {
            headset.request_exit().map_err(blame)?;
        }
        loop {
            let ends = self.choices.hear(Instant::now());
            if self.obey() || ends {
                headset.request_exit().map_err(blame)?;
            }
            let turn = match headset.next() {
                Ok(turn) => turn,
                Err(error) => {
                    self.bear(headset, blame(error))?;
                    continue;
                }
            };
            match turn {
                Turn::Frame(frame) => {
                    if let Err(failure) = self.frame(headset, &frame) {
                        self.bear(headset, failure)?;
                    }
                    if self.most.is_some_and(|most| self.counts.frames >= most) {
                        headset.request_exit().map_err(blame)?;
                    }
                }
                Turn::Paused { cause } => {
                    let words = &self.texts.panel;
                    let why = match cause {
                        Pause::Off => &words.headset_off,
                        Pause::Unseen => &words.headset_unseen,
                    };
                    self.pause(&why.clone())?;
                }
                Turn::Lost { cause } => {
                    if !std::mem::replace(&mut lost, true) {
                        tracing::warn!("{cause}; the experiment waits where it is");
                    }
                    self.pause(&self.texts.panel.headset_lost.clone())?;
                }
                Turn::Renewed => {
                    lost = false;
                    if let Err(failure) = self.renew(headset) {
                        self.bear(headset, failure)?;
                    }
                }
                Turn::Ended => return self.finish(),
            }
        }
    }

    fn finish(mut self) -> Result<SessionOutcome, Failure> {
        self.step_for_switches()?;
        self.catch_up(&NoFrameOpen::in_a_turn_without())?;
        self.end_attempt()?;
        self.run.world.gpu().wait_idle().other()?;
        self.counts.tally.collect()?;
        self.tell(true);
        let mut run = self.run;
        let recorded = match run.recorded() {
            Some(_) => run.finish_recording(run.world.snapshot().other()?.solver.hash()),
            None => None,
        };
        Ok(SessionOutcome {
            bench: self.benches.current,
            steps: run.time().steps(),
            simulated: run.time().seconds(),
            slowed: self.steps.clock.slowed,
            frames: self.counts.frames,
            skipped: self.counts.skipped,
            foveating: self.benches.eyes.foveating,
            inset: self.benches.eyes.inset,
            renewals: self.renewals,
            devices_lost: self.losses.count,
            tally: self.counts.tally,
            governor: self.pacing.report,
            sound: self.sounds.report(),
            spilt: self.spills.spilt,
            contacts: self.spills.contacts,
            broken: run.counts().flasks_broken as u32,
            first_minute: self.hints.report(),
            holdings: [self.counts.began_with, Holdings::now()],
            recorded,
            attempts: Attempt::all(run.events().iter().cloned()),
            verdict: run.judging().map(|it| it.procedure().verdict()),
            world: run.world,
        })
    }
}
