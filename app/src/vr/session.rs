//! The frame loop.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::Receiver;
use std::time::{Duration, Instant};

use vitriol_gpu::{QueueKind, Ticket};
use vitriol_shaders::Library;
use vitriol_sim::world::StepInput;
use vitriol_xr::track::TrackMetadata;
use vitriol_xr::{Headset, HeadsetError, HeadsetFrame, Pose, PoseFrame, Shown, Switch, Turn};

use super::bench::{Bench, Builder, Plan};
use super::clock::StepClock;
use super::hands;
use super::inputs::{Buttons, Pressed, sound};
use super::picture::{Eyes, Picture, Sight, eye};
use super::placement::{self, Posture};
use super::record::{Recorded, Recording};
use super::tally::{Holdings, Tally};
use crate::experiment::{self, SWITCH_SCENE, SWITCH_START};
use crate::failure::{Blame, Failure};
use crate::replay::SimulatedTime;

/// Key of the switch that keeps where the bench stands in the room, see [`placement`].
pub const SWITCH_PLACEMENT: &str = "stage_from_scene";

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
    /// Set from outside where the session is to end.
    pub leave: Arc<AtomicBool>,
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
    began_with: Option<Holdings>,
    /// Submissions of steps since the last picture.
    solved: Vec<Ticket>,
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
        let recording = options.record.as_ref().map(|file| {
            Recording::create(file, &metadata(&options.plan)).map_err(crate::command::track::blame)
        });
        Ok(Self {
            bench: Bench::new(gpu, &library, &options.plan, &eyes)?,
            tally: Tally::new(gpu.options().timestamps),
            recording: recording.transpose()?,
            options,
            decisions,
            library,
            eyes,
            coming: None,
            clock: StepClock::default(),
            buttons: Buttons::default(),
            last: None,
            placed: None,
            due: Vec::new(),
            switches: Vec::new(),
            time: SimulatedTime::default(),
            frames: 0,
            skipped: 0,
            renewals: 0,
            began_with: None,
            solved: Vec::new(),
        })
    }

    /// Runs until the runtime, the user or the number of frames ends it.
    ///
    /// # Errors
    /// What headset or device say.
    pub fn run(mut self, headset: &mut dyn Headset) -> Result<Outcome, Failure> {
        let mut lost = false;
        loop {
            if self.options.leave.swap(false, Ordering::Relaxed) {
                headset.request_exit().map_err(blame)?;
            }
            match headset.next().map_err(blame)? {
                Turn::Frame(frame) => {
                    self.frame(headset, &frame)?;
                    let most = self.options.frames;
                    if most.is_some_and(|most| self.frames >= WARM_UP + most) {
                        headset.request_exit().map_err(blame)?;
                    }
                }
                Turn::Paused => self.pause()?,
                Turn::Lost { cause } => {
                    if !std::mem::replace(&mut lost, true) {
                        tracing::warn!("{cause}; the experiment waits where it is");
                    }
                    self.pause()?;
                }
                Turn::Renewed => {
                    lost = false;
                    self.renew(headset)?;
                }
                Turn::Ended => return self.finish(),
            }
        }
    }

    /// One frame, from after its begin to after its end.
    fn frame(&mut self, headset: &mut dyn Headset, frame: &HeadsetFrame) -> Result<(), Failure> {
        let begun = Instant::now();
        self.count(frame);
        let now = sound(&frame.poses, self.last.as_ref());
        let pressed = self.buttons.advance(&now.hands);
        self.decide(headset, pressed, frame.recentred, &now)?;
        self.take_up_bench()?;
        self.plan_steps(now);
        // What would wait for the device waits until the frame has ended.
        while !self.due.is_empty() && self.bench.world.is_ready().other()? {
            self.take_step()?;
        }
        if frame.should_render {
            self.draw(headset)?;
        } else {
            headset.end(None).map_err(blame)?;
        }
        self.tally.cpu_ms.push(milliseconds(begun.elapsed()));
        self.after()
    }

    /// What may wait for the device: no frame is open now.
    fn after(&mut self) -> Result<(), Failure> {
        while !self.due.is_empty() {
            self.take_step()?;
        }
        self.bench.picture.keep_up()?;
        self.tally.collect()
    }

    fn count(&mut self, frame: &HeadsetFrame) {
        self.frames += 1;
        if self.frames == WARM_UP + 1 {
            self.tally.restart();
            self.skipped = 0;
            self.began_with = Holdings::now();
        }
        let info = &frame.poses.info;
        if let (Some(last), true) = (&self.last, info.period_ns > 0) {
            let passed = info.xr_time.saturating_sub(last.info.xr_time) as f64;
            let periods = (passed / info.period_ns as f64).round();
            self.skipped += (periods - 1.0).max(0.0) as u64;
        }
    }

    fn decide(
        &mut self,
        headset: &mut dyn Headset,
        pressed: Pressed,
        recentred: bool,
        now: &PoseFrame,
    ) -> Result<(), Failure> {
        let mut recentre = pressed.recentre || recentred || self.placed.is_none();
        let mut scene = pressed.start.then(|| self.bench.plan.scene.clone());
        while let Ok(decision) = self.decisions.try_recv() {
            match decision {
                Decision::Scene(name) => scene = Some(name),
                Decision::Start => scene = Some(self.bench.plan.scene.clone()),
                Decision::Recentre => recentre = true,
                Decision::End => headset.request_exit().map_err(blame)?,
            }
        }
        if let Some(scene) = scene {
            self.build(headset, scene);
        }
        if recentre {
            let placed = placement::before(&now.stage_from_view, self.options.posture);
            self.placed = Some(placed);
            self.switch(SWITCH_PLACEMENT, placement::as_text(&placed));
            // In between lies the leap from one stage to the other.
            self.last = None;
            self.clock.pause();
        }
        Ok(())
    }

    /// Begins to build a scene at its start.
    fn build(&mut self, headset: &dyn Headset, scene: String) {
        let same = scene == self.bench.plan.scene;
        let switch = Switch {
            key: if same { SWITCH_START } else { SWITCH_SCENE }.into(),
            value: scene.clone(),
        };
        let plan = Plan {
            scene,
            ..self.bench.plan.clone()
        };
        let (gpu, eyes) = (headset.gpu(), self.eyes.clone());
        let builder = Builder::start(gpu, &self.library, plan, eyes);
        self.coming = Some(Coming { builder, switch });
    }

    /// Takes up the bench that was built meanwhile.
    fn take_up_bench(&mut self) -> Result<(), Failure> {
        let Some(coming) = self.coming.take_if(|coming| coming.builder.is_finished()) else {
            return Ok(());
        };
        match coming.builder.finish() {
            Ok(bench) => {
                self.bench = bench;
                self.switches.push(coming.switch);
            }
            Err(failure) => tracing::warn!("the bench stays as it is: {failure}"),
        }
        Ok(())
    }

    fn switch(&mut self, key: &str, value: String) {
        self.switches.push(Switch {
            key: key.into(),
            value,
        });
    }

    /// Finds the steps that are due, with the poses of their own times.
    fn plan_steps(&mut self, now: PoseFrame) {
        let frame_time = self.bench.world.scene().scale.frame_time;
        let due = self.clock.advance(now.info.xr_time, frame_time);
        if let (Some(last), Some(placed)) = (&self.last, &self.placed) {
            for s in due.ends {
                let mut frame = placement::in_scene(&last.between(&now, s), placed);
                let passed = (now.info.xr_time - last.info.xr_time) as f64;
                frame.info.xr_time = last.info.xr_time + (f64::from(s) * passed).round() as i64;
                self.due.push(frame);
            }
        }
        self.last = Some(now);
    }

    /// Takes the next step that is due.
    fn take_step(&mut self) -> Result<(), Failure> {
        let mut frame = self.due.remove(0);
        frame.step = self.time.steps();
        frame.time_ns = nanoseconds(&self.time);
        frame.scenario = std::mem::take(&mut self.switches);
        let world = &mut self.bench.world;
        let scale = world.scene().scale;
        let hands = frame
            .hands
            .each_ref()
            .map(|hand| experiment::grip(hand, scale.length_scale));
        let input = StepInput { hands };
        world.step_on(QueueKind::Async, &input).other()?;
        self.solved.extend(world.last_step().cloned());
        if let Some(recording) = &mut self.recording {
            recording.push(&frame, experiment::flasks(world));
        }
        self.time.advance(scale.frame_time);
        Ok(())
    }

    fn draw(&mut self, headset: &mut dyn Headset) -> Result<(), Failure> {
        let targets = headset.acquire().map_err(blame)?;
        let Bench { world, picture, .. } = &mut self.bench;
        let gpu = world.gpu().clone();
        let shapes = picture.shapes(&gpu, world)?;
        let views = headset.locate_views().map_err(blame)?;
        let located = Instant::now();
        let placed = self.placed.unwrap_or(Pose::IDENTITY);
        let beads = self.last.as_ref().map_or_else(Vec::new, |last| {
            hands::beads(&placement::in_scene(last, &placed))
        });
        let sight = Sight {
            views: views.each_ref().map(|view| eye(view, &placed)),
            beads: &beads,
        };
        let drawn = picture.draw(world, shapes, &sight, &targets, |_| Ok(()))?;
        self.tally.pose_age_ms.push(milliseconds(located.elapsed()));
        let behind = self.clock.behind() / world.scene().scale.frame_time;
        self.tally.delay_steps.push(behind + self.due.len() as f64);
        let mut solved = std::mem::take(&mut self.solved);
        solved.push(drawn.shapes);
        self.tally.submitted(solved, drawn.picture);
        let shown = Shown {
            views,
            near: Picture::near(),
            panel: None,
        };
        headset.end(Some(&shown)).map_err(blame)
    }

    /// The headset shows nothing: time stands still.
    fn pause(&mut self) -> Result<(), Failure> {
        self.clock.pause();
        self.after()
    }

    /// Moves everything to the headset's new device.
    fn renew(&mut self, headset: &dyn Headset) -> Result<(), Failure> {
        self.pause()?;
        self.renewals += 1;
        self.eyes = Eyes::of(headset);
        let gpu = headset.gpu();
        let state = self.bench.world.snapshot().other()?;
        let plan = &self.bench.plan;
        self.bench = Bench::moved(gpu, &self.library, plan, &self.eyes, &state)?;
        self.tally.restart();
        self.solved.clear();
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
