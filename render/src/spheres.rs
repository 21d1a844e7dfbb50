//! Particles as spheres, coloured by an attribute: the films of temperature, acid and speed.

use vitriol_gpu::{Buffer, ComputePipeline, DeviceInfo, Gpu, GpuError, Recorder};
use vitriol_shaders::{Library, layout, spheres};

use crate::RenderError;
use crate::compute::compute;
use crate::desc::Lanes;
use crate::frame::ColourBy;
use crate::lanes::{self, workgroups};
use crate::solids::Solids;
use crate::source::ParticleSource;
use crate::tiles::{Class, Tiles};

/// The nearest sphere at each pixel and its light.
pub(crate) struct Spheres {
    nearest_pass: ComputePipeline,
    light_pass: ComputePipeline,
    info: DeviceInfo,
    /// Lanes of a sphere that were asked for.
    asked: Option<u32>,
}

impl Spheres {
    pub(crate) fn new(gpu: &Gpu, library: &Library, asked: Lanes) -> Result<Self, RenderError> {
        let class = ("CLASS", f64::from(Class::Spheres as u32));
        Ok(Self {
            nearest_pass: compute(gpu, library, spheres::NEAREST, &[])?,
            light_pass: compute(gpu, library, spheres::LIGHT, &[class])?,
            info: gpu.info().clone(),
            asked: asked.pixels,
        })
    }

    /// Records the passes that find the nearest sphere of each pixel of so many views and mark the tiles with spheres, after the other marks
    /// and before the lists.
    pub(crate) fn record_nearest(
        &self,
        rec: &mut Recorder,
        uniforms: &Buffer,
        (particles, views): (&ParticleSource<'_>, u32),
        solids: &Solids,
        tiles: &Tiles,
    ) -> Result<(), GpuError> {
        let lanes = lanes::of_spheres(&self.info, self.asked, particles.count);
        rec.group("spheres", |rec| {
            rec.fill(&solids.depths, 0)?;
            rec.fill(&solids.nearest, 0)?;
            for numbers in [0, 1] {
                rec.pass(&self.nearest_pass)
                    .label("spheres")
                    .uniform("frame", uniforms)
                    .read("positions", particles.positions)
                    .write("depths", &solids.depths)
                    .write("nearest", &solids.nearest)
                    .write("tiles", tiles.marks())
                    .constants(&layout::SphereRun {
                        count: particles.count,
                        lanes,
                        radius: particles.radius,
                        numbers,
                    })
                    .workgroups(workgroups(particles.count, lanes, views))?;
            }
            Ok(())
        })
    }

    /// Records their light, after the lists of tiles.
    pub(crate) fn record_light(
        &self,
        rec: &mut Recorder,
        uniforms: &Buffer,
        particles: &ParticleSource<'_>,
        colour_by: ColourBy,
        solids: &Solids,
        tiles: &Tiles,
    ) -> Result<(), GpuError> {
        let [start, end] = colour_by.range();
        let pass = rec
            .pass(&self.light_pass)
            .label("spheres")
            .uniform("frame", uniforms)
            .read("positions", particles.positions)
            .read("attributes", particles.attributes)
            .read("depths", &solids.depths)
            .write("nearest", &solids.nearest)
            .constants(&layout::SphereLight {
                radius: particles.radius,
                colour_by: colour_by.attribute(),
                start,
                inverse_range: (end - start).max(f32::MIN_POSITIVE).recip(),
            });
        tiles.over(Class::Spheres, pass)
    }
}
