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
        Ok(Self {
            particles: make(render::PARTICLES, Cull::None, false)?,
            surfaces: make(render::SURFACES, Cull::None, false)?,
            glass_far: make(render::GLASS, Cull::Front, true)?,
            glass_near: make(render::GLASS, Cull::Back, true)?,
            steam: steam(gpu, library, format, view_mask)?,
            mask: mask(gpu, library, format, view_mask)?,
            edges: edges(gpu, library, format, view_mask, 0.0)?,
            copy: edges(gpu, library, format, view_mask, 1.0)?,
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

/// Over the picture, with its depth to read and not to test.
fn steam(
    gpu: &Gpu,
    library: &Library,
    format: vk::Format,
    view_mask: u32,
) -> Result<RasterPipeline, RenderError> {
    let desc = RasterDesc {
        vertex: &library.compile(&render::STEAM, "vertex", &[])?,
        fragment: Some(&library.compile(&render::STEAM, "fragment", &[])?),
        colours: &[ColourFormat {
            format,
            blend: Blend::Premultiplied,
        }],
        depth: None,
        topology: Topology::Triangles,
        cull: Cull::None,
        view_mask,
    };
    Ok(RasterPipeline::new(gpu, &desc)?)
}

/// Nearest depth, before all else.
fn mask(
    gpu: &Gpu,
    library: &Library,
    format: vk::Format,
    view_mask: u32,
) -> Result<RasterPipeline, RenderError> {
    let desc = RasterDesc {
        vertex: &library.compile(&render::MASK, "vertex", &[])?,
        fragment: Some(&library.compile(&render::MASK, "fragment", &[])?),
        colours: &[ColourFormat {
            format,
            blend: Blend::Replace,
        }],
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

fn edges(
    gpu: &Gpu,
    library: &Library,
    format: vk::Format,
    view_mask: u32,
    copy: f64,
) -> Result<RasterPipeline, RenderError> {
    let desc = RasterDesc {
        vertex: &library.compile(&render::EDGES, "vertex", &[])?,
        fragment: Some(&library.compile(&render::EDGES, "fragment", &[("COPY", copy)])?),
        colours: &[ColourFormat {
            format,
            blend: Blend::Replace,
        }],
        depth: None,
        topology: Topology::Triangles,
        cull: Cull::None,
        view_mask,
    };
    Ok(RasterPipeline::new(gpu, &desc)?)
}
