//! The liquid's surface in the picture: ellipsoids, depth, thickness and the
//! filter. `docs/rendering.md` explains it pass by pass.

mod bubbles;
mod passes;
mod readback;

use glam::{Affine3A, Quat};
use vitriol_gpu::{Buffer, ComputePipeline, Gpu, GpuError, Recorder, bytes_of_elements};
use vitriol_shaders::{Library, layout};

use crate::RenderError;
use crate::desc::{Lanes, LiquidDesc};
use crate::frame::FrameDesc;
use crate::half_depth::half;
use crate::lanes::workgroups;
use crate::scene::MOST_VESSELS;
use crate::source::{LiquidSource, Neighbours};
use crate::tiles::{Class, Tiles};
use bubbles::BubbleCells;
pub(crate) use bubbles::Cells;
use passes::Passes;
pub use readback::{Surface, SurfaceReadback};

/// Number of frames whose ellipsoids are kept at a time.
pub(crate) const SLOTS: usize = 2;

/// Buffers and pipelines of the liquid surface.
pub(crate) struct Fluid {
    desc: LiquidDesc,
    extent: [u32; 2],
    passes: Passes,
    /// Ellipsoids of the frame that is drawn, and of the frame that is solved.
    ellipsoids: [Buffer; SLOTS],
    poses: Buffer,
    /// Bound in place of buffers that a source does not have.
    nothing: Buffer,
    /// Reversed depth of the splatted ellipsoids, each view's pixels row by row.
    depth: Buffer,
    /// Reversed depth between the filter's passes; the result is in the first.
    filtered: [Buffer; 2],
    /// Thickness and acid of blocks of four pixels.
    sums: Buffer,
    bubbles: BubbleCells,
}

impl Fluid {
    pub(crate) fn new(
        gpu: &Gpu,
        library: &Library,
        desc: LiquidDesc,
        extent: [u32; 2],
        views: u32,
        lanes: Lanes,
    ) -> Result<Self, RenderError> {
        let pixels = |[width, height]: [u32; 2]| (views * width * height) as usize;
        let floats =
            |label: &str| Buffer::storage(gpu, label, bytes_of_elements::<f32>(pixels(extent)));
        let blocks = pixels(half(extent));
        let ellipsoids = bytes_of_elements::<layout::Ellipsoid>(desc.particles as usize);
        Ok(Self {
            desc,
            extent,
            passes: Passes::new(gpu, library, desc.filter, lanes)?,
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
            depth: floats("liquid depth")?,
            filtered: [floats("liquid surface")?, floats("half-filtered")?],
            sums: Buffer::storage(gpu, "thickness", bytes_of_elements::<[u32; 2]>(blocks))?,
            bubbles: BubbleCells::new(gpu, library, desc.bubbles, views)?,
        })
    }

    pub(crate) fn ellipsoids(&self, slot: usize) -> &Buffer {
        &self.ellipsoids[slot % SLOTS]
    }

    /// Checks that a source fits the renderer's buffers.
    pub(crate) fn check(&self, source: &LiquidSource<'_>) -> Result<(), RenderError> {
        source.check(&self.desc)
    }

    /// Records the passes from the ellipsoids in a slot up to the filtered depth of a frame's `views`; the lists of tiles must have been
    /// recorded.
    pub(crate) fn record_surface(
        &self,
        rec: &mut Recorder,
        (slot, count, views): (usize, u32, u32),
        uniforms: &Buffer,
        tiles: &Tiles,
    ) -> Result<(), RenderError> {
        let splat = |rec: &mut Recorder, label, pass: &ComputePipeline, name, into: &Buffer| {
            rec.group(label, |rec| {
                rec.fill(into, 0)?;
                let lanes = self.passes.splat_lanes;
                rec.pass(pass)
                    .label(label)
                    .uniform("frame", uniforms)
                    .read("ellipsoids", self.ellipsoids(slot))
                    .write(name, into)
                    .constants(&layout::Splats { count })
                    .workgroups(workgroups(count, lanes, views))
            })
        };
        splat(
            rec,
            "liquid depth",
            &self.passes.splat,
            "depth",
            &self.depth,
        )?;
        splat(
            rec,
            "liquid thickness",
            &self.passes.thickness,
            "sums",
            &self.sums,
        )?;
        self.filter(rec, uniforms, tiles)
    }

    /// Records the passes that turn particles into ellipsoids and sort bubbles into cells: no others read the solver's buffers.
    pub(crate) fn record_shapes(
        &self,
        rec: &mut Recorder,
        frame: &FrameDesc<'_>,
        source: &LiquidSource<'_>,
        slot: usize,
    ) -> Result<(), RenderError> {
        let poses: Vec<layout::FlaskPose> = frame.vessels.iter().map(pose).collect();
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
                fours: neighbours.map_or(0, |n| n.fours),
                floor: source.floor,
                table_top: table.map_or(f32::MIN, |table| table.max.y),
                table_min: corner(table.map(|table| table.min)),
                table_max: corner(table.map(|table| table.max)),
            })
            .invocations(source.count * self.passes.lanes)?;
        self.bubbles
            .record(rec, source.bubbles, frame.length_scale, slot)?;
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
            // The passes skip tiles without liquid, and read their pixels at the borders of others.
            for to in &self.filtered[..=last.min(1)] {
                rec.fill(to, 0)?;
            }
            let mut from = &self.depth;
            for (index, pass) in self.passes.filter.iter().enumerate() {
                let to = &self.filtered[(last - index) % 2];
                let pass = rec
                    .pass(pass)
                    .label("liquid filter")
                    .uniform("frame", uniforms)
                    .read("before", from)
                    .write("after", to);
                tiles.over(Class::Liquid, pass)?;
                from = to;
            }
            Ok(())
        })?;
        Ok(())
    }

    /// Cells in which rays look for bubbles.
    pub(crate) fn bubbles(&self, slot: usize) -> &Cells {
        self.bubbles.of(slot)
    }

    /// The filtered reversed depth.
    pub(crate) fn surface(&self) -> &Buffer {
        &self.filtered[0]
    }

    /// Thickness and acid of blocks of four pixels.
    pub(crate) fn sums(&self) -> &Buffer {
        &self.sums
    }

    /// Reversed depth of the splatted ellipsoids, before the filter.
    pub(crate) fn splatted(&self) -> &Buffer {
        &self.depth
    }

    /// Records the copy of the surface to the host, with the depth from `depth`.
    pub(crate) fn read_back(
        &self,
        rec: &mut Recorder,
        depth: &Buffer,
        nears: Vec<f32>,
        spacing: f32,
    ) -> Result<SurfaceReadback, RenderError> {
        Ok(SurfaceReadback {
            depth: rec.read_back(depth)?,
            sums: rec.read_back(&self.sums)?,
            nears,
            extent: self.extent,
            blocks: half(self.extent),
            spacing,
        })
    }
}

fn pose(stage_from_vessel: &Affine3A) -> layout::FlaskPose {
    let orientation = Quat::from_mat3a(&stage_from_vessel.matrix3);
    layout::FlaskPose {
        position: stage_from_vessel.translation.extend(0.0).to_array(),
        orientation: orientation.to_array(),
    }
}

/// Sixteen bytes of zero, bound in place of buffers that a frame does not have.
pub(crate) fn zeros(gpu: &Gpu) -> Result<Buffer, GpuError> {
    let buffer = Buffer::storage(gpu, "nothing", 16)?;
    gpu.write_ahead(&buffer, &[0_u32; 4])?;
    Ok(buffer)
}
