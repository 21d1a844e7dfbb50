//! A panel in the scene: a rectangle that shows an image; or a sign: the disc in it.

use glam::{Affine3A, Mat4, Vec3};
use vitriol_gpu::Image;

/// A panel or a sign of a frame. Its image was recorded before.
#[derive(Clone, Copy)]
pub struct Panel<'a> {
    /// What it shows: one layer, 8 bits a channel, of which the values are sRGB's.
    pub image: &'a Image,
    /// Its middle; +Z is its face's normal. Stage in metres, rigid.
    pub stage_from_panel: Affine3A,
    /// Width and height, metres.
    pub size: [f32; 2],
}

/// To the frame of a panel, with half its sides as units of x and y; 0 without one.
pub(crate) fn panel_from_stage(panel: Option<&Panel<'_>>, length_scale: f32) -> [[f32; 4]; 4] {
    let matrix = panel.map_or(Mat4::ZERO, |panel| {
        let mut stage_from_panel = panel.stage_from_panel;
        stage_from_panel.translation /= length_scale;
        let [x, y] = panel.size.map(|side| 2.0 * length_scale / side);
        Mat4::from_scale(Vec3::new(x, y, 1.0)) * Mat4::from(stage_from_panel.inverse())
    });
    matrix.to_cols_array_2d()
}
