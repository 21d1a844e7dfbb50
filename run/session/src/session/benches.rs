//! The bench in use, and the one that is built beside the frame loop to follow it.

use std::sync::Arc;
use std::thread::JoinHandle;

use vitriol_gpu::Gpu;
use vitriol_run::{Action, Blame, Failure, Run};
use vitriol_shaders::Library;
use vitriol_sim::world::World;
use vitriol_xr::Headset;

use super::ended::NoFrameOpen;
use crate::foveating::Foveating;
use crate::picture::Eyes;
use crate::workbench::{BUILT_AGAIN, Plan, Workbench};

/// The bench in use, what it and its like are made with, and the next one.
pub(super) struct Benches {
    /// The shaders.
    pub library: Arc<Library>,
    /// What pictures are made for.
    pub eyes: Eyes,
    /// The bench in use.
    pub current: Workbench,
    coming: Option<Coming>,
    /// The next bench and the action that brings it up, where it was being built on a device that was lost meanwhile.
    again: Option<(Plan, Action)>,
}

/// A bench that is not in use yet.
pub(super) struct Next<T> {
    plan: Plan,
    /// What its picture is made for.
    eyes: Eyes,
    /// The action that brings it up.
    action: Action,
    made: T,
}

/// One in the making, on a thread of its own: compiling its passes takes longer than a frame.
type Coming = Next<JoinHandle<Result<(Workbench, World), Failure>>>;

/// One that is ready.
pub(super) type Built = Next<(Workbench, World)>;

impl Built {
    /// Its scene.
    pub fn scene(&self) -> &str {
        &self.plan.scene
    }
}

impl Benches {
    /// The first bench, and its world at its start.
    pub fn new(
        headset: &dyn Headset,
        plan: &Plan,
        foveating: Option<Foveating>,
    ) -> Result<(Self, World), Failure> {
        let (library, eyes) = (Arc::new(Library::embedded()), Eyes::of(headset, foveating));
        let (current, world) = Workbench::new(headset.gpu(), &library, plan, &eyes)?;
        let benches = Self {
            current,
            library,
            eyes,
            coming: None,
            again: None,
        };
        Ok((benches, world))
    }

    /// Begins to build a scene at its start; a bench that is under construction already is given up.
    pub fn build(&mut self, gpu: &Gpu, scene: String) {
        let same = scene == self.current.plan.scene;
        let action = match same {
            true => Action::Start(Some(scene.clone())),
            false => Action::Scene(scene.clone()),
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
        self.start(gpu, plan, action);
    }

    fn start(&mut self, gpu: &Gpu, plan: Plan, action: Action) {
        let (gpu, library) = (gpu.clone(), Arc::clone(&self.library));
        let (made, of) = (plan.clone(), self.eyes.clone());
        self.coming = Some(Coming {
            plan,
            eyes: self.eyes.clone(),
            action,
            made: std::thread::spawn(move || Workbench::new(&gpu, &library, &made, &of)),
        });
    }

    /// The scene of the bench that is being built.
    pub fn coming(&self) -> Option<&str> {
        let coming = self.coming.as_ref();
        coming.and_then(|coming| coming.action.brings_up())
    }

    /// Whether a bench is ready to follow the one in use.
    pub fn is_built(&self) -> bool {
        let coming = self.coming.as_ref();
        coming.is_some_and(|coming| coming.made.is_finished())
    }

    /// The bench that was being built, if it is ready and was built without a failure; the one in use stays. Does not wait.
    pub fn take_built(&mut self, gpu: &Gpu) -> Option<Built> {
        let Next {
            plan,
            eyes,
            action,
            made,
        } = self.coming.take_if(|coming| coming.made.is_finished())?;
        let made = made.join();
        match made.unwrap_or_else(|_| Err("the bench's builder broke down; report it").other()) {
            Ok(made) => Some(Next {
                plan,
                eyes,
                action,
                made,
            }),
            Err(_) if gpu.is_lost() => {
                self.again = Some((plan, action));
                None
            }
            Err(failure) => {
                tracing::warn!("the bench stays as it is: {failure}");
                None
            }
        }
    }

    /// The device was lost before that bench was put to use: it is built anew on the next one.
    pub fn build_again(&mut self, built: Built) {
        let scene = built.scene();
        tracing::info!(target: BUILT_AGAIN, "{scene} is built again on another device");
        self.again = Some((built.plan, built.action));
    }

    /// Puts that bench in place of the one in use, and gives its world and the action that brings that up. Waits until the old picture
    /// has given back its memory.
    pub fn put(&mut self, built: Built, _: &NoFrameOpen) -> (Action, World) {
        let (bench, world) = built.made;
        self.current = bench;
        // The lenses may hide other pixels by now: `take_mask` finds out, since its picture was made for
        // these.
        self.eyes = built.eyes;
        (built.action, world)
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

    /// Moves the bench and its run to the headset's new device ([`Run::move_to`]), and begins the bench that was being built anew.
    /// Whether the old device was lost.
    pub fn move_to(&mut self, headset: &dyn Headset, run: &mut Run) -> Result<bool, Failure> {
        let gpu = headset.gpu();
        self.eyes = Eyes::of(headset, self.eyes.foveating);
        let (bench, world) = Workbench::new(gpu, &self.library, &self.current.plan, &self.eyes)?;
        let revived = run.move_to(world)?;
        self.current = bench;
        let coming = self.coming.take();
        let coming = coming.map(|coming| (coming.plan, coming.action));
        if let Some((plan, action)) = coming.or(self.again.take()) {
            self.start(gpu, plan, action);
        }
        Ok(revived)
    }
}
