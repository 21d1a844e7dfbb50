//! Pipelines of the liquid surface.

use vitriol_gpu::{
    Blend, ColourFormat, ComputePipeline, Cull, DepthFormat, Gpu, RasterDesc, RasterPipeline,
    Topology, vk,
};
use vitriol_shaders::{Library, ShaderId, fluid, render};

use super::source::SurfaceFilter;
use crate::RenderError;
use crate::pipelines::DEPTH_FORMAT;

/// Format of filtered depth.
pub(super) const FILTERED_FORMAT: vk::Format = vk::Format::R32_SFLOAT;
/// Format of thickness and acid.
pub(super) const THICKNESS_FORMAT: vk::Format = vk::Format::R16G16_SFLOAT;

/// Invocations that share a particle's neighbours on a GPU: the latency of
/// fetching a list is what a few ten thousand particles cost there.
const SHARED_BY: u32 = 4;

/// Steps of curvature flow, for which its shader chooses the time step.
const FLOW_STEPS: u32 = 40;

/// One of each, and the filter's in their order.
pub(super) struct Passes {
    pub(super) anisotropy: ComputePipeline,
    /// Invocations of it that share a particle.
    pub(super) lanes: u32,
    /// The part of the picture that no eye sees.
    pub(super) mask: RasterPipeline,
    pub(super) splat: RasterPipeline,
    pub(super) thickness: RasterPipeline,
    pub(super) filter: Vec<RasterPipeline>,
    pub(super) shade: RasterPipeline,
}

impl Passes {
    pub(super) fn new(
        gpu: &Gpu,
        library: &Library,
        filter: SurfaceFilter,
        picture: vk::Format,
        view_mask: u32,
    ) -> Result<Self, RenderError> {
        let info = gpu.info();
        let shares = info.kind != vk::PhysicalDeviceType::CPU && info.features.subgroups;
        let lanes = if shares { SHARED_BY } else { 1 };
        let compute = |shader: ShaderId, constants: &[(&str, f64)]| {
            let compiled = library.compile(&shader, "main", constants)?;
            Ok::<_, RenderError>(ComputePipeline::new(gpu, &compiled)?)
        };
        let raster = |shader: ShaderId,
                      constants: &[(&str, f64)],
                      colours: &[ColourFormat],
                      depth: Option<DepthFormat>| {
            let vertex = library.compile(&shader, "vertex", &[])?;
            let fragment = library.compile(&shader, "fragment", constants)?;
            let desc = RasterDesc {
                vertex: &vertex,
                fragment: Some(&fragment),
                colours,
                depth,
                topology: Topology::Triangles,
                cull: Cull::None,
                view_mask,
            };
            Ok::<_, RenderError>(RasterPipeline::new(gpu, &desc)?)
        };
        let colour = |format, blend| [ColourFormat { format, blend }];
        let depth = Some(DepthFormat {
            format: DEPTH_FORMAT,
            compare: vk::CompareOp::GREATER,
            write: true,
        });
        let filtered = colour(FILTERED_FORMAT, Blend::Replace);
        let filter = stages(filter)
            .into_iter()
            .map(|(shader, constants)| raster(shader, &constants, &filtered, None))
            .collect::<Result<_, _>>()?;
        Ok(Self {
            anisotropy: compute(fluid::ANISOTROPY, &[("LANES", lanes.into())])?,
            lanes,
            mask: mask(gpu, library, view_mask)?,
            splat: raster(fluid::SPLAT, &[], &[], depth)?,
            thickness: raster(
                fluid::THICKNESS,
                &[],
                &colour(THICKNESS_FORMAT, Blend::Add),
                None,
            )?,
            filter,
            shade: raster(fluid::SHADE, &[], &colour(picture, Blend::Replace), depth)?,
        })
    }
}

fn mask(gpu: &Gpu, library: &Library, view_mask: u32) -> Result<RasterPipeline, RenderError> {
    let desc = RasterDesc {
        vertex: &library.compile(&render::MASK, "vertex", &[])?,
        fragment: None,
        colours: &[],
        depth: Some(DepthFormat {
            format: DEPTH_FORMAT,
            compare: vk::CompareOp::GREATER,
            write: true,
        }),
        topology: Topology::Triangles,
        cull: Cull::None,
        view_mask,
    };
    Ok(RasterPipeline::new(gpu, &desc)?)
}

/// Shader and constants of each pass of a filter; the first one reads what
/// was splatted.
fn stages(filter: SurfaceFilter) -> Vec<(ShaderId, Vec<(&'static str, f64)>)> {
    match filter {
        SurfaceFilter::NarrowRange => (0..3)
            .map(|pass| {
                let first = f64::from(u8::from(pass == 0));
                let last = f64::from(u8::from(pass == 2));
                let constants = vec![("PASS", f64::from(pass)), ("FIRST", first), ("LAST", last)];
                (fluid::NARROW_RANGE, constants)
            })
            .collect(),
        SurfaceFilter::CurvatureFlow => (0..FLOW_STEPS)
            .map(|step| {
                let first = f64::from(u8::from(step == 0));
                let last = f64::from(u8::from(step + 1 == FLOW_STEPS));
                let constants = vec![
                    ("STEPS", FLOW_STEPS.into()),
                    ("FIRST", first),
                    ("LAST", last),
                ];
                (fluid::CURVATURE_FLOW, constants)
            })
            .collect(),
        SurfaceFilter::None => {
            vec![(fluid::NARROW_RANGE, vec![("PASS", 3.0), ("FIRST", 1.0)])]
        }
    }
}
