//! The picture's depth at half its resolution, for a runtime that takes one.

use vitriol_gpu::{Buffer, ComputePipeline, Gpu, GpuError, Recorder, bytes_of_elements};
use vitriol_shaders::{Library, layout, render};

use crate::compute::compute;
use crate::{RenderError, Renderer};

/// Halves the width and height of a picture's depth: handed to the runtime, it takes a quarter of the copy.
pub struct HalfDepth {
    pass: ComputePipeline,
    halved: Buffer,
    held: [u32; 2],
    views: u32,
}

impl HalfDepth {
    /// Buffers for the pictures of a renderer whose views are of `extent` pixels at most.
    ///
    /// # Errors
    /// [`RenderError::Gpu`] out of memory, [`RenderError::Shader`].
    pub fn new(
        gpu: &Gpu,
        library: &Library,
        extent: [u32; 2],
        views: u32,
    ) -> Result<Self, RenderError> {
        let [width, height] = half(extent);
        let pixels = (views * width * height) as usize;
        Ok(Self {
            pass: compute(gpu, library, render::HALF_DEPTH, &[])?,
            halved: Buffer::storage(gpu, "half depth", bytes_of_elements::<f32>(pixels))?,
            held: extent,
            views,
        })
    }

    /// Records the pass after a picture of `drawn` pixels by `renderer`, for a depth image of a picture of `whole` pixels. The result is
    /// in the upper left corner as the picture is, with the nearest depth of each two by two pixels that the lenses do not hide.
    ///
    /// # Errors
    /// [`GpuError`] where the device refuses.
    pub fn record(
        &self,
        rec: &mut Recorder,
        renderer: &Renderer,
        drawn: [u32; 2],
        whole: [u32; 2],
    ) -> Result<(), GpuError> {
        let [width, height] = half(drawn);
        let sizes = layout::DepthSizes {
            drawn,
            held: self.held,
            kept: half(whole),
        };
        rec.pass(&self.pass)
            .label("half depth")
            .read("depths", renderer.depth())
            .write("halved", &self.halved)
            .constants(&sizes)
            .workgroups([width.div_ceil(8), height.div_ceil(8), self.views])
    }

    /// Reversed depths as `array<f32>`, each view's pixels row by row, of views half as wide and high as the `whole` that was recorded
    /// last, rounded up. They can be copied to an image of 32-bit depth.
    pub fn depth(&self) -> &Buffer {
        &self.halved
    }
}

/// Half of each side, rounded up: blocks of four pixels.
pub(crate) fn half(extent: [u32; 2]) -> [u32; 2] {
    extent.map(|side| side.div_ceil(2))
}
