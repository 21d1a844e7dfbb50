//! The nearest hand or coloured sphere at each pixel.

use vitriol_gpu::{Buffer, Gpu, bytes_of_elements};

use crate::RenderError;

/// Arrays of each view's pixels, row by row. In a frame without spheres, tiles without hands are not written.
pub(crate) struct Solids {
    /// Reversed depth, 0 where there is nothing.
    pub(crate) depths: Buffer,
    /// Numbers of the nearest spheres at first, and light in the end.
    pub(crate) nearest: Buffer,
}

impl Solids {
    pub(crate) fn new(
        gpu: &Gpu,
        [width, height]: [u32; 2],
        views: u32,
    ) -> Result<Self, RenderError> {
        let words = bytes_of_elements::<u32>((views * width * height) as usize);
        Ok(Self {
            depths: Buffer::storage(gpu, "solid depth", words)?,
            nearest: Buffer::storage(gpu, "nearest solid", words)?,
        })
    }
}
