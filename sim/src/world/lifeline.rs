//! Recovery of a world after its device is lost: from a state on the host and the acts since then.

use super::loads::PendingLoad;
use super::{Look, StepInput, World, WorldError, WorldState};
use crate::solver::{LooksMemory, LooksMemoryRecord, SkinPart, SolverStateRecord};
use std::sync::Arc;
use vitriol_gpu::{QueueKind, Recorder};

/// An act on a world that [`World::revive`] can repeat.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Act {
    Step(QueueKind, StepInput),
    Look(QueueKind, Vec<SkinPart>),
    Leap,
    Effort([u32; 2]),
    Intensity(f64),
    Breakable(bool),
}

/// Numbers of the solver that are not part of a [`WorldState`].
#[derive(Clone, Copy, Debug)]
struct Settings {
    effort: [u32; 2],
    /// k_v, where there is one.
    intensity: Option<f64>,
}

/// Memory of the looks, and the step behind which the last one was.
#[derive(Debug)]
struct Remembered {
    memory: LooksMemory,
    looked: u64,
}

/// A world's last state on the host, and the acts since then, from which [`World::revive`] makes the world again after its device is
/// lost; on a device of the same kind with the same bits.
#[derive(Clone, Debug)]
pub struct Lifeline {
    /// The state to begin from; `None` is the scene's start.
    state: Option<Arc<WorldState>>,
    /// Memory of the looks at that state; `None` where none was made.
    looks: Option<Arc<Remembered>>,
    /// Settings from that state on.
    settings: Settings,
    since: Vec<Act>,
    /// Number of acts before those in `since`; taking up another state counts as one.
    gone: usize,
}

impl Lifeline {
    /// Number of steps that [`World::revive`] repeats.
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
    /// Number of acts before the state.
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

    /// The state in the form that [`World::keep`] takes; may be read on another thread than the one that steps.
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

/// A state that has reached the host, for [`World::keep`].
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
    /// Records all acts from now on, so that [`World::revive`] can repeat them. Each [`World::keep`] drops the records before its state.
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

    /// State and acts from which the world can be revived; `None` before [`World::follow`].
    pub fn lifeline(&self) -> Option<&Lifeline> {
        self.lifeline.as_ref()
    }

    /// Drops all acts, since the world's state was replaced by `state`, which does not follow from them.
    pub(super) fn begin_anew(&mut self, state: &WorldState) {
        let settings = self.settings();
        if let Some(lifeline) = &mut self.lifeline {
            // One more, for this replacement: a state that is on its way and was recorded right before is older than this one.
            lifeline.gone += lifeline.since.len() + 1;
            lifeline.since.clear();
            lifeline.state = Some(Arc::new(state.clone()));
            (lifeline.looks, lifeline.settings) = (None, settings);
        }
    }

    /// Stores `memory` as that of the looks at the state that was taken up last, unless acts have followed.
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

    /// Records the copies of the present state to the host; on the queue of the steps, or after them.
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

    /// From now on the world is revived from `kept`, a state of this world; a state older than the one in use is ignored.
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

    /// Brings a lost world back in this one, which is at the start of the same scene on another device: takes up the state of
    /// `lifeline` and repeats the acts since then, which it goes on to record. Gives the repeated looks, of which the last may not have
    /// been read before.
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
