//! The bench that the user works at: what it is made of, and the picture of its world.

use vitriol_gpu::Gpu;
use vitriol_run::{Failure, Scenes};
use vitriol_shaders::Library;
use vitriol_sim::scene::{PictureFilter, PictureRoom, PictureTint, Preset};
use vitriol_sim::world::{World, WorldError};

use super::foveating::gives_way;
use super::ladder::Ladder;
use super::picture::{Eyes, Picture, Subject};
use vitriol_run::budget;

/// Target of the log's lines on what was made beside the frames and is used from now on.
pub const TAKEN_UP: &str = "vitriol::vr::taken_up";
/// Target of the log's line on a bench that is built again, since its device was lost before it was put to use.
pub const BUILT_AGAIN: &str = "vitriol::vr::built_again";

/// What a bench is made of.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Name of the scene.
    pub scene: String,
    /// Where it is looked up, and those that are chosen later.
    pub scenes: Scenes,
    /// Trade of speed for accuracy.
    pub preset: Preset,
    /// Substeps and iterations in place of the preset's.
    pub solver: Option<[u32; 2]>,
    /// Filter of the liquid's surface in place of the scene's, if the governor has changed it.
    pub filter: Option<PictureFilter>,
    /// What tells the liquids apart; `None` for the scene's.
    pub tint: Option<PictureTint>,
    /// How bright the room is; `None` for the scene's.
    pub room: Option<PictureRoom>,
    /// Whether glass breaks.
    pub breakable: bool,
    /// Seed of the initial jitter.
    pub seed: u64,
}

/// What goes with a world: its picture, and what it may be solved and drawn with.
pub struct Workbench {
    /// What it was made of.
    pub plan: Plan,
    /// What it may be solved and drawn with, the finest first.
    pub ladder: Ladder,
    /// Substeps and iterations that its preset has, which a replay begins with.
    pub of_preset: [u32; 2],
    /// Its picture.
    pub picture: Picture,
    filter: PictureFilter,
}

impl Workbench {
    /// The bench at its start, and its world.
    ///
    /// # Errors
    /// [`Failure::Input`] for a scene that is not there or whose liquid does not fit; an error of the device.
    pub fn new(
        gpu: &Gpu,
        library: &Library,
        plan: &Plan,
        eyes: &Eyes,
    ) -> Result<(Self, World), Failure> {
        let loaded = plan.scenes.get(&plan.scene)?;
        let mut scene = loaded.with_preset(plan.preset);
        let of_preset = [scene.solver.substeps, scene.solver.iterations];
        scene = scene.with_effort(plan.solver.unwrap_or(of_preset));
        let foveated = gives_way(eyes.foveating, &scene);
        let ladder = Ladder::of(&scene, budget::balanced(&loaded), foveated);
        scene.picture.filter = plan.filter.unwrap_or(scene.picture.filter);
        scene.picture.tint = plan.tint.unwrap_or(scene.picture.tint);
        scene.picture.room = plan.room.unwrap_or(scene.picture.room);
        let mut world =
            World::new(gpu, library, &scene, plan.seed).map_err(|error| match error {
                WorldError::Fill(_) => Failure::Input(format!("{}: {error}", plan.scene).into()),
                _ => Failure::Other(error.into()),
            })?;
        world.set_breakable(plan.breakable);
        // A session outlives its device.
        world.follow();
        let bench = Self {
            plan: plan.clone(),
            ladder,
            of_preset,
            filter: scene.picture.filter,
            picture: Picture::new(gpu, library, &scene, Subject::of(&world), eyes)?,
        };
        Ok((bench, world))
    }

    /// Filter of the liquid's surface in its picture.
    pub fn filter(&self) -> PictureFilter {
        self.filter
    }

    /// Draws from now on with `picture`, which has that filter.
    pub fn repaint(&mut self, picture: Picture, filter: PictureFilter) {
        let before = std::mem::replace(&mut self.picture, picture);
        self.picture.follow(before);
        (self.plan.filter, self.filter) = (Some(filter), filter);
    }
}
