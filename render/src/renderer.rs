//! Draws a frame: particles and solid things first, the glass over them.

use glam::Mat4;
use vitriol_gpu::{
    Buffer, ColourTarget, DepthTarget, Filter, Gpu, Image, ImageDesc, Load, Raster, RasterPipeline,
    RasterTarget, Recorder, Sampler, SamplerDesc, bytes_of_elements, vk,
};
use vitriol_shaders::{Library, ShaderId, layout};

use crate::RenderError;
use crate::fluid::{Fluid, LiquidDesc, LiquidSource, SurfaceReadback, view_mask};
use crate::frame::{ColourBy, FrameDesc, ParticleSource, SteamSource};
use crate::pipelines::{DEPTH_FORMAT, Pipelines};
use crate::readback::PictureReadback;
use crate::scene::{Scene, SceneDesc};
use crate::tiles::Tiles;

/// Where there is nothing: the walls' own colour, roughly. Linear.
const BACKGROUND: [f32; 4] = [0.38, 0.37, 0.35, 1.0];

/// Size, views and format of the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RenderDesc {
    /// Width and height of each view, pixels.
    pub extent: [u32; 2],
    /// 1 (a film) or 2 (a headset's eyes).
    pub views: u32,
    /// Format of the colour image. One of sRGB, which encodes what the shaders
    /// write.
    pub format: vk::Format,
    /// The liquid surface that frames may ask for; `None` for none.
    pub liquid: Option<LiquidDesc>,
}

impl RenderDesc {
    /// One view of `extent` in 8-bit sRGB, without a liquid surface: a film.
    pub const fn film(extent: [u32; 2]) -> Self {
        Self {
            extent,
            views: 1,
            format: vk::Format::R8G8B8A8_SRGB,
            liquid: None,
        }
    }
}

/// Draws frames into its own layered colour and depth images, a layer a view.
///
/// It records into the caller's recorder, so the picture comes after whatever
/// solver passes were recorded or submitted before it on that queue, and reads
/// the solver's buffers where they are.
pub struct Renderer {
    gpu: Gpu,
    desc: RenderDesc,
    pipelines: Pipelines,
    scene: Scene,
    frame: Buffer,
    fluid: Option<Fluid>,
    /// Corners of the triangles that no eye sees.
    mask: Option<Buffer>,
    tiles: Tiles,
    /// Bound where no ellipsoids are.
    nothing: Buffer,
    /// Tiles with smooth edges.
    smoothed: Image,
    between: Sampler,
    colour: Image,
    depth: Image,
}

impl Renderer {
    /// A renderer of an empty scene, its shaders from `library`.
    ///
    /// # Errors
    /// [`RenderError::ViewCount`]; [`RenderError::Gpu`] where the device
    /// cannot have the images, [`RenderError::Shader`].
    pub fn new(gpu: &Gpu, library: &Library, desc: &RenderDesc) -> Result<Self, RenderError> {
        if !(1..=2).contains(&desc.views) {
            return Err(RenderError::ViewCount { views: desc.views });
        }
        let image = |label, format, usage| {
            let desc = ImageDesc {
                extent: desc.extent,
                layers: desc.views,
                format,
                usage,
            };
            Image::new(gpu, label, desc)
        };
        Ok(Self {
            gpu: gpu.clone(),
            desc: *desc,
            pipelines: Pipelines::new(gpu, library, desc.format, view_mask(desc.views))?,
            scene: Scene::new(gpu, &SceneDesc::default())?,
            frame: Buffer::uniform(gpu, "frame", bytes_of_elements::<layout::Frame>(1))?,
            fluid: match desc.liquid {
                Some(liquid) => {
                    let (extent, views) = (desc.extent, desc.views);
                    Some(Fluid::new(
                        gpu,
                        library,
                        liquid,
                        extent,
                        views,
                        desc.format,
                    )?)
                }
                None => None,
            },
            mask: None,
            tiles: Tiles::new(gpu, library, desc.extent, desc.views)?,
            nothing: Buffer::storage(gpu, "no ellipsoids", 0)?,
            smoothed: image(
                "smoothed",
                desc.format,
                vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::SAMPLED,
            )?,
            between: Sampler::new(
                gpu,
                SamplerDesc {
                    filter: Filter::Linear,
                    ..SamplerDesc::default()
                },
            )?,
            colour: image(
                "picture",
                desc.format,
                vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::SAMPLED,
            )?,
            depth: image(
                "picture depth",
                DEPTH_FORMAT,
                vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT | vk::ImageUsageFlags::SAMPLED,
            )?,
        })
    }

