//! Copies of drawn pictures to the host.

use vitriol_gpu::{Buffer, Image, Recorder};

use super::Renderer;
use crate::RenderError;
use crate::fluid::{Fluid, SurfaceReadback};
use crate::frame::FrameDesc;
use crate::pass_pictures::PassesReadback;
use crate::readback::PictureReadback;

impl Renderer {
    /// Records the copy of the picture to the host, after
    /// [`Renderer::record`]. The bytes can be fetched when the submission has
    /// finished; a film encodes them while the next frame is simulated.
    ///
    /// # Errors
    /// [`RenderError::Gpu`] out of memory, or for a format that cannot be read
    /// back.
    pub fn read_back(&self, rec: &mut Recorder) -> Result<PictureReadback, RenderError> {
        self.copy_image(rec, &self.picture)
    }

    fn copy_image(
        &self,
        rec: &mut Recorder,
        image: &Image,
    ) -> Result<PictureReadback, RenderError> {
        Ok(PictureReadback {
            readback: rec.read_back_image(image)?,
            views: self.desc.views as usize,
            row_bytes: 4 * self.desc.extent[0] as usize,
        })
    }

    /// Records the copy of the liquid's surface, as it was filtered, to the
    /// host, after [`Renderer::record`] of that frame: for measurements.
    ///
    /// # Errors
    /// [`RenderError::NoLiquid`] for a renderer without one;
    /// [`RenderError::Gpu`] out of memory.
    pub fn read_back_surface(
        &self,
        rec: &mut Recorder,
        frame: &FrameDesc<'_>,
    ) -> Result<SurfaceReadback, RenderError> {
        self.copy_surface(rec, frame, Fluid::surface)
    }

    fn copy_surface(
        &self,
        rec: &mut Recorder,
        frame: &FrameDesc<'_>,
        depth: fn(&Fluid) -> &Buffer,
    ) -> Result<SurfaceReadback, RenderError> {
        let fluid = self.fluid.as_ref().ok_or(RenderError::NoLiquid)?;
        let spacing = frame.liquid.map_or(0.0, |liquid| liquid.spacing);
        fluid.read_back(rec, depth(fluid), frame.nears(), spacing)
    }

    /// Records the copies of each pass's result to the host, after [`Renderer::record`] of that frame, which is as large as the renderer's
    /// images.
    ///
    /// # Errors
    /// [`RenderError::Extent`] for a smaller frame; as for [`Renderer::read_back_surface`].
    pub fn read_back_passes(
        &self,
        rec: &mut Recorder,
        frame: &FrameDesc<'_>,
    ) -> Result<PassesReadback, RenderError> {
        let held = self.desc.extent;
        let extent = frame.extent(held);
        if extent != held {
            return Err(RenderError::Extent { extent, held });
        }
        Ok(PassesReadback {
            tiles: rec.read_back(self.tiles.marks())?,
            splatted: self.copy_surface(rec, frame, Fluid::splatted)?,
            filtered: self.copy_surface(rec, frame, Fluid::surface)?,
            drawn: self.copy_image(rec, &self.drawn)?,
            finished: self.copy_image(rec, &self.picture)?,
            views: frame.views.to_vec(),
            extent,
        })
    }
}
