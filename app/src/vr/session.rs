//! The session: the frame loop's turns, and what it is made of. A frame is in `frame`, what the user
//! chooses in `choose`, what keeps pace with the display in `pace`.

mod choose;
mod frame;
mod pace;

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::Receiver;
use std::time::Duration;

use vitriol_gpu::{Ticket, Timestamps};
use vitriol_shaders::Library;
use vitriol_sim::solver::{FlaskReading, ReadingRecord};
use vitriol_xr::track::TrackMetadata;
use vitriol_xr::{Headset, HeadsetError, Pose, PoseFrame, Switch, Turn};

use super::bench::{Bench, Builder, Plan};
use super::clock::StepClock;
use super::inputs::Buttons;
use super::mirror::{Mirror, Window};
use super::panel::Panel;
use super::picture::Eyes;
use super::placement::Posture;
use super::record::{Recorded, Recording};
use super::tally::{Holdings, Tally};
use crate::failure::{Blame, Failure};
use crate::replay::SimulatedTime;

use pace::Pace;
pub use pace::{Kept, SWITCH_FILTER, SWITCH_RESOLUTION, With};

/// Key of the switch that keeps where the bench stands in the room, see [`placement`](super::placement).
pub const SWITCH_PLACEMENT: &str = "stage_from_scene";

/// Target of the log's lines on what was made beside the frames and is used from now on.
pub const TAKEN_UP: &str = "vitriol::vr::taken_up";

/// Width and height of the panel, pixels.
pub const PANEL: [u32; 2] = [1024, 640];

/// Frames before what is measured counts: a second and more, in which the driver compiles what it
/// compiles late.
pub const WARM_UP: u64 = 120;

/// What a session is to be.
#[derive(Clone, Debug)]
pub struct Options {
    /// The bench to begin with.
    pub plan: Plan,
    /// How the user is at it.
    pub posture: Posture,
    /// Frames that are measured, after which the session ends; `None` for as long as the user likes.
    pub frames: Option<u64>,
    /// The track to be made.
    pub record: Option<PathBuf>,
    /// Whether a governor keeps pace with the display, by less accuracy and fewer pixels where it must.
    pub governed: bool,
}

/// What the user wants.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Decision {
    /// Another scene, or the same from its start.
    Scene(String),
    /// The scene from its start.
    Start,
    /// The bench before the user.
    Recentre,
    /// No more of it.
    End,
}

/// A session as it ends.
pub struct Outcome {
    /// The bench.
    pub bench: Bench,
    /// Steps taken.
    pub steps: u64,
    /// Simulated time, s.
    pub simulated: f64,
    /// Time that was shown as slow motion, s.
    pub slowed: f64,
    /// Frames, those of warming up included.
    pub frames: u64,
    /// Display periods without a frame, of those that count.
    pub skipped: u64,
    /// Times that a session was found again.
    pub renewals: u64,
    /// Times of the frames that count.
    pub tally: Tally,
    /// How it kept pace, in the frames that count.
    pub kept: Kept,
    /// What the process held when counting began, and at the end.
    pub holdings: [Option<Holdings>; 2],
    /// The recording, if there was one.
    pub recorded: Option<Recorded>,
}

/// A bench under construction, and the switch that a recording keeps of it.
struct Coming {
    builder: Builder,
    switch: Switch,
}

/// See the module.
pub struct Session {
    options: Options,
    /// What the user decides elsewhere than in the headset.
    decisions: Receiver<Decision>,
    library: Arc<Library>,
    eyes: Eyes,
    bench: Bench,
    coming: Option<Coming>,
    clock: StepClock,
    buttons: Buttons,
    /// The last frame, in the headset's stage.
    last: Option<PoseFrame>,
    /// Display time of the last frame, ns, unless the headset was off since: what is missed is counted
    /// from it.
    counted: Option<i64>,
    /// Where the bench stands; `None` until the user has been seen.
    placed: Option<Pose>,
    /// Steps that the frame has still to take, in the scene's stage.
    due: Vec<PoseFrame>,
    /// What goes with the next step.
    switches: Vec<Switch>,
    time: SimulatedTime,
    frames: u64,
    skipped: u64,
    renewals: u64,
    recording: Option<Recording>,
    tally: Tally,
    pace: Pace,
    began_with: Option<Holdings>,
    /// Submissions of steps since the last picture.
    solved: Vec<Ticket>,
    panel: Panel,
    mirror: Option<Mirror>,
    /// What was decided and not done yet.
    wanted: Vec<Decision>,
    /// A reading under way, and the last one that came.
    reading: Option<(ReadingRecord, Ticket)>,
    read: Vec<FlaskReading>,
    /// Simulated time over display time, lately.
    speed: f64,
}

