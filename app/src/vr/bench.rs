//! The bench: a world with its picture, and the next one, which is built beside the frame loop.

use std::sync::Arc;
use std::thread::JoinHandle;

use vitriol_gpu::Gpu;
use vitriol_shaders::Library;
use vitriol_sim::scene::{Preset, Scene};
use vitriol_sim::world::{World, WorldError, WorldState};

use super::picture::{Eyes, Picture};
use crate::failure::{Blame, Failure};

/// What a bench is made of.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Name or file of the scene.
    pub scene: String,
    /// Trade of speed for accuracy.
    pub preset: Preset,
    /// Seed of the initial jitter.
    pub seed: u64,
}

/// A world and its picture.
pub struct Bench {
    /// What it was made of.
    pub plan: Plan,
    /// The world.
    pub world: World,
    /// Its picture.
    pub picture: Picture,
}

impl Bench {
    /// The bench at its start.
    ///
    /// # Errors
    /// [`Failure::Input`] for a scene that is not there or whose liquid does not fit; what the
    /// device says.
    pub fn new(gpu: &Gpu, library: &Library, plan: &Plan, eyes: &Eyes) -> Result<Self, Failure> {
        let scene = Scene::load(&plan.scene).input()?.with_preset(plan.preset);
        let world = World::new(gpu, library, &scene, plan.seed).map_err(|error| match error {
            WorldError::Fill(_) => Failure::Input(format!("{}: {error}", plan.scene).into()),
            _ => Failure::Other(error.into()),
        })?;
        Ok(Self {
            plan: plan.clone(),
            picture: Picture::new(gpu, library, &scene, &world, eyes)?,
            world,
        })
    }

    /// The same bench on another device, every particle where it was.
    ///
    /// # Errors
    /// As for [`Bench::new`].
    pub fn moved(
        gpu: &Gpu,
        library: &Library,
        plan: &Plan,
        eyes: &Eyes,
        state: &WorldState,
    ) -> Result<Self, Failure> {
        let mut bench = Self::new(gpu, library, plan, eyes)?;
        bench.world.restore(state).other()?;
        Ok(bench)
    }
}

/// A bench in the making, on a thread of its own: compiling its passes takes longer than a frame.
pub struct Builder {
    plan: Plan,
    thread: JoinHandle<Result<Bench, Failure>>,
}

impl Builder {
    /// Begins.
    pub fn start(gpu: &Gpu, library: &Arc<Library>, plan: Plan, eyes: Eyes) -> Self {
        let (gpu, library, made) = (gpu.clone(), Arc::clone(library), plan.clone());
        let thread = std::thread::spawn(move || Bench::new(&gpu, &library, &made, &eyes));
        Self { plan, thread }
    }

    /// What is being made.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Whether it is there, so that [`Builder::finish`] does not wait.
    pub fn is_finished(&self) -> bool {
        self.thread.is_finished()
    }

    /// The bench.
    ///
    /// # Errors
    /// As for [`Bench::new`].
    pub fn finish(self) -> Result<Bench, Failure> {
        let made = self.thread.join();
        made.unwrap_or_else(|_| Err("the bench's builder broke down; report it").other())
    }
}
