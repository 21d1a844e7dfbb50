//! The drawn surface as numbers, to be compared with the truth.

use vitriol_gpu::Readback;

use crate::RenderError;

/// A view's surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Width and height, pixels.
    pub extent: [u32; 2],
    /// Depth along the view's axis after the filter, in the scene's unit, row
    /// by row from the top; 0 where there is no liquid.
    pub depth: Vec<f32>,
    /// Width and height of `thickness` and `acid`, pixels: half of those of the view,
    /// rounded up.
    pub thickness_extent: [u32; 2],
    /// Liquid along the view's axis, in the scene's unit. Along a pixel's ray
    /// it is longer by the ray's length per depth.
    pub thickness: Vec<f32>,
    /// Acid mass fraction of what is in the ray; 0 where there is no liquid.
    pub acid: Vec<f32>,
}

/// Surfaces on their way to the host.
pub struct SurfaceReadback {
    pub(super) depth: Readback,
    pub(super) thickness: Readback,
    /// Distance of each view's near plane in the scene's unit.
    pub(super) nears: Vec<f32>,
    pub(super) extent: [u32; 2],
    pub(super) thickness_extent: [u32; 2],
}

impl SurfaceReadback {
    /// Each view's surface.
    ///
    /// # Errors
    /// [`RenderError::Gpu`] before the submission has finished.
    pub fn views(&self) -> Result<Vec<Surface>, RenderError> {
        let pixels = |[width, height]: [u32; 2]| (width * height) as usize;
        let depths = self.depth.get::<f32>()?;
        let pairs = self.thickness.get::<[u16; 2]>()?;
        let layers = depths
            .chunks(pixels(self.extent))
            .zip(pairs.chunks(pixels(self.thickness_extent)));
        let view = |((depths, pairs), &near): ((&[f32], &[[u16; 2]]), &f32)| {
            let half = |bits: u16| half::f16::from_bits(bits).to_f32();
            let pairs = pairs.iter().map(|pair| pair.map(half));
            let depth = |&reversed: &f32| if reversed > 0.0 { near / reversed } else { 0.0 };
            Surface {
                extent: self.extent,
                depth: depths.iter().map(depth).collect(),
                thickness_extent: self.thickness_extent,
                thickness: pairs.clone().map(|pair| pair[0]).collect(),
                acid: pairs
                    .map(|[all, acid]| if all > 0.0 { acid / all } else { 0.0 })
                    .collect(),
            }
        };
        Ok(layers.zip(&self.nears).map(view).collect())
    }
}
