//! A run: the world of a scene, and what is observed, judged, heard and recorded of it. A replay and a session drive the same, so that
//! one is the other by construction.

mod recording;

use serde::Serialize;
use vitriol_gpu::{QueueKind, Ticket};
use vitriol_lesson as lesson;
use vitriol_lesson::procedure::Progress;
use vitriol_sim::solver::Held;
use vitriol_sim::world::World;
use vitriol_sound as sound;
use vitriol_xr::PoseFrame;

use crate::action::Action;
use crate::audible::Audible;
use crate::clock::SimulatedTime;
use crate::experiment::Counters;
use crate::failure::{Blame, Failure, blame_world};
use crate::judging::Judging;
use crate::looks::{Looked, Looks};
use crate::marks::{Carriers, Marks};
use crate::units::count;
use crate::{stage, track};

pub use recording::{Note, RecordingStatus, Said, Sink, TrackRecording};

/// A run of a scene, and of those that are brought up after it.
///
/// Before a step come [`Run::act`] and [`Run::bring_up`], behind it [`Run::collect`] or [`Run::wait`].
pub struct Run {
    /// The world of the present scene.
    pub world: World,
    scene: String,
    looks: Looks,
    audible: Audible,
    judging: Option<Judging>,
    recording: Option<TrackRecording>,
    /// Since the last step. They go with the next one.
    actions: Vec<Action>,
    time: SimulatedTime,
    breakable: bool,
    muted: bool,
    seen: LastSeen,
    marks: Marks,
    events: Vec<lesson::Event>,
    progress: Vec<Progress>,
    instructions: Vec<(f64, Action)>,
    sounds: Vec<sound::Event>,
    counts: Counters,
}

/// Where the liquid was in the last observation that was collected; nowhere before the first one of a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LastSeen {
    /// The liquid in each flask.
    pub flasks: Vec<Held>,
    /// Liquid on the bench and on the floor, real m³.
    pub spilt: [f64; 2],
}

impl Run {
    /// A run that begins in `world`, of the scene that is called `scene`.
    pub fn new(scene: &str, world: World) -> Self {
        Self {
            looks: Looks::of(scene, world.scene()),
            audible: Audible::of(world.scene()),
            world,
            scene: scene.to_owned(),
            judging: None,
            recording: None,
            actions: Vec::new(),
            time: SimulatedTime::default(),
            breakable: false,
            muted: false,
            seen: LastSeen::default(),
            marks: Marks::default(),
            events: Vec::new(),
            progress: Vec::new(),
            instructions: Vec::new(),
            sounds: Vec::new(),
            counts: Counters::default(),
        }
    }

    /// Judges a lesson over what is observed from now on.
    pub fn judge(&mut self, lesson: Judging) {
        self.judging = Some(lesson);
    }

    /// Records the steps from now on.
    pub fn record(&mut self, recording: TrackRecording) {
        self.recording = Some(recording);
    }

    /// The present scene's name.
    pub fn scene(&self) -> &str {
        &self.scene
    }

    /// Steps, and simulated time at the end of the last one.
    pub fn time(&self) -> &SimulatedTime {
        &self.time
    }

    /// The lesson that is judged.
    pub fn judging(&self) -> Option<&Judging> {
        self.judging.as_ref()
    }

    /// Events that were found in observations that were collected.
    pub fn events(&self) -> &[lesson::Event] {
        &self.events
    }

    /// Events that would be found if the attempt ended now, beside [`Run::events`].
    pub fn so_far(&self) -> Vec<lesson::Event> {
        self.looks.so_far()
    }

    /// The lesson's progress so far.
    pub fn progress(&self) -> &[Progress] {
        &self.progress
    }

    /// Actions of an instructor, each with simulated time, s.
    pub fn instructions(&self) -> &[(f64, Action)] {
        &self.instructions
    }

    /// Where the liquid was last.
    pub fn seen(&self) -> &LastSeen {
        &self.seen
    }

    /// Drops that lie where they came to rest since the scene's start.
    pub fn marks(&self) -> &Marks {
        &self.marks
    }

    /// The pour under way in the last observation, as events will tell of it.
    pub fn pouring(&self) -> Option<lesson::Stream> {
        self.looks.pouring()
    }

    /// What the thermometer shows, °C.
    pub fn thermometer(&self) -> f64 {
        self.looks.thermometer()
    }

    /// What was counted outside the solver, whose own counts are 0 here.
    pub fn counts(&self) -> &Counters {
        &self.counts
    }

    /// How the recording stands; `None` without one.
    pub fn recorded(&self) -> Option<RecordingStatus> {
        self.recording.as_ref().map(TrackRecording::state)
    }

    /// What can be heard since the last call; its times are simulated time, s.
    pub fn sounds(&mut self) -> Vec<sound::Event> {
        std::mem::take(&mut self.sounds)
    }