impl Session {
    /// A session at its start, which does what comes from `decisions`.
    ///
    /// # Errors
    /// [`Failure::Input`] for a scene that is not there, or a recording that is already; what the
    /// device says.
    pub fn new(
        headset: &dyn Headset,
        options: Options,
        decisions: Receiver<Decision>,
    ) -> Result<Self, Failure> {
        let (gpu, eyes) = (headset.gpu(), Eyes::of(headset));
        let library = Arc::new(Library::embedded());
        let bench = Bench::new(gpu, &library, &options.plan, &eyes)?;
        // Last of what can fail: a session that never was leaves no file.
        let recording = options.record.as_ref().map(|file| {
            Recording::create(file, &metadata(&options.plan)).map_err(crate::command::track::blame)
        });
        let pace = Pace::new(gpu, &bench, options.governed);
        let counts = options.frames.is_some();
        let timed = gpu.options().timestamps != Timestamps::None && (counts || pace.follows());
        let mut session = Self {
            bench,
            panel: Panel::new(gpu, &library, PANEL)?,
            tally: Tally::new(counts, timed),
            pace,
            recording: recording.transpose()?,
            options,
            decisions,
            library,
            eyes,
            coming: None,
            clock: StepClock::default(),
            buttons: Buttons::default(),
            last: None,
            counted: None,
            placed: None,
            due: Vec::new(),
            switches: Vec::new(),
            time: SimulatedTime::default(),
            frames: 0,
            skipped: 0,
            renewals: 0,
            began_with: None,
            solved: Vec::new(),
            wanted: Vec::new(),
            mirror: None,
            reading: None,
            read: Vec::new(),
            speed: 1.0,
        };
        session.pace_bench(true, 1.0)?;
        Ok(session)
    }

    /// The same, with what the left eye sees in `window`.
    ///
    /// # Errors
    /// What the device says.
    pub fn mirrored(mut self, window: Window) -> Result<Self, Failure> {
        let gpu = self.bench.world.gpu();
        self.mirror = Some(Mirror::new(gpu, &self.library, self.eyes.extent, window)?);
        Ok(self)
    }

    /// Runs until the runtime, the user or the number of frames ends it.
    ///
    /// # Errors
    /// What headset or device say.
    pub fn run(mut self, headset: &mut dyn Headset) -> Result<Outcome, Failure> {
        let mut lost = false;
        loop {
            self.hear(headset)?;
            match headset.next().map_err(blame)? {
                Turn::Frame(frame) => {
                    self.frame(headset, &frame)?;
                    let most = self.options.frames;
                    if most.is_some_and(|most| self.frames >= WARM_UP + most) {
                        headset.request_exit().map_err(blame)?;
                    }
                }
                Turn::Paused => self.pause("the headset is off")?,
                Turn::Lost { cause } => {
                    if !std::mem::replace(&mut lost, true) {
                        tracing::warn!("{cause}; the experiment waits where it is");
                    }
                    self.pause("the headset is lost")?;
                }
                Turn::Renewed => {
                    lost = false;
                    self.renew(headset)?;
                }
                Turn::Ended => return self.finish(),
            }
        }
    }

    /// The headset shows nothing, for this reason: time stands still.
    fn pause(&mut self, why: &str) -> Result<(), Failure> {
        let info = self.info();
        if let Some(mirror) = &mut self.mirror {
            mirror.entitle(&info, Some(why));
        }
        self.clock.pause();
        self.counted = None;
        self.after()
    }

    /// Moves everything to the headset's new device.
    fn renew(&mut self, headset: &dyn Headset) -> Result<(), Failure> {
        self.pause("the headset was lost")?;
        self.renewals += 1;
        self.eyes = Eyes::of(headset);
        let gpu = headset.gpu();
        let state = self.bench.world.snapshot().other()?;
        let (plan, effort) = (&self.bench.plan, self.bench.world.effort());
        self.bench = Bench::moved(gpu, &self.library, plan, &self.eyes, &state, effort)?;
        self.pace.forget();
        self.tally.restart();
        self.panel = Panel::new(gpu, &self.library, PANEL)?;
        if let Some(mirror) = &mut self.mirror {
            mirror.move_to(gpu, &self.library, self.eyes.extent)?;
        }
        self.solved.clear();
        self.reading = None;
        self.last = None;
        if let Some(coming) = self.coming.take() {
            let (plan, eyes) = (coming.builder.plan().clone(), self.eyes.clone());
            let builder = Builder::start(gpu, &self.library, plan, eyes);
            self.coming = Some(Coming { builder, ..coming });
        }
        Ok(())
    }

    fn finish(mut self) -> Result<Outcome, Failure> {
        self.after()?;
        self.bench.world.gpu().wait_idle().other()?;
        self.tally.collect()?;
        let (steps, end_ns) = (self.time.steps(), nanoseconds(&self.time));
        let recorded = self.recording.map(|it| it.finish(steps, end_ns));
        Ok(Outcome {
            bench: self.bench,
            steps,
            simulated: self.time.seconds(),
            slowed: self.clock.slowed(),
            frames: self.frames,
            skipped: self.skipped,
            renewals: self.renewals,
            tally: self.tally,
            kept: self.pace.kept().clone(),
            holdings: [self.began_with, Holdings::now()],
            recorded,
        })
    }
}

fn metadata(plan: &Plan) -> TrackMetadata {
    let preset = format!("{:?}", plan.preset).to_lowercase();
    TrackMetadata {
        scene: plan.scene.clone(),
        seed: plan.seed,
        parameters: [("preset".to_owned(), preset)].into(),
        program_version: env!("CARGO_PKG_VERSION").into(),
    }
}

/// Whose fault a headset's error is.
pub fn blame(error: HeadsetError) -> Failure {
    match error {
        HeadsetError::NoRuntime { .. } => Failure::NoDevice(error.into()),
        _ => Failure::Other(error.into()),
    }
}

fn nanoseconds(time: &SimulatedTime) -> i64 {
    (1e9 * time.seconds()).round() as i64
}

fn milliseconds(time: Duration) -> f64 {
    1e3 * time.as_secs_f64()
}
