//! The pipelines of the picture. All share the targets' formats and the
//! reversed depth test.

use vitriol_gpu::{
    Blend, ColourFormat, Cull, DepthFormat, Gpu, RasterDesc, RasterPipeline, Topology, vk,
};
use vitriol_shaders::{Library, ShaderId, render};

use crate::RenderError;

/// Format of the depth image: reversed depth needs the floating point.
pub(crate) const DEPTH_FORMAT: vk::Format = vk::Format::D32_SFLOAT;

/// One of each.
pub(crate) struct Pipelines {
    pub(crate) particles: RasterPipeline,
    pub(crate) surfaces: RasterPipeline,
    /// The glass's faces that look away from the eye.
    pub(crate) glass_far: RasterPipeline,
    /// Those that look at it.
    pub(crate) glass_near: RasterPipeline,
    pub(crate) steam: RasterPipeline,
    /// The part of the picture that no eye sees.
    pub(crate) mask: RasterPipeline,
    /// The finished picture with its edges smoothed.
    pub(crate) edges: RasterPipeline,
    /// Its tiles, brought back as they are.
    pub(crate) copy: RasterPipeline,
}

impl Pipelines {
    pub(crate) fn new(
        gpu: &Gpu,
        library: &Library,
        format: vk::Format,
        view_mask: u32,
    ) -> Result<Self, RenderError> {
        let make = |shader: ShaderId, cull: Cull, glass: bool| {
            let vertex = library.compile(&shader, "vertex", &[])?;
            let fragment = library.compile(&shader, "fragment", &[])?;
            let blend = if glass {
                Blend::Premultiplied
            } else {
                Blend::Replace
            };
            let desc = RasterDesc {
                vertex: &vertex,
                fragment: Some(&fragment),
                colours: &[ColourFormat { format, blend }],
                depth: Some(DepthFormat {
                    format: DEPTH_FORMAT,
                    compare: vk::CompareOp::GREATER,
                    write: !glass,
                }),
                topology: Topology::Triangles,
                cull,
                view_mask,
            };
            Ok::<_, RenderError>(RasterPipeline::new(gpu, &desc)?)
        };
        let over = |pass: (ShaderId, &[(&str, f64)]), blend| {
            over(
                gpu,
                library,
                pass,
                ColourFormat { format, blend },
                view_mask,
            )
        };
        Ok(Self {
            particles: make(render::PARTICLES, Cull::None, false)?,
            surfaces: make(render::SURFACES, Cull::None, false)?,
            glass_far: make(render::GLASS, Cull::Front, true)?,
            glass_near: make(render::GLASS, Cull::Back, true)?,
            steam: over((render::STEAM, &[]), Blend::Premultiplied)?,
            mask: make(render::MASK, Cull::None, false)?,
            edges: over((render::EDGES, &[("COPY", 0.0)]), Blend::Replace)?,
            copy: over((render::EDGES, &[("COPY", 1.0)]), Blend::Replace)?,
        })
    }

    /// Whether any of these shaders is one of this crate's.
    pub(crate) fn uses(changed: &[ShaderId]) -> bool {
        changed.iter().any(|id| USED.contains(id))
    }
}

const USED: [ShaderId; 7] = [
    render::STEAM,
    render::MASK,
    render::TILES,
    render::PARTICLES,
    render::SURFACES,
    render::GLASS,
    render::EDGES,
];

/// Over the finished picture, whose depth it does not test.
fn over(
    gpu: &Gpu,
    library: &Library,
    (shader, constants): (ShaderId, &[(&str, f64)]),
    colour: ColourFormat,
    view_mask: u32,
) -> Result<RasterPipeline, RenderError> {
    let desc = RasterDesc {
        vertex: &library.compile(&shader, "vertex", &[])?,
        fragment: Some(&library.compile(&shader, "fragment", constants)?),
        colours: &[colour],
        depth: None,
        topology: Topology::Triangles,
        cull: Cull::None,
        view_mask,
    };
    Ok(RasterPipeline::new(gpu, &desc)?)
}
