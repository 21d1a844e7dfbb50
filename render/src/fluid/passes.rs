//! Pipelines of the liquid surface.

use vitriol_gpu::{ComputePipeline, Gpu, vk};
use vitriol_shaders::{Library, ShaderId, fluid};

use crate::RenderError;
use crate::compute::compute;
use crate::desc::SurfaceFilter;
use crate::tiles::Class;

/// Invocations that share a particle's neighbours on a GPU: the latency of
/// fetching a list is what a few ten thousand particles cost there.
const SHARED_BY: u32 = 4;

/// Steps of curvature flow, for which its shader chooses the time step.
const FLOW_STEPS: u32 = 40;

/// Invocations that share an ellipsoid's pixels: a warp on a GPU, eight lanes of a vector on a CPU.
const SPLATTED_BY: [u32; 2] = [32, 8];

/// One of each, and the filter's in their order.
pub(super) struct Passes {
    pub(super) anisotropy: ComputePipeline,
    /// Invocations of it that share a particle.
    pub(super) lanes: u32,
    pub(super) splat: ComputePipeline,
    pub(super) thickness: ComputePipeline,
    /// Invocations of these two that share a particle.
    pub(super) splat_lanes: u32,
    pub(super) filter: Vec<ComputePipeline>,
}

impl Passes {
    pub(super) fn new(
        gpu: &Gpu,
        library: &Library,
        filter: SurfaceFilter,
    ) -> Result<Self, RenderError> {
        let info = gpu.info();
        let is_cpu = info.kind == vk::PhysicalDeviceType::CPU;
        let lanes = if !is_cpu && info.features.subgroups {
            SHARED_BY
        } else {
            1
        };
        let splat_lanes = SPLATTED_BY[usize::from(is_cpu)];
        let compute = |shader, constants: &[_]| compute(gpu, library, shader, constants);
        let splat = |shader| compute(shader, &[("LANES", splat_lanes.into())]);
        Ok(Self {
            anisotropy: compute(fluid::ANISOTROPY, &[("LANES", lanes.into())])?,
            lanes,
            splat: splat(fluid::SPLAT)?,
            thickness: splat(fluid::THICKNESS)?,
            splat_lanes,
            filter: stages(filter)
                .into_iter()
                .map(|(shader, constants)| compute(shader, &constants))
                .collect::<Result<_, _>>()?,
        })
    }
}

/// Shader and constants of each pass of a filter.
fn stages(filter: SurfaceFilter) -> Vec<(ShaderId, Vec<(&'static str, f64)>)> {
    let (shader, passes) = match filter {
        SurfaceFilter::NarrowRange => (fluid::NARROW_RANGE, 3),
        SurfaceFilter::CurvatureFlow => (fluid::CURVATURE_FLOW, FLOW_STEPS),
        SurfaceFilter::None => (fluid::NARROW_RANGE, 1),
    };
    let constants = |pass: u32| {
        let own = match filter {
            SurfaceFilter::NarrowRange => ("PASS", pass.into()),
            SurfaceFilter::CurvatureFlow => ("STEPS", FLOW_STEPS.into()),
            // Only cuts what reaches into the glass.
            SurfaceFilter::None => ("PASS", 3.0),
        };
        let last = f64::from(u8::from(pass + 1 == passes));
        vec![
            own,
            ("LAST", last),
            ("CLASS", f64::from(Class::Liquid as u32)),
        ]
    };
    (0..passes).map(|pass| (shader, constants(pass))).collect()
}