    /// Whether an action was done since the last step that a replay does again before a step.
    pub fn awaits_step(&self) -> bool {
        let again =
            |it: &Action| it.brings_up().is_some() || it.is_instructors() || it.is_of_lesson();
        self.actions.iter().any(again)
    }

    /// Does an action before the step that comes next; a scene is [`Run::bring_up`]'s. Whether it is done: k_v is left out in a scene
    /// that has none.
    ///
    /// # Errors
    /// [`Failure::Input`] for a number that the solver does not take.
    pub fn act(&mut self, action: Action) -> Result<bool, Failure> {
        let now = self.time.seconds();
        match &action {
            Action::Solver(effort) => {
                let changes = *effort != self.world.effort();
                self.world.set_effort(*effort).input()?;
                self.counts.solver_changes += u64::from(changes);
            }
            Action::Glass(breaks) => {
                self.breakable = *breaks;
                self.world.set_breakable(*breaks);
            }
            Action::Leap(_) => self.world.hands_leap(),
            Action::Intensity(value) if self.world.intensity().is_none() => {
                tracing::warn!("a switch of k_v to {value} is left out: this scene has none");
                // What an instructor did is reported all the same.
                self.instructions.push((now, action));
                return Ok(false);
            }
            Action::Intensity(value) => {
                let set = self.world.set_intensity(*value);
                set.map_err(|error| format!("a switch of k_v to {value}: {error}"))
                    .input()?;
            }
            Action::Mute(on) => {
                self.muted = *on;
                self.audible.mute_boiling(*on);
            }
            Action::Hint(_) | Action::Skip(_) | Action::Answer { .. } | Action::Finish => {
                if let Some(judging) = &mut self.judging {
                    judging.ask(now, action.clone());
                }
            }
            // Between two steps, where nothing is simulated; and what pictures are drawn with.
            Action::Pause(_) | Action::Speed(_) | Action::Message(_) => {}
            Action::Resolution(_) | Action::Filter(_) | Action::Foveation(_) => {}
            Action::Scene(_) | Action::Start(_) => return Ok(false),
        }
        if action.is_instructors() {
            self.instructions.push((now, action.clone()));
        }
        self.actions.push(action);
        Ok(true)
    }

    /// Ends the attempt, after which a scene may be brought up. Waits for observations that are under way; whoever shows them collects
    /// them before.
    ///
    /// # Errors
    /// An error of the device.
    pub fn end_attempt(&mut self) -> Result<(), Failure> {
        while self.wait(0)?.is_some() {}
        let events = self.looks.end();
        let said = self
            .judging
            .as_mut()
            .map(|judging| judging.ended(&self.scene, &events));
        self.found(events);
        self.progressed(said.unwrap_or_default());
        Ok(())
    }

    /// Goes on in `world`, which `action` brings up at its start. [`Run::end_attempt`] comes before it: what is observed of a scene is
    /// of that scene's length, flasks and sounds.
    pub fn bring_up(&mut self, action: Action, world: World) {
        if let Some(name) = action.brings_up() {
            name.clone_into(&mut self.scene);
        }
        self.actions.push(action);
        self.world = world;
        self.world.set_breakable(self.breakable);
        if let Some(judging) = &mut self.judging {
            judging.bring_up();
        }
        self.looks = Looks::of(&self.scene, self.world.scene());
        self.audible = Audible::of(self.world.scene());
        self.audible.mute_boiling(self.muted);
        self.seen = LastSeen::default();
        self.marks = Marks::default();
    }

    /// Takes a step with the poses of that frame of the [stage], observes the liquid behind it on the same queue, and
    /// gives both submissions. Does not wait for the observation.
    ///
    /// # Errors
    /// An error of device or solver. [`Run::time`] shows whether the step was taken: if only its observation failed, it was.
    pub fn step(&mut self, queue: QueueKind, frame: &PoseFrame) -> Result<Vec<Ticket>, Failure> {
        let near = stage::near_from_stage(frame, self.world.scene());
        let input = stage::input(frame, self.world.scene());
        self.world.step_on(queue, &input).map_err(blame_world)?;
        let mut submitted: Vec<Ticket> = self.world.last_step().cloned().into_iter().collect();
        let actions = std::mem::take(&mut self.actions);
        if let Some(recording) = &mut self.recording {
            let step = PoseFrame {
                step: self.time.steps(),
                time_ns: nanoseconds(&self.time),
                scenario: actions.iter().map(Action::switch).collect(),
                ..frame.clone()
            };
            recording.push(&step, stage::flasks(&self.world));
        }
        self.counts.substeps += u64::from(self.world.scene().solver.substeps);
        self.counts.flasks_broken += self.world.breaks().len() as u64;
        self.marks.wiped(&self.world);
        self.marks.wears(self.world.worn());
        let before = self.time.seconds();
        self.time.advance(self.world.scene().scale.frame_time);
        let t = self.time.seconds();
        let held = |flask| self.world.holder(flask).is_some();
        let blows = self.audible.struck(self.world.strikes(), held, t);
        self.sounds.extend(blows);
        let breaks = self.audible.broke(self.world.breaks(), t);
        self.sounds.extend(breaks);
        let look = (self.looks).look(&mut self.world, queue, &near, [before, t])?;
        submitted.push(look);
        Ok(submitted)
    }

