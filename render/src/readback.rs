//! Pictures on their way to the host.

use vitriol_gpu::Readback;

use crate::RenderError;

/// A picture on its way to the host.
pub struct PictureReadback {
    pub(crate) readback: Readback,
    pub(crate) views: usize,
    /// Bytes of a row of one view.
    pub(crate) row_bytes: usize,
}

impl PictureReadback {
    /// The first view, row by row from the top, without padding, four bytes a
    /// pixel in the format's order (RGBA for a film).
    ///
    /// # Errors
    /// [`RenderError::Gpu`] before the submission has finished.
    pub fn first_view(&self) -> Result<Vec<u8>, RenderError> {
        let mut bytes = self.readback.get::<u8>()?;
        bytes.truncate(bytes.len() / self.views);
        Ok(bytes)
    }

    /// All views in one picture, the first to the left; else as
    /// [`PictureReadback::first_view`].
    ///
    /// # Errors
    /// [`RenderError::Gpu`] before the submission has finished.
    pub fn side_by_side(&self) -> Result<Vec<u8>, RenderError> {
        let bytes = self.readback.get::<u8>()?;
        Ok(side_by_side(bytes, self.views, self.row_bytes))
    }
}

/// Views that lie one after the other, of rows of `row_bytes`, as one picture.
pub(crate) fn side_by_side(bytes: Vec<u8>, views: usize, row_bytes: usize) -> Vec<u8> {
    if views == 1 {
        return bytes;
    }
    let view = bytes.len() / views;
    let rows = (0..view).step_by(row_bytes);
    let starts = rows.flat_map(|row| (0..views).map(move |index| index * view + row));
    starts
        .flat_map(|start| &bytes[start..start + row_bytes])
        .copied()
        .collect()
}
