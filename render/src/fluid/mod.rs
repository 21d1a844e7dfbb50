//! The liquid's surface in the picture: ellipsoids, depth and thickness,
//! filter, light. `docs/rendering.md` tells it pass by pass.

mod passes;
mod readback;
mod source;

use glam::{Affine3A, Quat};
use vitriol_gpu::{
    Buffer, ColourTarget, DepthTarget, Filter, Gpu, GpuError, Image, ImageDesc, Load, Raster,
    RasterPipeline, RasterTarget, Recorder, Sampler, SamplerDesc, bytes_of_elements, vk,
};
use vitriol_shaders::{Library, ShaderId, layout};

use crate::RenderError;
use crate::frame::FrameDesc;
use crate::pipelines::DEPTH_FORMAT;
use crate::tiles::Tiles;
use passes::{FILTERED_FORMAT, Passes, THICKNESS_FORMAT};
pub use readback::{Surface, SurfaceReadback};
pub use source::{LiquidDesc, LiquidSource, Neighbours, SurfaceFilter, VesselTables};

/// Frames whose ellipsoids are kept at a time.
pub(crate) const SLOTS: usize = 2;

/// How many times fewer pixels along a side the thickness has: it is smooth.
const THICKNESS_SHARE: u32 = 2;

/// Images, buffers and pipelines of the liquid surface.
pub(crate) struct Fluid {
    gpu: Gpu,
    desc: LiquidDesc,
    extent: [u32; 2],
    views: u32,
    format: vk::Format,
    passes: Passes,
    /// One for the picture that is drawn, one for the frame that is solved.
    ellipsoids: [Buffer; SLOTS],
    poses: Buffer,
    /// Bound where a source has nothing to give.
    nothing: Buffer,
    depth: Image,
    /// Between the filter's passes; the first is where its last one ends.
    filtered: [Image; 2],
    thickness: Image,
    between: Sampler,
}

impl Fluid {
    pub(crate) fn new(
        gpu: &Gpu,
        library: &Library,
        desc: LiquidDesc,
        extent: [u32; 2],
        views: u32,
        format: vk::Format,
    ) -> Result<Self, RenderError> {
        let image = |label: &str, extent, format, usage| {
            let desc = ImageDesc {
                extent,
                layers: views,
                format,
                usage: usage | vk::ImageUsageFlags::SAMPLED,
            };
            Image::new(gpu, label, desc)
        };
        let colour = vk::ImageUsageFlags::COLOR_ATTACHMENT;
        let filtered = |label| image(label, extent, FILTERED_FORMAT, colour);
        let half = extent.map(|side| side.div_ceil(THICKNESS_SHARE));
        let ellipsoids = bytes_of_elements::<layout::Ellipsoid>(desc.particles as usize);
        Ok(Self {
            gpu: gpu.clone(),
            desc,
            extent,
            views,
            format,
            passes: Passes::new(gpu, library, desc.filter, format, view_mask(views))?,
            ellipsoids: [
                Buffer::storage(gpu, "ellipsoids", ellipsoids)?,
                Buffer::storage(gpu, "other ellipsoids", ellipsoids)?,
            ],
            poses: Buffer::storage(
                gpu,
                "vessel poses",
                bytes_of_elements::<layout::FlaskPose>(MOST_VESSELS),
            )?,
            nothing: zeros(gpu)?,
            depth: image(
                "liquid depth",
                extent,
                DEPTH_FORMAT,
                vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT,
            )?,
            filtered: [filtered("liquid surface")?, filtered("half-filtered")?],
            thickness: image("thickness", half, THICKNESS_FORMAT, colour)?,
            between: Sampler::new(
                gpu,
                SamplerDesc {
                    filter: Filter::Linear,
                    ..SamplerDesc::default()
                },
            )?,
        })
    }

    /// Takes up changed shaders.
    pub(crate) fn reload(&mut self, library: &Library) -> Result<(), RenderError> {
        self.passes = Passes::new(
            &self.gpu,
            library,
            self.desc.filter,
            self.format,
            view_mask(self.views),
        )?;
        Ok(())
    }

