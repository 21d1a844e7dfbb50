//! Pipelines of the liquid surface.

use vitriol_gpu::{ComputePipeline, Gpu};
use vitriol_shaders::{Library, ShaderId, fluid};

use crate::RenderError;
use crate::compute::compute;
use crate::desc::{Lanes, SurfaceFilter};
use crate::lanes;
use crate::tiles::Class;

/// Steps of curvature flow, for which its shader chooses the time step.
const FLOW_STEPS: u32 = 40;

/// One pipeline of each pass, and the filter's in their order.
pub(super) struct Passes {
    pub(super) anisotropy: ComputePipeline,
    /// Invocations of `anisotropy` that share a particle.
    pub(super) lanes: u32,
    pub(super) splat: ComputePipeline,
    pub(super) thickness: ComputePipeline,
    /// Invocations of `splat` and `thickness` that share a particle.
    pub(super) splat_lanes: u32,
    pub(super) filter: Vec<ComputePipeline>,
}

impl Passes {
    pub(super) fn new(
        gpu: &Gpu,
        library: &Library,
        filter: SurfaceFilter,
        asked: Lanes,
    ) -> Result<Self, RenderError> {
        let lanes = lanes::of_neighbours(gpu.info(), asked.neighbours)?;
        let splat_lanes = lanes::of_splats(gpu.info(), asked.pixels)?;
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
            // It only cuts off ellipsoids that reach into the glass.
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
