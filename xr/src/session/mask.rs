//! The part of a picture that no eye sees (XR_KHR_visibility_mask).

use openxr as xr;

use super::views::Views;
use crate::Fov;

/// Corners of the hidden triangles of one eye, three each, in the plane one metre ahead of it.
#[derive(Clone, Debug, Default)]
pub(super) struct Mask(Vec<[f32; 2]>);

impl Mask {
    /// Masks of the left and the right eye. An inset has none: lenses hide little of the middle, and it may lie elsewhere in each frame.
    pub(super) fn of_eyes(session: &xr::Session<xr::Vulkan>, views: Views) -> [Self; 2] {
        [0, 1].map(|eye| Self::of(session, views, eye))
    }

    /// The mask of one eye; empty where the runtime has none.
    fn of(session: &xr::Session<xr::Vulkan>, views: Views, eye: u32) -> Self {
        if session.instance().exts().khr_visibility_mask.is_none() {
            return Self::default();
        }
        let mask = session.get_visibility_mask_khr(
            views.kind(),
            eye,
            xr::VisibilityMaskTypeKHR::HIDDEN_TRIANGLE_MESH,
        );
        // Without a mask the whole picture is drawn, which is as right.
        let Ok(mask) = mask else {
            return Self::default();
        };
        let corners = mask
            .indices
            .iter()
            .filter_map(|index| mask.vertices.get(*index as usize))
            .map(|corner| [corner.x, corner.y])
            .collect::<Vec<_>>();
        Self(corners)
    }

    /// The mask in the picture of an eye with this field of view: 0 to 1 from the upper left.
    pub(super) fn in_picture(&self, fov: &Fov) -> Vec<[f32; 2]> {
        let [left, right, up, down] = [fov.left, fov.right, fov.up, fov.down].map(f32::tan);
        self.0
            .iter()
            .map(|[x, y]| [(x - left) / (right - left), (up - y) / (up - down)])
            .collect()
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    #[test]
    fn the_corners_of_the_view_are_those_of_the_picture() {
        // Tangents -2, 1, 1.5 and -0.5: no two sides alike.
        let fov = Fov {
            left: (-2.0f32).atan(),
            right: 1.0f32.atan(),
            up: 1.5f32.atan(),
            down: (-0.5f32).atan(),
        };
        let mask = Mask(vec![[-2.0, 1.5], [1.0, 1.5], [-2.0, -0.5], [-0.5, 0.5]]);
        let wanted = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.5]];
        for (got, wanted) in mask.in_picture(&fov).iter().zip(wanted) {
            // f32 rounding of tangents about 1.
            assert!((got[0] - wanted[0]).abs() < 1e-6 && (got[1] - wanted[1]).abs() < 1e-6);
        }
    }
}