    /// Whether any of these shaders is the liquid's.
    pub(crate) fn uses(changed: &[ShaderId]) -> bool {
        changed
            .iter()
            .any(|id| id.path().starts_with("render/fluid/"))
    }

    pub(crate) fn ellipsoids(&self, slot: usize) -> &Buffer {
        &self.ellipsoids[slot % SLOTS]
    }

    /// Refuses a source that does not fit.
    pub(crate) fn check(&self, source: &LiquidSource<'_>) -> Result<(), RenderError> {
        source.check(self.desc.particles)
    }

    /// Records everything from the ellipsoids in a slot up to the filtered depth.
    pub(crate) fn record_surface(
        &self,
        rec: &mut Recorder,
        (slot, count): (usize, u32),
        uniforms: &Buffer,
        tiles: &Tiles,
        mask: Option<&Buffer>,
    ) -> Result<(), RenderError> {
        let ellipsoids = self.ellipsoids(slot);
        tiles.record(rec, uniforms, ellipsoids, count)?;
        self.draw_depth(rec, (ellipsoids, count), uniforms, mask)?;
        self.draw_thickness(rec, (ellipsoids, count), uniforms)?;
        self.filter(rec, uniforms, tiles)
    }

    /// Particles to ellipsoids: all that is read of the solver's buffers.
    pub(crate) fn record_shapes(
        &self,
        rec: &mut Recorder,
        frame: &FrameDesc<'_>,
        source: &LiquidSource<'_>,
        slot: usize,
    ) -> Result<(), RenderError> {
        let poses: Vec<layout::FlaskPose> =
            frame.vessels.iter().map(pose).take(MOST_VESSELS).collect();
        rec.upload(&self.poses, &poses)?;
        let neighbours = source.neighbours.filter(|_| self.desc.anisotropic);
        let list = |of: fn(Neighbours<'_>) -> &Buffer| neighbours.map_or(&self.nothing, of);
        let vessels = source.vessels;
        let table = source.table;
        let corner = |corner: Option<glam::Vec3>| corner.map_or([0.0; 2], |at| [at.x, at.z]);
        rec.pass(&self.passes.anisotropy)
            .read("positions", source.positions)
            .label("anisotropy")
            .read("list_counts", list(|n| n.counts))
            .read("list", list(|n| n.list))
            .read("heat", source.heat.unwrap_or(&self.nothing))
            .read("volumes", source.volumes.unwrap_or(&self.nothing))
            .read("flasks", vessels.map_or(&self.nothing, |v| v.flasks))
            .read("distances", vessels.map_or(&self.nothing, |v| v.distances))
            .read("poses", &self.poses)
            .write("ellipsoids", self.ellipsoids(slot))
            .constants(&layout::Neighbourhood {
                count: source.count,
                flasks: vessels.map_or(0, |_| poses.len() as u32),
                anisotropic: neighbours.is_some().into(),
                heated: source.heat.is_some().into(),
                swelling: source.volumes.is_some().into(),
                spacing: source.spacing,
                support: neighbours.map_or(source.spacing, |n| n.support),
                floor: source.floor,
                table_top: table.map_or(f32::MIN, |table| table.max.y),
                table_min: corner(table.map(|table| table.min)),
                table_max: corner(table.map(|table| table.max)),
                ..layout::Neighbourhood::default()
            })
            .invocations(source.count * self.passes.lanes)?;
        Ok(())
    }

    fn draw_depth(
        &self,
        rec: &mut Recorder,
        (ellipsoids, count): (&Buffer, u32),
        uniforms: &Buffer,
        mask: Option<&Buffer>,
    ) -> Result<(), RenderError> {
        let target = RasterTarget {
            label: "liquid depth",
            colours: &[],
            depth: Some(DepthTarget {
                image: &self.depth,
                load: Load::Clear(0.0),
            }),
            view_mask: view_mask(self.views),
        };
        rec.raster(&target, |raster| {
            if let Some(mask) = mask {
                raster
                    .draw(&self.passes.mask)
                    .read("hidden", mask)
                    .vertices((mask.bytes() / 16) as u32)?;
            }
            raster
                .draw(&self.passes.splat)
                .uniform("frame", uniforms)
                .read("ellipsoids", ellipsoids)
                .vertices(3 * count)
        })?;
        Ok(())
    }

    fn draw_thickness(
        &self,
        rec: &mut Recorder,
        (ellipsoids, count): (&Buffer, u32),
        uniforms: &Buffer,
    ) -> Result<(), RenderError> {
        let target = RasterTarget {
            label: "liquid thickness",
            colours: &[ColourTarget {
                image: &self.thickness,
                load: Load::Clear([0.0; 4]),
            }],
            depth: None,
            view_mask: view_mask(self.views),
        };
        rec.raster(&target, |raster| {
            raster
                .draw(&self.passes.thickness)
                .uniform("frame", uniforms)
                .read("ellipsoids", ellipsoids)
                .vertices(3 * count)
        })?;
        Ok(())
    }

    fn filter(
        &self,
        rec: &mut Recorder,
        uniforms: &Buffer,
        tiles: &Tiles,
    ) -> Result<(), RenderError> {
        let last = self.passes.filter.len() - 1;
        rec.group("liquid filter", |rec| {
            for (index, pass) in self.passes.filter.iter().enumerate() {
                let to = (last - index) % 2;
                self.filter_once(
                    rec,
                    pass,
                    &self.filtered[1 - to],
                    &self.filtered[to],
                    uniforms,
                    tiles,
                )?;
            }
            Ok(())
        })?;
        Ok(())
    }

    fn filter_once(
        &self,
        rec: &mut Recorder,
        pass: &RasterPipeline,
        from: &Image,
        to: &Image,
        uniforms: &Buffer,
        tiles: &Tiles,
    ) -> Result<(), GpuError> {
        let target = RasterTarget {
            label: "liquid filter",
            colours: &[ColourTarget {
                image: to,
                load: Load::Clear([0.0; 4]),
            }],
            depth: None,
            view_mask: view_mask(self.views),
        };
        rec.raster(&target, |raster| {
            raster
                .draw(pass)
                .uniform("frame", uniforms)
                .read("tiles", tiles.marks())
                .sampled("splatted", &self.depth)
                .sampled("before", from)
                .vertices(tiles.vertices())
        })
    }

    /// Draws the lit surface; within a raster scope of picture and depth.
    pub(crate) fn shade(
        &self,
        raster: &mut Raster<'_>,
        uniforms: &Buffer,
        tiles: &Tiles,
    ) -> Result<(), GpuError> {
        raster
            .draw(&self.passes.shade)
            .uniform("frame", uniforms)
            .read("tiles", tiles.marks())
            .sampled("surface", &self.filtered[0])
            .sampled("thickness", &self.thickness)
            .sampler("between", &self.between)
            .vertices(tiles.vertices())
    }

    /// Records the copy of the surface to the host.
    pub(crate) fn read_back(
        &self,
        rec: &mut Recorder,
        nears: Vec<f32>,
    ) -> Result<SurfaceReadback, RenderError> {
        Ok(SurfaceReadback {
            depth: rec.read_back_image(&self.filtered[0])?,
            thickness: rec.read_back_image(&self.thickness)?,
            nears,
            extent: self.extent,
            thickness_extent: self.thickness.desc().extent,
        })
    }
}

/// Vessels that a frame holds at most.
pub(crate) const MOST_VESSELS: usize = 8;

fn pose(stage_from_vessel: &Affine3A) -> layout::FlaskPose {
    let orientation = Quat::from_mat3a(&stage_from_vessel.matrix3);
    layout::FlaskPose {
        position: stage_from_vessel.translation.extend(0.0).to_array(),
        orientation: orientation.to_array(),
    }
}

/// Sixteen bytes of zero: temperature and acid of a particle that has none.
fn zeros(gpu: &Gpu) -> Result<Buffer, GpuError> {
    let buffer = Buffer::storage(gpu, "nothing", 16)?;
    gpu.write(&buffer, &[0_u32; 4])?;
    Ok(buffer)
}

/// A bit per view.
pub(crate) fn view_mask(views: u32) -> u32 {
    (1 << views) - 1
}
