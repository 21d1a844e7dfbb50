//! Particles as spheres, coloured by an attribute: the films of temperature, acid and speed.

use vitriol_gpu::{Buffer, ComputePipeline, Gpu, GpuError, Recorder, vk};
use vitriol_shaders::{Library, ShaderId, layout, spheres};

use crate::RenderError;
use crate::compute::compute;
use crate::frame::ColourBy;
use crate::lanes::workgroups;
use crate::solids::Solids;
use crate::source::ParticleSource;
use crate::tiles::{Class, Tiles};

/// Invocations that share a sphere: on a CPU eight lanes of a vector; on a GPU at least a warp, and of few
/// spheres so many more that all of them together fill it.
const LEAST_LANES: [u32; 2] = [32, 8];
const MOST_LANES: [u32; 2] = [1024, 8];
const FILLS: u32 = 1 << 17;

/// The nearest sphere at each pixel and its light.
pub(crate) struct Spheres {
    nearest_pass: ComputePipeline,
    light_pass: ComputePipeline,
    views: u32,
    is_cpu: bool,
}

impl Spheres {
    pub(crate) fn new(gpu: &Gpu, library: &Library, views: u32) -> Result<Self, RenderError> {
        let class = ("CLASS", f64::from(Class::Spheres as u32));
        Ok(Self {
            nearest_pass: compute(gpu, library, spheres::NEAREST, &[])?,
            light_pass: compute(gpu, library, spheres::LIGHT, &[class])?,
            views,
            is_cpu: gpu.info().kind == vk::PhysicalDeviceType::CPU,
        })
    }

    /// Whether any of these shaders is one of these.
    pub(crate) fn uses(changed: &[ShaderId]) -> bool {
        changed
            .iter()
            .any(|id| id.path().starts_with("render/spheres/"))
    }

    /// Records which sphere is nearest, and marks the tiles that they are in, which are marked
    /// with everything else by then and not listed yet.
    pub(crate) fn record_nearest(
        &self,
        rec: &mut Recorder,
        uniforms: &Buffer,
        particles: &ParticleSource<'_>,
        solids: &Solids,
        tiles: &Tiles,
    ) -> Result<(), GpuError> {
        let [least, most] = [LEAST_LANES, MOST_LANES].map(|lanes| lanes[usize::from(self.is_cpu)]);
        let share = (FILLS / particles.count.max(1)).next_power_of_two();
        let lanes = share.clamp(least, most);
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
                    .workgroups(workgroups(particles.count, lanes, self.views))?;
            }
            Ok(())
        })
    }

    /// Records their light; the tiles are listed.
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
