//! The session: from its first frame to its end, through whatever turns the runtime takes. A frame is in `frame`, with
//! the parts that it goes through, each in a file of its own.

mod benches;
mod choices;
mod counts;
mod ended;
mod frame;
mod pacing;
mod readings;
mod repaint;
mod steps;
mod track;

use std::path::PathBuf;
use std::sync::mpsc::Receiver;
use std::time::Instant;

use vitriol_experiment::device::statement;
use vitriol_experiment::hands::Joints;
use vitriol_experiment::{Blame, Failure};
use vitriol_gpu::Timestamps;
use vitriol_xr::{Headset, Pause, Turn};

use super::blame::blame;
use super::decision::Decision;
use super::latch::{Grip, Latches};
use super::mirror::{Mirror, Window};
use super::panel::Panel;
use super::placement::{Placement, Posture};
use super::record::RecordingStatus;
use super::tally::{Holdings, Tally};
use super::workbench::{Plan, Workbench};

use benches::Benches;
use choices::Choices;
use counts::Counts;
use ended::NoFrameOpen;
use pacing::Pacing;
use readings::Readings;
use steps::Steps;
use track::SessionTrack;

pub use counts::WARM_UP;
pub use pacing::{FramesWith, GovernorReport, SWITCH_FILTER, SWITCH_RESOLUTION};

/// What a session is to be.
#[derive(Clone, Debug)]
pub struct Options {
    /// The bench to begin with.
    pub plan: Plan,
    /// How the user is at it.
    pub posture: Posture,
    /// How hands grip.
    pub grip: Grip,
    /// Frames that are measured, after which the session ends; `None` for as long as the user likes.
    pub frames: Option<u64>,
    /// The track to be made.
    pub record: Option<PathBuf>,
    /// Whether a governor gives solver and picture less to do where frames would not fit the display's period.
    pub governed: bool,
}

/// A session as it ends.
pub struct SessionOutcome {
    /// The bench.
    pub bench: Workbench,
    /// Steps taken.
    pub steps: u64,
    /// Simulated time, s.
    pub simulated: f64,
    /// Time that was shown as slow motion, s.
    pub slowed: f64,
    /// Frames, those of the warm-up included.
    pub frames: u64,
    /// Display periods without a frame, of those that count.
    pub skipped: u64,
    /// Times that a session was found again.
    pub renewals: u64,
    /// Times of the frames that count.
    pub tally: Tally,
    /// What the governor did in the frames that count.
    pub governor: GovernorReport,
    /// What the process held when counting began, and at the end.
    pub holdings: [Option<Holdings>; 2],
    /// What became of the recording, if there was one.
    pub recorded: Option<RecordingStatus>,
}