    /// Takes up what changed of this crate's shaders; `changed` is what
    /// [`Library::changed`] returned. On an error the old pipelines stay.
    ///
    /// # Errors
    /// [`RenderError::Shader`], [`RenderError::Gpu`].
    pub fn reload(&mut self, library: &Library, changed: &[ShaderId]) -> Result<(), RenderError> {
        if let Some(fluid) = self.fluid.as_mut().filter(|_| Fluid::uses(changed)) {
            fluid.reload(library)?;
        }
        if Pipelines::uses(changed) {
            self.tiles.reload(&self.gpu, library)?;
            let mask = view_mask(self.desc.views);
            self.pipelines = Pipelines::new(&self.gpu, library, self.desc.format, mask)?;
        }
        Ok(())
    }

    /// Replaces the scene: builds and uploads its meshes, and waits for that.
    ///
    /// # Errors
    /// [`RenderError::Gpu`] out of memory or on device loss.
    pub fn set_scene(&mut self, desc: &SceneDesc) -> Result<(), RenderError> {
        self.scene = Scene::new(&self.gpu, desc)?;
        Ok(())
    }

    /// The ellipsoids that [`Renderer::record`] made last of liquid, as `array<Ellipsoid>`
    /// ([`layout::Ellipsoid`]) in the particles' order; `None` for a renderer
    /// without liquid.
    pub fn ellipsoids(&self) -> Option<&Buffer> {
        self.fluid.as_ref().map(|fluid| fluid.ellipsoids(0))
    }

    /// Takes a mesh of what each view's lens hides, as a runtime gives it: the
    /// corners of triangles, three each, at places of the picture from (0, 0)
    /// at its upper left to (1, 1). They stay black, and their pixels are not
    /// lit. Views without a mesh have an empty slice; waits for the upload.
    ///
    /// # Errors
    /// [`RenderError::Count`] for another number of views,
    /// [`RenderError::Gpu`].
    pub fn set_visibility_mask(&mut self, views: &[&[[f32; 2]]]) -> Result<(), RenderError> {
        if views.len() != self.desc.views as usize {
            return Err(RenderError::Count {
                what: "masks",
                given: views.len(),
                wanted: self.desc.views as usize,
            });
        }
        let corners = |(view, mesh): (usize, &&[[f32; 2]])| {
            let corner = move |&[x, y]: &[f32; 2]| [x, y, view as f32, 0.0];
            mesh.iter().map(corner).collect::<Vec<_>>()
        };
        let corners: Vec<[f32; 4]> = views.iter().enumerate().flat_map(corners).collect();
        self.mask = None;
        if !corners.is_empty() {
            let bytes = size_of_val(&corners[..]) as u64;
            let buffer = Buffer::storage(&self.gpu, "hidden area", bytes)?;
            self.gpu.write(&buffer, &corners)?;
            self.mask = Some(buffer);
        }
        Ok(())
    }

    /// Width and height of each view, pixels.
    pub fn extent(&self) -> [u32; 2] {
        self.desc.extent
    }

    /// The colour image, a layer a view.
    pub fn image(&self) -> &Image {
        &self.colour
    }

    /// The depth image (reversed, see [`crate::camera`]), a layer a view:
    /// particles and solid things, without the glass.
    pub fn depth(&self) -> &Image {
        &self.depth
    }

    /// Records the liquid's surface and thickness, and no picture: for
    /// [`Renderer::read_back_surface`].
    ///
    /// # Errors
    /// As for [`Renderer::record`].
    pub fn record_surface(
        &self,
        rec: &mut Recorder,
        frame: &FrameDesc<'_>,
    ) -> Result<(), RenderError> {
        self.record_shapes(rec, frame, 0)?;
        self.prepare(rec, frame, 0)
    }

