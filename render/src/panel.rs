//! A panel (a rectangle that shows an image), a sign (the disc in it) or a pane of glass in the scene.

use glam::{Affine3A, Mat4, Vec3};
use vitriol_gpu::{Gpu, GpuError, Image, ImageDesc, vk};

/// A panel or a sign of a frame. Its image must have been recorded before.
#[derive(Clone, Copy)]
pub struct Panel<'a> {
    /// The image that it shows: one layer, 8 bits a channel with sRGB-encoded values.
    pub image: &'a Image,
    /// Its middle; +Z is its face's normal. Stage in metres, rigid.
    pub stage_from_panel: Affine3A,
    /// Width and height, metres.
    pub size: [f32; 2],
}

/// A flat pane of clear glass: it mirrors by Fresnel's law, and what is behind is seen where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pane {
    /// Its middle; +Z is its normal. Stage in metres, rigid.
    pub stage_from_pane: Affine3A,
    /// Width and height, metres.
    pub size: [f32; 2],
}

/// Transform from the stage to a panel's frame, with half its sides as units of x and y; all zeros without one.
pub(crate) fn panel_from_stage(panel: Option<&Panel<'_>>, length_scale: f32) -> [[f32; 4]; 4] {
    let face = panel.map(|panel| (panel.stage_from_panel, panel.size));
    face_from_stage(face, length_scale)
}

/// Transform from the stage to a pane's frame, with half its sides as units of x and y; all zeros without one.
pub(crate) fn pane_from_stage(pane: Option<Pane>, length_scale: f32) -> [[f32; 4]; 4] {
    let face = pane.map(|pane| (pane.stage_from_pane, pane.size));
    face_from_stage(face, length_scale)
}

fn face_from_stage(face: Option<(Affine3A, [f32; 2])>, length_scale: f32) -> [[f32; 4]; 4] {
    let matrix = face.map_or(Mat4::ZERO, |(mut stage_from_face, size)| {
        stage_from_face.translation /= length_scale;
        let [x, y] = size.map(|side| 2.0 * length_scale / side);
        Mat4::from_scale(Vec3::new(x, y, 1.0)) * Mat4::from(stage_from_face.inverse())
    });
    matrix.to_cols_array_2d()
}

/// An image of one pixel, bound where a frame has no panel.
pub(crate) fn no_panel(gpu: &Gpu) -> Result<Image, GpuError> {
    let desc = ImageDesc {
        extent: [1, 1],
        layers: 1,
        format: vk::Format::R8G8B8A8_UNORM,
        usage: vk::ImageUsageFlags::SAMPLED,
    };
    Image::new(gpu, "no panel", desc)
}
