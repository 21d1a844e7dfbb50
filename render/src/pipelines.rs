//! The pipelines of the picture.

use vitriol_gpu::{ComputePipeline, Gpu, vk};
use vitriol_shaders::{Library, ShaderId, render};

use crate::RenderError;
use crate::compute::compute;
use crate::tiles::Class;

/// Rays of a pixel that are traced to the glass, on a GPU and on a CPU, whose film has to come in time.
const GLASS_RAYS: [f64; 2] = [4.0, 1.0];

/// Of the picture, and of its finish, one for each class of tiles.
pub(crate) struct Pipelines {
    pub(crate) picture: [(Class, ComputePipeline); 3],
    pub(crate) finish: [(Class, ComputePipeline); 2],
}

impl Pipelines {
    pub(crate) fn new(gpu: &Gpu, library: &Library) -> Result<Self, RenderError> {
        let is_cpu = gpu.info().kind == vk::PhysicalDeviceType::CPU;
        let rays = ("GLASS_RAYS", GLASS_RAYS[usize::from(is_cpu)]);
        let over = |shader: ShaderId, class: Class, switches: &[(&str, f64)]| {
            let mut constants = vec![("CLASS", f64::from(class as u32))];
            constants.extend(switches);
            Ok::<_, RenderError>((class, compute(gpu, library, shader, &constants)?))
        };
        Ok(Self {
            picture: [
                over(render::PICTURE, Class::Plain, &[])?,
                over(render::PICTURE, Class::Glass, &[("GLASS", 1.0), rays])?,
                over(
                    render::PICTURE,
                    Class::Liquid,
                    &[("GLASS", 1.0), ("LIQUID", 1.0), rays],
                )?,
            ],
            finish: [
                over(render::FINISH, Class::Edges, &[])?,
                over(render::FINISH, Class::Steam, &[("STEAM", 1.0)])?,
            ],
        })
    }

    /// Whether any of these shaders is one of this crate's.
    pub(crate) fn uses(changed: &[ShaderId]) -> bool {
        changed.iter().any(|id| USED.contains(id))
    }
}

const USED: [ShaderId; 5] = [
    render::TILES,
    render::TILE_PUFFS,
    render::TILE_LISTS,
    render::PICTURE,
    render::FINISH,
];
