//! The pipelines of the picture.

use vitriol_gpu::{
    Blend, ColourFormat, ComputePipeline, DepthFormat, Gpu, RasterDesc, RasterPipeline, vk,
};
use vitriol_shaders::{Library, ShaderId, render};

use crate::RenderError;
use crate::tiles::Class;

/// Format of the coloured spheres, which the hardware encodes and decodes.
pub(crate) const SPHERES_FORMAT: vk::Format = vk::Format::R8G8B8A8_SRGB;
/// Format of their depth: reversed depth needs the floating point.
pub(crate) const DEPTH_FORMAT: vk::Format = vk::Format::D32_SFLOAT;

/// Rays of a pixel that are traced to the glass, on a GPU and on a CPU, whose film has to come in time.
const GLASS_RAYS: [f64; 2] = [4.0, 1.0];

/// One of each; of the picture, and of its finish, one for each class of tiles.
pub(crate) struct Pipelines {
    /// Particles as coloured spheres: the one thing that is rasterised.
    pub(crate) spheres: RasterPipeline,
    pub(crate) picture: [(Class, ComputePipeline); 3],
    pub(crate) finish: [(Class, ComputePipeline); 2],
}

impl Pipelines {
    pub(crate) fn new(gpu: &Gpu, library: &Library, view_mask: u32) -> Result<Self, RenderError> {
        let is_cpu = gpu.info().kind == vk::PhysicalDeviceType::CPU;
        let rays = ("GLASS_RAYS", GLASS_RAYS[usize::from(is_cpu)]);
        let over = |shader: ShaderId, class: Class, switches: &[(&str, f64)]| {
            let mut constants = vec![("CLASS", f64::from(class as u32))];
            constants.extend(switches);
            let compiled = library.compile(&shader, "main", &constants)?;
            Ok::<_, RenderError>((class, ComputePipeline::new(gpu, &compiled)?))
        };
        Ok(Self {
            spheres: RasterPipeline::new(
                gpu,
                &RasterDesc {
                    vertex: &library.compile(&render::PARTICLES, "vertex", &[])?,
                    fragment: Some(&library.compile(&render::PARTICLES, "fragment", &[])?),
                    colours: &[ColourFormat {
                        format: SPHERES_FORMAT,
                        blend: Blend::Replace,
                    }],
                    depth: Some(DepthFormat {
                        format: DEPTH_FORMAT,
                        compare: vk::CompareOp::GREATER,
                        write: true,
                    }),
                    view_mask,
                },
            )?,
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

const USED: [ShaderId; 6] = [
    render::TILES,
    render::TILE_PUFFS,
    render::TILE_LISTS,
    render::PARTICLES,
    render::PICTURE,
    render::FINISH,
];
