//! The pipelines of the picture.

use vitriol_gpu::{ComputePipeline, Gpu, vk};
use vitriol_shaders::{Library, ShaderId, render};

use crate::RenderError;
use crate::compute::compute_of;
use crate::tiles::Class;

/// Rays that are traced to the glass in a pixel with an edge of it: on a GPU, and on a CPU, where a film has to come in time.
const GLASS_RAYS: [f64; 2] = [4.0, 1.0];

/// Pixels over which the rays are spread in blocks, which glass has of two by two.
const OVER_BLOCK: f64 = 2.0;

/// The parts of the room that a pipeline draws, as in `common/picture/room_parts.wgsl`.
const SEES_BENCH: f64 = 1.0;
const SEES_WALLS: f64 = 2.0;
/// Bench, walls and the table's fittings.
const SEES_TABLE: f64 = 7.0;

/// A pass over the tiles of a class.
type OfClass = (Class, ComputePipeline);

/// The pipelines of the picture and of its finish, one for each class of tiles.
pub(crate) struct Pipelines {
    pub(crate) picture: [OfClass; 7],
    pub(crate) finish: [OfClass; 2],
    /// Picture and finish of tiles of which blocks are shaded; only where frames may be foveated.
    coarse: Option<([OfClass; 3], [OfClass; 2])>,
}

impl Pipelines {
    pub(crate) fn new(gpu: &Gpu, library: &Library, foveated: bool) -> Result<Self, RenderError> {
        let is_cpu = gpu.info().kind == vk::PhysicalDeviceType::CPU;
        let rays = ("GLASS_RAYS", GLASS_RAYS[usize::from(is_cpu)]);
        let over = |shader: (ShaderId, &str), class: Class, switches: &[(&str, f64)]| {
            let mut constants = vec![("CLASS", f64::from(class as u32))];
            constants.extend(switches);
            Ok::<_, RenderError>((class, compute_of(gpu, library, shader, &constants)?))
        };
        let sheets = ("SHEETS", 1.0);
        let glass = [("GLASS", 1.0), sheets, rays];
        let liquid = [("GLASS", 1.0), ("LIQUID", 1.0), sheets, rays];
        let steam = [("STEAM", 1.0)];
        let (picture, finish) = ((render::PICTURE, "main"), (render::FINISH, "main"));
        let (blocks, spread) = ((render::PICTURE, "coarse"), (render::SPREAD, "main"));
        let coarse = || -> Result<_, RenderError> {
            let spreads = ("GLASS_SPREAD", OVER_BLOCK);
            let picture = [
                over(blocks, Class::CoarsePlain, &[sheets])?,
                over(
                    blocks,
                    Class::CoarseGlass,
                    &[&glass[..], &[spreads]].concat(),
                )?,
                over(
                    blocks,
                    Class::CoarseLiquid,
                    &[&liquid[..], &[spreads]].concat(),
                )?,
            ];
            let finish = [
                over(spread, Class::Spread, &[])?,
                over(spread, Class::SpreadSteam, &steam)?,
            ];
            Ok((picture, finish))
        };
        Ok(Self {
            picture: [
                over(picture, Class::Bench, &[("SEES", SEES_BENCH)])?,
                over(picture, Class::Walls, &[("SEES", SEES_WALLS)])?,
                over(picture, Class::Table, &[("SEES", SEES_TABLE)])?,
                over(picture, Class::Plain, &[])?,
                over(picture, Class::Sheets, &[sheets])?,
                over(picture, Class::Glass, &glass)?,
                over(picture, Class::SharpLiquid, &liquid)?,
            ],
            finish: [
                over(finish, Class::Edges, &[])?,
                over(finish, Class::Steam, &steam)?,
            ],
            coarse: foveated.then(coarse).transpose()?,
        })
    }

    /// The pipelines of picture and finish that shade blocks; none for a frame that is not `foveated`.
    pub(crate) fn coarse(&self, foveated: bool) -> (&[OfClass], &[OfClass]) {
        let coarse = self.coarse.as_ref().filter(|_| foveated);
        coarse.map_or((&[], &[]), |(picture, finish)| (picture, finish))
    }

    /// Whether `changed` has a shader of these pipelines.
    pub(crate) fn uses(changed: &[ShaderId]) -> bool {
        changed.iter().any(|id| USED.contains(id))
    }
}

const USED: [ShaderId; 6] = [
    render::TILES,
    render::TILE_PUFFS,
    render::TILE_LISTS,
    render::PICTURE,
    render::FINISH,
    render::SPREAD,
];
