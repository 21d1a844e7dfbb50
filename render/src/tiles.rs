//! Which tiles of the picture have what.

use vitriol_gpu::{Buffer, ComputePipeline, Gpu, Recorder};
use vitriol_shaders::{Library, layout, render};

use crate::RenderError;

/// Pixels along a tile's edge, as in `common/tile.wgsl`.
const TILE: u32 = 32;

/// Points on the table's edge that are marked, as in `render/tiles.wgsl`.
const TABLE_POINTS: u32 = 128;

/// Tiles in a row, and rows, of a view.
pub(crate) fn tiles_of([width, height]: [u32; 2]) -> [u32; 2] {
    [width.div_ceil(TILE), height.div_ceil(TILE)]
}

/// The marks of all views' tiles.
pub(crate) struct Tiles {
    mark: ComputePipeline,
    marks: Buffer,
    views: u32,
    count: u32,
}

impl Tiles {
    pub(crate) fn new(
        gpu: &Gpu,
        library: &Library,
        extent: [u32; 2],
        views: u32,
    ) -> Result<Self, RenderError> {
        let [columns, rows] = tiles_of(extent);
        let count = columns * rows;
        Ok(Self {
            mark: pipeline(gpu, library)?,
            // Liquid and edges.
            marks: Buffer::storage(gpu, "tiles", u64::from(2 * 4 * count * views))?,
            views,
            count,
        })
    }

    /// Takes up changed shaders.
    pub(crate) fn reload(&mut self, gpu: &Gpu, library: &Library) -> Result<(), RenderError> {
        self.mark = pipeline(gpu, library)?;
        Ok(())
    }

    /// Records the marking of a frame's tiles, with `count` of `ellipsoids`.
    pub(crate) fn record(
        &self,
        rec: &mut Recorder,
        uniforms: &Buffer,
        ellipsoids: &Buffer,
        count: u32,
    ) -> Result<(), RenderError> {
        rec.fill(&self.marks, 0)?;
        rec.pass(&self.mark)
            .label("tiles")
            .uniform("frame", uniforms)
            .read("ellipsoids", ellipsoids)
            .write("tiles", &self.marks)
            .constants(&layout::TileCount {
                count,
                views: self.views,
            })
            .invocations(count.max(TABLE_POINTS))?;
        Ok(())
    }

    /// The marks: for each view where there is liquid, then where edges are.
    pub(crate) fn marks(&self) -> &Buffer {
        &self.marks
    }

    /// Vertices of the triangles of all tiles of a view.
    pub(crate) fn vertices(&self) -> u32 {
        6 * self.count
    }
}

fn pipeline(gpu: &Gpu, library: &Library) -> Result<ComputePipeline, RenderError> {
    let compiled = library.compile(&render::TILES, "main", &[])?;
    Ok(ComputePipeline::new(gpu, &compiled)?)
}
