//! The bench in use, and the one that is built beside the frame loop to follow it.

use std::sync::Arc;
use std::thread::JoinHandle;

use vitriol_experiment::switches::{SWITCH_SCENE, SWITCH_START};
use vitriol_experiment::{Blame, Failure};
use vitriol_gpu::Gpu;
use vitriol_shaders::Library;
use vitriol_sim::world::Look;
use vitriol_xr::{Headset, Switch};

use super::ended::NoFrameOpen;
use crate::vr::foveating::Foveating;
use crate::vr::picture::Eyes;
use crate::vr::workbench::{Plan, TAKEN_UP, Workbench};

/// The bench in use, what it and its like are made with, and the next one.
pub(super) struct Benches {
    /// The shaders.
    pub library: Arc<Library>,
    /// What pictures are made for.
    pub eyes: Eyes,
    /// The bench in use.
    pub current: Workbench,
    coming: Option<Coming>,
    /// What was to come, and was on a device that was lost meanwhile.
    again: Option<(Plan, Switch)>,
    /// The bench before it, until a frame's end.
    gone: Option<Workbench>,
}

/// A bench in the making, on a thread of its own: compiling its passes takes longer than a frame.
struct Coming {
    plan: Plan,
    /// What its picture is made for.
    eyes: Eyes,
    thread: JoinHandle<Result<Workbench, Failure>>,
    /// What a recording keeps of it.
    switch: Switch,
}

impl Benches {
    /// The first bench, at its start.
    pub fn new(
        headset: &dyn Headset,
        plan: &Plan,
        foveating: Option<Foveating>,
    ) -> Result<Self, Failure> {
        let (library, eyes) = (Arc::new(Library::embedded()), Eyes::of(headset, foveating));
        Ok(Self {
            current: Workbench::new(headset.gpu(), &library, plan, &eyes)?,
            library,
            eyes,
            coming: None,
            again: None,
            gone: None,
        })
    }

    /// Begins to build a scene at its start; a bench that is under construction already is given up.
    pub fn build(&mut self, gpu: &Gpu, scene: String) {
        let same = scene == self.current.plan.scene;
        let switch = Switch {
            key: if same { SWITCH_START } else { SWITCH_SCENE }.into(),
            value: scene.clone(),
        };
        let mut plan = Plan {
            scene,
            ..self.current.plan.clone()
        };
        if !same {
            // `--solver` and `--budget-ms` are for the session's first scene; others have their preset.
            (plan.solver, plan.filter) = (None, None);
        }
        self.again = None;
        self.start(gpu, plan, switch);
    }

    fn start(&mut self, gpu: &Gpu, plan: Plan, switch: Switch) {
        let (gpu, library) = (gpu.clone(), Arc::clone(&self.library));
        let (made, of) = (plan.clone(), self.eyes.clone());
        self.coming = Some(Coming {
            plan,
            eyes: self.eyes.clone(),
            thread: std::thread::spawn(move || Workbench::new(&gpu, &library, &made, &of)),
            switch,
        });
    }

    /// The scene of the bench that is being built.
    pub fn coming(&self) -> Option<&str> {
        let coming = self.coming.as_ref();
        coming.map(|coming| coming.switch.value.as_str())
    }

    /// Whether a bench is ready to follow the one in use.
    pub fn is_built(&self) -> bool {
        let coming = self.coming.as_ref();
        coming.is_some_and(|coming| coming.thread.is_finished())
    }

    /// Puts the bench that was being built in place of the one in use, if it is ready and was built without a
    /// failure; does not wait. Its switch is for the recording.
    pub fn replace_if_built(&mut self) -> Option<Switch> {
        let coming = self.coming.take_if(|coming| coming.thread.is_finished())?;
        let made = coming.thread.join();
        match made.unwrap_or_else(|_| Err("the bench's builder broke down; report it").other()) {
            Ok(bench) => {
                self.gone = Some(std::mem::replace(&mut self.current, bench));
                // The lenses may hide other pixels by now: `take_mask` finds out, since its picture was made for
                // these.
                self.eyes = coming.eyes;
                tracing::info!(target: TAKEN_UP, "set up: {}", coming.switch.value);
                Some(coming.switch)
            }
            Err(_) if self.current.world.gpu().is_lost() => {
                self.again = Some((coming.plan, coming.switch));
                None
            }
            Err(failure) => {
                tracing::warn!("the bench stays as it is: {failure}");
                None
            }
        }
    }

    /// Lets the bench go in whose place another one came: giving back its memory and its passes takes as long as a
    /// frame's other work.
    pub fn let_go(&mut self, _: &NoFrameOpen) {
        self.gone = None;
    }

    /// Leaves out of the pictures what the lenses hide. That is known with the eyes' fields of view, which come
    /// with the first views and may change. Waits for an upload.
    pub fn take_mask(&mut self, headset: &dyn Headset, _: &NoFrameOpen) -> Result<(), Failure> {
        let eyes = Eyes::of(headset, self.eyes.foveating);
        if eyes.hidden != self.eyes.hidden {
            self.current.picture.hide(&eyes.hidden)?;
            self.eyes = eyes;
        }
        Ok(())
    }

    /// Moves the bench to the headset's new device, every particle where it was, and begins the one that was being
    /// built anew. Where the old device is lost, which may only now be found out, the bench is brought back from what was kept of
    /// it, and the looks behind the steps that were taken again are given; `None` where it is not lost.
    pub fn move_to(&mut self, headset: &dyn Headset) -> Result<Option<Vec<Look>>, Failure> {
        let gpu = headset.gpu();
        self.eyes = Eyes::of(headset, self.eyes.foveating);
        let before = &self.current.world;
        let mut bench = Workbench::new(gpu, &self.library, &self.current.plan, &self.eyes)?;
        let state = before.snapshot();
        let lost = before.gpu().is_lost();
        let looks = match before.lifeline().filter(|_| lost) {
            Some(lifeline) => {
                let looks = bench.world.revive(lifeline).other()?;
                tracing::info!("brought back, {} steps taken again", lifeline.steps());
                Some(looks)
            }
            None => {
                bench.world.solve_like(before).other()?;
                bench.world.restore(&state.other()?).other()?;
                let memory = before.looks_memory().other()?;
                bench.world.remember_looks(&memory).other()?;
                None
            }
        };
        self.current = bench;
        let coming = self.coming.take();
        let coming = coming.map(|coming| (coming.plan, coming.switch));
        if let Some((plan, switch)) = coming.or(self.again.take()) {
            self.start(gpu, plan, switch);
        }
        Ok(looks)
    }
}
