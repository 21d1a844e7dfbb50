//! What a world is brought back from after its device is lost: a state on the host, and what was done since.

use super::{Look, PendingLoad, StepInput, World, WorldError, WorldState};
use crate::solver::{LooksMemory, LooksMemoryRecord, SkinPart, SolverStateRecord};
use std::sync::Arc;
use vitriol_gpu::{QueueKind, Recorder};

/// Something that was done with a world.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Act {
    Step(QueueKind, StepInput),
    Look(QueueKind, Vec<SkinPart>),
    Leap,
    Effort([u32; 2]),
    Intensity(f64),
    Breakable(bool),
}

/// What a world is solved with, which is in no state.
#[derive(Clone, Copy, Debug)]
struct Settings {
    effort: [u32; 2],
    /// k_v, where there is one.
    intensity: Option<f64>,
}

/// What looks know, and the step behind which the last one was.
#[derive(Debug)]
struct Remembered {
    memory: LooksMemory,
    looked: u64,
}

/// See the module. What is brought back has the same bits on a device of the same kind.
#[derive(Clone, Debug)]
pub struct Lifeline {
    /// `None` stands for the start.
    state: Option<Arc<WorldState>>,
    /// What looks knew then; `None` where none was made.
    looks: Option<Arc<Remembered>>,
    /// What it was to be solved with from there on.
    settings: Settings,
    since: Vec<Act>,
    /// Acts before those; that another state was taken up is one.
    gone: usize,
}

impl Lifeline {
    /// Steps that are taken anew where a world is brought back.
    pub fn steps(&self) -> usize {
        let steps = |act: &&Act| matches!(act, Act::Step(..));
        self.since.iter().filter(steps).count()
    }
}

/// A state on its way to the host.
pub struct StateRecord {
    step: u64,
    solver: SolverStateRecord,
    bodies: Vec<u8>,
    looks: LooksMemoryRecord,
    looked: u64,
    loads: Vec<Arc<PendingLoad>>,
    /// Acts before it, and what it is to be solved with.
    before: usize,
    settings: Settings,
}

impl StateRecord {
    /// The state.
    ///
    /// # Errors
    /// [`WorldError::Gpu`] before the submission has finished, and where the device is lost.
    pub fn get(self) -> Result<WorldState, WorldError> {
        Ok(self.kept()?.into_state())
    }

    /// The place from which on a world is brought back; may be read on another thread than the one that steps.
    ///
    /// # Errors
    /// As for [`StateRecord::get`].
    pub fn kept(self) -> Result<Kept, WorldError> {
        let loads = self.loads.iter().map(|load| {
            let sums = load.read()?;
            Ok::<_, WorldError>(bytemuck::cast_slice(&sums).to_vec())
        });
        let state = WorldState {
            step: self.step,
            loads: loads.collect::<Result<_, _>>()?,
            solver: self.solver.get()?,
            bodies: self.bodies,
        };
        let looks = Remembered {
            memory: self.looks.get()?,
            looked: self.looked,
        };
        Ok(Kept {
            state: Arc::new(state),
            looks: Arc::new(looks),
            before: self.before,
            settings: self.settings,
        })
    }
}

/// A state that has come, for [`World::keep`].
pub struct Kept {
    state: Arc<WorldState>,
    looks: Arc<Remembered>,
    before: usize,
    settings: Settings,
}

impl Kept {
    fn into_state(self) -> WorldState {
        Arc::unwrap_or_clone(self.state)
    }
}

impl World {
    /// From now on what is done is noted, so that [`World::revive`] can do it again. Each [`World::keep`] lets the notes before it go.
    pub fn follow(&mut self) {
        let settings = self.settings();
        self.lifeline.get_or_insert_with(|| Lifeline {
            state: None,
            looks: None,
            settings,
            since: vec![Act::Breakable(self.bodies.is_breakable())],
            gone: 0,
        });
    }