    /// Records what comes before the lit picture: uniforms, tiles, the liquid's
    /// surface from that slot.
    fn prepare(
        &self,
        rec: &mut Recorder,
        frame: &FrameDesc<'_>,
        slot: usize,
    ) -> Result<(), RenderError> {
        frame.check(&self.scene, self.desc.views)?;
        let uniforms = frame.uniforms(&self.scene, self.desc.extent);
        rec.upload(&self.frame, &[uniforms])?;
        if let Some((fluid, source)) = self.liquid(frame)? {
            let (shapes, mask) = ((slot, source.count), self.mask.as_ref());
            fluid.record_surface(rec, shapes, &self.frame, &self.tiles, mask)
        } else {
            self.tiles.record(rec, &self.frame, &self.nothing, 0)
        }
    }

    /// Records the picture of one frame.
    ///
    /// # Errors
    /// [`RenderError::Count`] and [`RenderError::TooManyParticles`] where the
    /// frame does not fit; [`RenderError::Gpu`].
    pub fn record(&self, rec: &mut Recorder, frame: &FrameDesc<'_>) -> Result<(), RenderError> {
        self.record_shapes(rec, frame, 0)?;
        self.record_picture(rec, frame, 0)
    }

    /// Records the part of a picture that reads the solver's buffers of the
    /// liquid: compute alone, into one of two slots (`slot` counted modulo two). So the
    /// picture of frame n can be drawn on the main queue while frame n + 1 is
    /// solved on the other:
    ///
    /// - the solver's frame n and this, on the async queue, after the
    ///   picture of frame n − 2, which had the same slot;
    /// - [`Renderer::record_picture`] on the main queue, after that.
    ///
    /// # Errors
    /// As for [`Renderer::record`].
    pub fn record_shapes(
        &self,
        rec: &mut Recorder,
        frame: &FrameDesc<'_>,
        slot: usize,
    ) -> Result<(), RenderError> {
        match self.liquid(frame)? {
            Some((fluid, source)) => fluid.record_shapes(rec, frame, &source, slot),
            None => Ok(()),
        }
    }

    /// Records the rest of the picture, with the liquid from that slot.
    ///
    /// # Errors
    /// As for [`Renderer::record`].
    pub fn record_picture(
        &self,
        rec: &mut Recorder,
        frame: &FrameDesc<'_>,
        slot: usize,
    ) -> Result<(), RenderError> {
        self.prepare(rec, frame, slot)?;
        let liquid = self.liquid(frame)?;
        let target = RasterTarget {
            label: "picture",
            colours: &[ColourTarget {
                image: &self.colour,
                load: Load::Clear(BACKGROUND),
            }],
            depth: Some(DepthTarget {
                image: &self.depth,
                load: Load::Clear(0.0),
            }),
            view_mask: view_mask(self.desc.views),
        };
        rec.raster(&target, |raster| {
            if let Some(mask) = &self.mask {
                raster
                    .draw(&self.pipelines.mask)
                    .read("hidden", mask)
                    .vertices((mask.bytes() / 16) as u32)?;
            }
            if let Some(particles) = &frame.particles {
                self.draw_particles(raster, particles, frame.colour_by)?;
            }
            self.draw_surfaces(raster)?;
            if let Some((fluid, _)) = &liquid {
                fluid.shade(raster, &self.frame, &self.tiles)?;
            }
            // Blending is right only from far to near. A vessel's own far wall
            // comes first; vessels that hide each other are close enough to
            // clear that their order does not show.
            for pipeline in [&self.pipelines.glass_far, &self.pipelines.glass_near] {
                self.draw_glass(raster, pipeline, frame)?;
            }
            Ok(())
        })?;
        self.smooth_edges(rec)?;
        // Steam has no edges, and comes over those of what is behind it.
        frame
            .steam
            .map_or(Ok(()), |steam| self.draw_steam(rec, &steam))
    }

