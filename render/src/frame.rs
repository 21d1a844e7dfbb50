//! What changes from frame to frame, and its uniforms.

use glam::{Affine3A, Vec3};
use vitriol_gpu::Buffer;
use vitriol_shaders::layout;

use crate::RenderError;
use crate::camera::View;
use crate::colour_map::ColourMap;
use crate::scene::Scene;

/// Share of the window's light that a vessel with liquid in it keeps away:
/// the liquid bends most of it elsewhere, and the glass reflects some.
const VESSEL_OPACITY: f32 = 0.55;

/// Particles in the solver's own buffers.
#[derive(Clone, Copy)]
pub struct ParticleSource<'a> {
    /// `array<vec4<f32>>`: xyz in the stage, in the scene's unit; w < 0 marks
    /// a particle that was taken out.
    pub positions: &'a Buffer,
    /// `array<vec4<f32>>` in the same order, that [`FrameDesc::colour_by`] reads:
    /// velocities (xyz, the scene's unit per second), or temperature (°C) and
    /// acid fraction in x and y.
    pub attributes: &'a Buffer,
    /// How many of them are drawn.
    pub count: u32,
    /// Radius of a sphere, in the scene's unit. 0.6 of the particle spacing
    /// closes the gaps between them.
    pub radius: f32,
}

/// What a particle's colour stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ColourBy {
    /// Its speed: the map runs from rest to this speed (scene's unit per
    /// second) and stays at its end beyond.
    Speed(f32),
    /// Its temperature: the map runs from the first to the second, °C.
    Temperature(f32, f32),
    /// Its acid mass fraction: the map runs from 0 to 1.
    Acid,
}

impl ColourBy {
    /// The attribute's map.
    pub fn map(self) -> ColourMap {
        match self {
            Self::Speed(_) => ColourMap::Lapaz,
            Self::Temperature(..) => ColourMap::Plasma,
            Self::Acid => ColourMap::Viridis,
        }
    }

    /// The attribute's values at the map's ends.
    pub fn range(self) -> [f32; 2] {
        match self {
            Self::Speed(fastest) => [0.0, fastest],
            Self::Temperature(coldest, hottest) => [coldest, hottest],
            Self::Acid => [0.0, 1.0],
        }
    }

    /// As the shader counts them.
    pub(crate) fn attribute(self) -> u32 {
        match self {
            Self::Speed(_) => 0,
            Self::Temperature(..) => 1,
            Self::Acid => 2,
        }
    }
}

/// One frame.
#[derive(Clone, Copy)]
pub struct FrameDesc<'a> {
    /// As many as the renderer has.
    pub views: &'a [View],
    /// `stage_from_vessel` of each vessel of the scene, rigid, in the scene's
    /// unit.
    pub vessels: &'a [Affine3A],
    /// The liquid; `None` for none.
    pub particles: Option<ParticleSource<'a>>,
    /// What the particles' colours stand for.
    pub colour_by: ColourBy,
    /// Metres of the stage that a unit of the scene is drawn as: 1 at real
    /// size. Views stay in metres.
    pub length_scale: f32,
}

impl FrameDesc<'_> {
    /// Whether the frame fits the scene, the views and its own buffers.
    pub(crate) fn check(&self, scene: &Scene, views: u32) -> Result<(), RenderError> {
        let counts = [
            ("views", self.views.len(), views as usize),
            ("vessel poses", self.vessels.len(), scene.vessels.len()),
        ];
        for (what, given, wanted) in counts {
            if given != wanted {
                return Err(RenderError::Count {
                    what,
                    given,
                    wanted,
                });
            }
        }
        let Some(particles) = self.particles else {
            return Ok(());
        };
        for buffer in [particles.positions, particles.attributes] {
            let held = buffer.bytes() / 16;
            if u64::from(particles.count) > held {
                return Err(RenderError::TooManyParticles {
                    count: particles.count,
                    buffer: buffer.label().to_owned(),
                    held,
                });
            }
        }
        Ok(())
    }

    /// The frame's uniforms.
    pub(crate) fn uniforms(&self, scene: &Scene) -> layout::Frame {
        let mut frame = layout::Frame {
            colour_map: self.colour_by.map().linear_entries(),
            metres_per_unit: self.length_scale,
            ..layout::Frame::default()
        };
        for (slot, view) in frame.views.iter_mut().zip(self.views) {
            let eye = Vec3::from(view.stage_from_eye.translation) / self.length_scale;
            slot.clip_from_stage = view.clip_from_scaled(self.length_scale).to_cols_array_2d();
            slot.eye = eye.to_array();
        }
        let vessels = self.vessels.iter().zip(&scene.vessels);
        for (slot, (stage_from_vessel, vessel)) in frame.blockers.iter_mut().zip(vessels) {
            let bounds = vessel.bounds;
            // The lower sphere hardly rises above the foot, so that the shadow
            // closes on it; the rim's light comes through above.
            let on_axis = |y: f32| stage_from_vessel.transform_point3(Vec3::Y * y);
            let foot = bounds.bottom + 0.5 * bounds.radius;
            slot.foot = on_axis(foot).to_array();
            slot.top = on_axis((bounds.top - bounds.radius).max(foot)).to_array();
            slot.radius = bounds.radius;
            slot.opacity = VESSEL_OPACITY;
            frame.blocker_count += 1;
        }
        frame
    }
}
