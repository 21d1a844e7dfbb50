//! The renderer, for the judge.

use glam::Affine3A;
use vitriol_gpu::{Gpu, QueueKind};
use vitriol_render::{
    ColourBy, FrameDesc, LiquidDesc, LiquidSource, RenderDesc, RenderError, Renderer, SceneDesc,
    Surface, SurfaceFilter, View,
};
use vitriol_run::scenery::{affine, laboratory, liquid_of};
use vitriol_run::{Blame, Failure};
use vitriol_shaders::Library;

use super::judge::{Draw, Drawn};
use super::report::Manner;
use super::states::State;

/// The manners that are compared, the renderer's default first.
pub const MANNERS: [Manner; 5] = [
    Manner::new("narrow-range", true),
    Manner::new("curvature-flow", true),
    Manner::new("none", true),
    Manner::new("narrow-range", false),
    Manner::new("curvature-flow", false),
];

/// A renderer for each manner, at one resolution.
pub struct Screen {
    renderers: Vec<(Manner, Renderer)>,
}

impl Screen {
    /// Renderers for two eyes' pictures of `size` pixels of at most `particles`.
    ///
    /// # Errors
    /// The device's error.
    pub fn new(
        gpu: &Gpu,
        library: &Library,
        size: [u32; 2],
        particles: u32,
    ) -> Result<Self, Failure> {
        let renderer = |&manner: &Manner| {
            let desc = RenderDesc {
                views: 2,
                liquid: Some(LiquidDesc {
                    filter: match manner.filter {
                        "narrow-range" => SurfaceFilter::NarrowRange,
                        "curvature-flow" => SurfaceFilter::CurvatureFlow,
                        _ => SurfaceFilter::None,
                    },
                    anisotropic: manner.anisotropy,
                    ..LiquidDesc::new(particles)
                }),
                ..RenderDesc::film(size)
            };
            Ok((manner, Renderer::new(gpu, library, &desc).other()?))
        };
        Ok(Self {
            renderers: MANNERS
                .iter()
                .map(renderer)
                .collect::<Result<_, Failure>>()?,
        })
    }

    /// Replaces the scene by the vessels of a state's scene.
    ///
    /// # Errors
    /// The device's error.
    pub fn set_scene(&mut self, state: &State) -> Result<(), Failure> {
        let bare = SceneDesc {
            vessels: laboratory(state.world.scene()).vessels,
            ..SceneDesc::default()
        };
        for (_, renderer) in &mut self.renderers {
            renderer.set_scene(&bare).other()?;
        }
        Ok(())
    }
}

impl Draw for Screen {
    fn draw(
        &mut self,
        state: &State,
        eyes: &[View; 2],
        manner: Manner,
    ) -> Result<[Drawn; 2], Failure> {
        let asked = self.renderers.iter().find(|(other, _)| *other == manner);
        let Some((_, renderer)) = asked else {
            return Err(format!(
                "no renderer draws with the filter {}",
                manner.filter
            ))
            .other();
        };
        let vessels: Vec<Affine3A> = state.world.poses().iter().map(affine).collect();
        let frame = FrameDesc {
            vessels: &vessels,
            liquid: Some(LiquidSource {
                // Surfaces are compared, without bubbles and drops.
                bubbles: None,
                ..liquid_of(&state.world)
            }),
            colour_by: ColourBy::Acid,
            length_scale: state.world.scene().scale.length_scale as f32,
            ..FrameDesc::empty(eyes)
        };
        let draw = || -> Result<Vec<Surface>, RenderError> {
            let gpu = state.world.gpu();
            let mut rec = gpu.recorder(QueueKind::Main)?;
            renderer.record_surface(&mut rec, &frame)?;
            let surface = renderer.read_back_surface(&mut rec, &frame)?;
            gpu.submit(rec)?.wait()?;
            surface.views()
        };
        let drawn: Vec<Drawn> = draw().other()?.into_iter().map(drawn).collect();
        <[Drawn; 2]>::try_from(drawn)
            .map_err(|_| "the renderer did not draw two eyes")
            .other()
    }
}

/// A surface, with the thickness at each of its pixels.
fn drawn(surface: Surface) -> Drawn {
    let [width, height] = surface.extent;
    let [across, down] = surface.thickness_extent;
    let (wider, higher) = (width.div_ceil(across), height.div_ceil(down));
    let way = |pixel: u32| {
        let (x, y) = (pixel % width / wider, pixel / width / higher);
        surface.thickness[(y * across + x) as usize]
    };
    Drawn {
        ways: (0..width * height).map(way).collect(),
        depth: surface.depth,
    }
}