    fn settings(&self) -> Settings {
        Settings {
            effort: self.effort(),
            intensity: self.intensity(),
        }
    }

    /// What the world can be brought back from; `None` where nobody follows.
    pub fn lifeline(&self) -> Option<&Lifeline> {
        self.lifeline.as_ref()
    }

    /// The state was replaced: what was done before says nothing of it.
    pub(super) fn begin_anew(&mut self, state: &WorldState) {
        let settings = self.settings();
        if let Some(lifeline) = &mut self.lifeline {
            // One more, for what was done just now: a state that is on its way and was recorded right before is older than this one.
            lifeline.gone += lifeline.since.len() + 1;
            lifeline.since.clear();
            lifeline.state = Some(Arc::new(state.clone()));
            (lifeline.looks, lifeline.settings) = (None, settings);
        }
    }

    /// The state that was taken up last is one of which looks know that.
    pub(super) fn keep_memory(&mut self, memory: &LooksMemory) {
        let looked = self.looked;
        if let Some(lifeline) = self.lifeline.as_mut().filter(|it| it.since.is_empty()) {
            let memory = memory.clone();
            lifeline.looks = Some(Arc::new(Remembered { memory, looked }));
        }
    }

    pub(super) fn note(&mut self, act: Act) {
        if let Some(lifeline) = &mut self.lifeline {
            lifeline.since.push(act);
        }
    }

    /// Records the copies of which the state as it is now is made; on the queue of the steps, or after them.
    ///
    /// # Errors
    /// [`WorldError`] where the device fails.
    pub fn record_state(&self, rec: &mut Recorder) -> Result<StateRecord, WorldError> {
        Ok(StateRecord {
            step: self.step,
            solver: self.solver.record_state(rec)?,
            bodies: self.bodies.snapshot()?,
            looks: self.solver.record_looks_memory(rec)?,
            looked: self.looked,
            loads: self.loads.iter().cloned().collect(),
            before: self
                .lifeline
                .as_ref()
                .map_or(0, |it| it.gone + it.since.len()),
            settings: self.settings(),
        })
    }

    /// From now on it is brought back from that state, which is of this world; one that is older than what it is brought back
    /// from already is left alone.
    pub fn keep(&mut self, kept: Kept) {
        if let Some(lifeline) = &mut self.lifeline
            && let Some(passed) = kept.before.checked_sub(lifeline.gone)
        {
            let passed = passed.min(lifeline.since.len());
            lifeline.since.drain(..passed);
            lifeline.gone += passed;
            (lifeline.state, lifeline.looks) = (Some(kept.state), Some(kept.looks));
            lifeline.settings = kept.settings;
        }
    }

    /// Brings a world back in this one, which is at the start of the same scene on another device: takes its state up and does
    /// again what was done since. It is followed from there on. Gives the looks among that, of which the last may not have been read before.
    ///
    /// # Errors
    /// [`WorldError`] where the state is another scene's, or the device fails.
    pub fn revive(&mut self, lifeline: &Lifeline) -> Result<Vec<Look>, WorldError> {
        self.lifeline = None;
        self.set_effort(lifeline.settings.effort)?;
        self.take_intensity(lifeline.settings.intensity);
        if let Some(state) = &lifeline.state {
            self.restore(state)?;
        }
        if let Some(looks) = &lifeline.looks {
            self.remember_looks(&looks.memory)?;
            self.looked = looks.looked;
        }
        let mut looks = Vec::new();
        for act in &lifeline.since {
            match act {
                Act::Step(queue, input) => self.step_on(*queue, input)?,
                Act::Look(queue, skin) => looks.push(self.look_on(*queue, skin)?),
                Act::Leap => self.hands_leap(),
                Act::Effort(effort) => self.set_effort(*effort)?,
                Act::Intensity(intensity) => self.set_intensity(*intensity)?,
                Act::Breakable(on) => self.set_breakable(*on),
            }
        }
        self.lifeline = Some(lifeline.clone());
        Ok(looks)
    }
}