    /// Smooths edges into the second image, and brings those tiles back.
    fn smooth_edges(&self, rec: &mut Recorder) -> Result<(), RenderError> {
        let passes = [
            (
                &self.pipelines.edges,
                &self.colour,
                &self.smoothed,
                Load::Discard,
            ),
            (
                &self.pipelines.copy,
                &self.smoothed,
                &self.colour,
                Load::Keep,
            ),
        ];
        for (pipeline, from, to, load) in passes {
            let target = RasterTarget {
                label: "edges",
                colours: &[ColourTarget { image: to, load }],
                depth: None,
                view_mask: view_mask(self.desc.views),
            };
            rec.raster(&target, |raster| {
                raster
                    .draw(pipeline)
                    .uniform("frame", &self.frame)
                    .read("tiles", self.tiles.marks())
                    .sampled("drawn", from)
                    .sampler("between", &self.between)
                    .constants(&layout::EdgeDraw {
                        views: self.desc.views,
                    })
                    .vertices(self.tiles.vertices())
            })?;
        }
        Ok(())
    }

    fn draw_steam(&self, rec: &mut Recorder, steam: &SteamSource<'_>) -> Result<(), RenderError> {
        let target = RasterTarget {
            label: "steam",
            colours: &[ColourTarget {
                image: &self.colour,
                load: Load::Keep,
            }],
            depth: None,
            view_mask: view_mask(self.desc.views),
        };
        rec.raster(&target, |raster| {
            raster
                .draw(&self.pipelines.steam)
                .uniform("frame", &self.frame)
                .read("puffs", steam.puffs)
                .sampled("depth", &self.depth)
                .vertices(6 * steam.count)
        })?;
        Ok(())
    }

    /// The liquid surface of a frame that has one.
    fn liquid<'a>(
        &self,
        frame: &FrameDesc<'a>,
    ) -> Result<Option<(&Fluid, LiquidSource<'a>)>, RenderError> {
        let Some(source) = frame.liquid else {
            return Ok(None);
        };
        let Some(fluid) = &self.fluid else {
            return Err(RenderError::NoLiquid);
        };
        fluid.check(&source)?;
        Ok(Some((fluid, source)))
    }

    fn draw_particles(
        &self,
        raster: &mut Raster<'_>,
        particles: &ParticleSource<'_>,
        colour_by: ColourBy,
    ) -> Result<(), vitriol_gpu::GpuError> {
        let [start, end] = colour_by.range();
        raster
            .draw(&self.pipelines.particles)
            .uniform("frame", &self.frame)
            .read("positions", particles.positions)
            .read("attributes", particles.attributes)
            .constants(&layout::ParticleDraw {
                radius: particles.radius,
                colour_by: colour_by.attribute(),
                start,
                inverse_range: (end - start).max(f32::MIN_POSITIVE).recip(),
            })
            .vertices(3 * particles.count)
    }

    fn draw_surfaces(&self, raster: &mut Raster<'_>) -> Result<(), vitriol_gpu::GpuError> {
        raster
            .draw(&self.pipelines.surfaces)
            .uniform("frame", &self.frame)
            .vertices(6)
    }

    fn draw_glass(
        &self,
        raster: &mut Raster<'_>,
        pipeline: &RasterPipeline,
        frame: &FrameDesc<'_>,
    ) -> Result<(), vitriol_gpu::GpuError> {
        for (vessel, stage_from_vessel) in self.scene.vessels.iter().zip(frame.vessels) {
            raster
                .draw(pipeline)
                .uniform("frame", &self.frame)
                .read("vertices", &vessel.mesh.vertices)
                .constants(&layout::VesselDraw {
                    stage_from_vessel: Mat4::from(*stage_from_vessel).to_cols_array_2d(),
                })
                .indexed(&vessel.mesh.indices, vessel.mesh.index_count, 1)?;
        }
        Ok(())
    }

    /// Records the copy of the picture to the host, after
    /// [`Renderer::record`]. The bytes can be fetched when the submission has
    /// finished; a film encodes them while the next frame is simulated.
    ///
    /// # Errors
    /// [`RenderError::Gpu`] out of memory, or for a format that cannot be read
    /// back.
    pub fn read_back(&self, rec: &mut Recorder) -> Result<PictureReadback, RenderError> {
        Ok(PictureReadback {
            readback: rec.read_back_image(&self.colour)?,
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
        let fluid = self.fluid.as_ref().ok_or(RenderError::NoLiquid)?;
        fluid.read_back(rec, frame.nears())
    }
}