/// See the module. Each part keeps one thing and knows no other part but those that it is handed.
pub struct Session {
    /// The bench in use and the one that is being built.
    benches: Benches,
    /// What the user chose and is not done yet.
    choices: Choices,
    /// Where the bench stands, and the last frame's poses.
    placement: Placement,
    /// Where one press grips and the next lets go.
    latches: Option<Latches>,
    /// Joints of the hands that are bare in the last frame, in the scene's stage.
    joints: [Option<Joints>; 2],
    /// Steps that are due.
    steps: Steps,
    /// The recording, with simulated time and the switches of the next step.
    track: SessionTrack,
    /// What the panel says of the flasks.
    readings: Readings,
    /// The panel.
    panel: Panel,
    /// The window on the computer, if there is one.
    mirror: Option<Mirror>,
    /// The governor, and what it has decided.
    pacing: Pacing,
    /// Frames, and what they took.
    counts: Counts,
    /// Frames after which it ends, those of the warm-up included.
    most: Option<u64>,
    renewals: u64,
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
        let gpu = headset.gpu();
        let mut benches = Benches::new(headset, &options.plan)?;
        let mut pacing = Pacing::new(gpu, &benches.current, options.governed);
        let counts = options.frames.is_some();
        let timed = gpu.options().timestamps != Timestamps::None;
        let tally = Tally::new(counts, timed && (counts || pacing.report.on));
        let panel = Panel::new(gpu, &benches.library)?;
        // After what fails for a user's mistake, so that a session that never was leaves no file.
        let mut track =
            SessionTrack::new(options.record.as_deref(), &options.plan, &statement(gpu))?;
        pacing.begin(true, 1.0, &mut benches.current, &mut track)?;
        Ok(Self {
            benches,
            choices: Choices::new(decisions),
            placement: Placement::new(options.posture),
            latches: (options.grip == Grip::Toggle).then(Latches::default),
            joints: [None; 2],
            steps: Steps::new(),
            track,
            readings: Readings::default(),
            panel,
            mirror: None,
            pacing,
            counts: Counts::new(tally),
            most: options.frames.map(|frames| WARM_UP + frames),
            renewals: 0,
        })
    }

    /// The same, with what the left eye sees in `window`.
    ///
    /// # Errors
    /// What the device says.
    pub fn mirrored(mut self, window: Window) -> Result<Self, Failure> {
        let (gpu, benches) = (self.benches.current.world.gpu(), &self.benches);
        let mirror = Mirror::new(gpu, &benches.library, benches.eyes.extent, window)?;
        self.mirror = Some(mirror);
        Ok(self)
    }

    /// Runs until the runtime, the user or the number of frames ends it.
    ///
    /// # Errors
    /// What headset or device say.
    pub fn run(mut self, headset: &mut dyn Headset) -> Result<SessionOutcome, Failure> {
        let mut lost = false;
        loop {
            if self.choices.hear(Instant::now()) {
                headset.request_exit().map_err(blame)?;
            }
            match headset.next().map_err(blame)? {
                Turn::Frame(frame) => {
                    self.frame(headset, &frame)?;
                    if self.most.is_some_and(|most| self.counts.frames >= most) {
                        headset.request_exit().map_err(blame)?;
                    }
                }
                Turn::Paused { cause } => self.pause(match cause {
                    Pause::Off => "the headset is off",
                    Pause::Unseen => "the headset is not seen yet",
                })?,
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
        self.steps.clock.pause();
        self.placement.interrupt();
        self.counts.pause();
        self.catch_up(&NoFrameOpen::in_a_turn_without())
    }

    /// Moves everything to the headset's new device.
    fn renew(&mut self, headset: &dyn Headset) -> Result<(), Failure> {
        self.pause("the headset was lost")?;
        self.renewals += 1;
        let gpu = headset.gpu();
        self.benches.move_to(headset)?;
        let (library, eyes) = (&self.benches.library, &self.benches.eyes);
        self.panel = Panel::new(gpu, library)?;
        if let Some(mirror) = &mut self.mirror {
            mirror.move_to(gpu, library, eyes.extent)?;
        }
        // What was under way on the old device will not come, and what it took says nothing of the new one.
        self.pacing.forget();
        self.pacing.forget_rates();
        self.counts.tally.restart();
        self.steps.submitted();
        self.readings.under_way = None;
        Ok(())
    }

    fn finish(mut self) -> Result<SessionOutcome, Failure> {
        self.catch_up(&NoFrameOpen::in_a_turn_without())?;
        self.benches.current.world.gpu().wait_idle().other()?;
        self.counts.tally.collect()?;
        let world = &self.benches.current.world;
        let hash = || Ok(world.snapshot().other()?.solver.hash());
        let (time, recorded) = self.track.finish(hash)?;
        Ok(SessionOutcome {
            bench: self.benches.current,
            steps: time.steps(),
            simulated: time.seconds(),
            slowed: self.steps.clock.slowed,
            frames: self.counts.frames,
            skipped: self.counts.skipped,
            renewals: self.renewals,
            tally: self.counts.tally,
            governor: self.pacing.report,
            holdings: [self.counts.began_with, Holdings::now()],
            recorded,
        })
    }
}
