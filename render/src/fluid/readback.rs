//! The drawn surface as numbers, for comparison with the truth.

use vitriol_gpu::Readback;

use crate::RenderError;

/// A view's surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Width and height, pixels.
    pub extent: [u32; 2],
    /// Depth along the view's axis, in the scene's unit, row
    /// by row from the top; 0 where there is no liquid.
    pub depth: Vec<f32>,
    /// Width and height of `thickness` and `acid`, pixels: half of those of the view,
    /// rounded up.
    pub thickness_extent: [u32; 2],
    /// Liquid along the view's axis, in the scene's unit. Along a pixel's ray
    /// it is longer by the ray's length per depth.
    pub thickness: Vec<f32>,
    /// Acid mass fraction of the liquid along the ray; 0 where there is no liquid.
    pub acid: Vec<f32>,
}

/// Surfaces on their way to the host.
pub struct SurfaceReadback {
    pub(super) depth: Readback,
    pub(super) sums: Readback,
    /// Distance of each view's near plane in the scene's unit.
    pub(super) nears: Vec<f32>,
    pub(super) extent: [u32; 2],
    pub(super) blocks: [u32; 2],
    pub(super) spacing: f32,
}

/// Steps of a particle spacing in which thickness is counted, as in `common/picture/pixel_blocks.wgsl`.
const PARTS: f32 = 1_048_576.0;

impl SurfaceReadback {
    /// Particle spacing, in the scene's unit.
    pub(crate) fn spacing(&self) -> f32 {
        self.spacing
    }

    /// Each view's surface.
    ///
    /// # Errors
    /// [`RenderError::Gpu`] before the submission has finished.
    pub fn views(&self) -> Result<Vec<Surface>, RenderError> {
        let pixels = |[width, height]: [u32; 2]| (width * height) as usize;
        let depths = self.depth.get::<f32>()?;
        let pairs = self.sums.get::<[u32; 2]>()?;
        let layers = depths
            .chunks(pixels(self.extent))
            .zip(pairs.chunks(pixels(self.blocks)));
        let view = |((depths, pairs), &near): ((&[f32], &[[u32; 2]]), &f32)| {
            let depth = |&reversed: &f32| if reversed > 0.0 { near / reversed } else { 0.0 };
            let acid = |&[all, acid]: &[u32; 2]| acid as f32 / (all as f32).max(1.0);
            Surface {
                extent: self.extent,
                depth: depths.iter().map(depth).collect(),
                thickness_extent: self.blocks,
                thickness: pairs
                    .iter()
                    .map(|[all, _]| *all as f32 * (self.spacing / PARTS))
                    .collect(),
                acid: pairs.iter().map(acid).collect(),
            }
        };
        Ok(layers.zip(&self.nears).map(view).collect())
    }
}
