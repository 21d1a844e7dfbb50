//! Foveation: away from where the eye or the lens is sharp, one pixel of each block is shaded, and colours are interpolated between them.
//!
//! The eye's least angle of resolution grows linearly with the angle from the fovea, ω = ω₀ + m e: a cycle of ω₀ = 1/48° at the
//! fovea and m = 0.022 (B. Guenter et al., Foveated 3D graphics, 2012, their lower estimate). Two samples are needed for a cycle,
//! so blocks of b degrees are as fine as the eye where b ≤ ω / 2.

use glam::{Affine3A, Vec3};
use vitriol_shaders::layout;

use crate::camera::View;

/// Half the angle within which every pixel is shaded, degrees.
const SHARP: f32 = 10.0;
/// Half the angle beyond which blocks of four by four pixels are shaded where only the room is seen, degrees: 0.34° wide at most where
/// they are allowed (0.1° a pixel there), by Guenter's law at 30°.
const QUARTER: f32 = 30.0;

/// The region in which a frame's pictures are sharp. Panel and sign always are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foveation {
    /// Its middle in each view's eye, as slopes to the right and up from the line of sight.
    pub towards: [[f32; 2]; 2],
    /// Half the angle within which every pixel is shaded as without foveation, radians. Beyond, one pixel of each block of two by two is
    /// shaded.
    pub sharp: f32,
    /// Half the angle beyond which one pixel of each block of four by four is shaded, radians, where a tile of the picture has
    /// neither liquid, glass, hands nor edges.
    pub quarter: f32,
}

impl Foveation {
    /// Foveation about the lenses' axes, which are the eyes' lines of sight: for a headset that does not report where its wearer looks.
    /// Lenses are sharp there, and spread the pixels elsewhere.
    pub fn fixed() -> Self {
        Self {
            towards: [[0.0; 2]; 2],
            sharp: SHARP.to_radians(),
            quarter: QUARTER.to_radians(),
        }
    }
}

/// Uniforms of the pass that lists tiles; without foveation all tiles are sharp.
pub(crate) fn foveae(foveation: Option<Foveation>, views: &[View]) -> layout::Foveae {
    let mut foveae = layout::Foveae {
        quarter: foveation.map_or(-2.0, |foveation| foveation.quarter.cos()),
        ..layout::Foveae::default()
    };
    for (index, fovea) in foveae.of_views.iter_mut().enumerate() {
        fovea.sharp = foveation.map_or(-2.0, |foveation| foveation.sharp.cos());
        let [right, up] = foveation.map_or([0.0; 2], |foveation| foveation.towards[index]);
        let at = |stage_from_eye: Affine3A| stage_from_eye.matrix3 * Vec3::new(right, up, -1.0);
        let towards = views.get(index).map(|view| at(view.stage_from_eye));
        fovea.towards = towards.map_or([0.0; 3], |towards| towards.normalize().to_array());
    }
    foveae
}