    /// The oldest observation that was not collected yet, if it has come; does not wait.
    ///
    /// # Errors
    /// An error of the device.
    pub fn collect(&mut self) -> Result<Option<Looked>, Failure> {
        let looked = self.looks.collect()?;
        Ok(looked.map(|it| self.take(it)))
    }

    /// The oldest observation that was not collected yet, if there are more than `newest` of them; waits for the device.
    ///
    /// # Errors
    /// An error of the device.
    pub fn wait(&mut self, newest: usize) -> Result<Option<Looked>, Failure> {
        if self.looks.under_way() <= newest {
            return Ok(None);
        }
        let looked = self.looks.wait()?;
        Ok(looked.map(|it| self.take(it)))
    }

    /// Goes on in `world`, which is the present scene's at its start on another device, every particle where it was. Where the old device
    /// is lost, which may only now be found out, the world is brought back from the last state that was kept of it, and the steps since
    /// are taken and observed again; else observations that are under way are lost. Whether the old device was lost.
    ///
    /// # Errors
    /// An error of either device, or a world of another scene.
    pub fn move_to(&mut self, mut world: World) -> Result<bool, Failure> {
        let before = &self.world;
        let state = before.snapshot();
        let lost = before.gpu().is_lost();
        let lifeline = before.lifeline().filter(|_| lost);
        if let Some(lifeline) = lifeline {
            self.looks.take_again(world.revive(lifeline).other()?);
            tracing::info!(
                "brought back, {} taken again",
                count(lifeline.steps() as u64, "step")
            );
        } else {
            world.solve_like(before).other()?;
            world.restore(&state.other()?).other()?;
            let memory = before.looks_memory().other()?;
            world.remember_looks(&memory).other()?;
            self.looks.forget();
        }
        let revived = lifeline.is_some();
        self.world = world;
        Ok(revived)
    }

    /// Ends the recording, if there is one, in the state whose hash is given, and waits for its file.
    pub fn finish_recording(&mut self, state_hash: u64) -> Option<RecordingStatus> {
        let recording = self.recording.take()?;
        let outcome = [(track::STATE_HASH.to_owned(), format!("{state_hash:016x}"))];
        let (steps, end_ns) = (self.time.steps(), nanoseconds(&self.time));
        Some(recording.finish(steps, end_ns, outcome.into()))
    }

    fn take(&mut self, mut looked: Looked) -> Looked {
        let said = self.judging.as_mut().map(|judging| {
            let looks = &self.looks;
            judging.looked(&self.scene, &looked, || looks.so_far())
        });
        self.found(std::mem::take(&mut looked.events));
        self.progressed(said.unwrap_or_default());
        let real = self.world.scene().scale.length_scale.powi(3);
        let census = &looked.census;
        self.seen.spilt = [&census.table, &census.floor].map(|held| real * held.volume);
        self.seen.flasks.clone_from(&census.flasks);
        let carriers = Carriers {
            hands: looked.hands.each_ref().map(Vec::as_slice),
            flasks: &looked.poses,
            length_scale: self.world.scene().scale.length_scale,
        };
        self.marks.take(census, carriers);
        // From the observation before on.
        let since = looked.t - looked.elapsed;
        let heard = self
            .audible
            .looked(&looked.poses, census, looked.elapsed, since);
        self.sounds.extend(heard);
        looked
    }

    fn found(&mut self, events: Vec<lesson::Event>) {
        self.note(&events, Note::Event);
        self.events.extend(events);
    }

    fn progressed(&mut self, said: Vec<Progress>) {
        self.note(&said, Note::Progress);
        self.progress.extend(said);
    }

    fn note(&mut self, found: &[impl Serialize], kind: fn(String) -> Note) {
        if let Some(recording) = &mut self.recording {
            for found in found {
                // A struct of numbers and texts has a JSON; what is not finite becomes null.
                let json = serde_json::to_string(found).unwrap_or_default();
                recording.found(nanoseconds(&self.time), kind(json));
            }
        }
    }
}

fn nanoseconds(time: &SimulatedTime) -> i64 {
    (1e9 * time.seconds()).round() as i64
}
