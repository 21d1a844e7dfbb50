//! Marks the contents of each tile of the picture, and lists the tiles by class for the passes over their pixels.

use vitriol_gpu::{Buffer, ComputePipeline, Gpu, GpuError, Pass, Recorder};
use vitriol_shaders::{Library, layout, render};

use crate::RenderError;
use crate::compute::compute;
use crate::source::SteamSource;

/// Pixels along a tile's edge, as in `common/picture/tile_marks.wgsl`.
pub(crate) const TILE: u32 = 32;

/// Bits of a tile's contents, as in `common/picture/tile_marks.wgsl`.
pub(crate) const LIQUID_MARK: u32 = 1 << 31;
/// An edge that is neither the liquid's nor a vessel's.
pub(crate) const EDGE_MARK: u32 = 1 << 30;
pub(crate) const STEAM_MARK: u32 = 1 << 29;
/// A bit for each vessel.
pub(crate) const VESSEL_MARKS: u32 = 0xff_ffff;

/// Points on the table's edge that are marked, as in `render/tiles.wgsl`.
const TABLE_POINTS: u32 = 128;

/// Words of a tile's bits for puffs, one a puff, as in `common/picture/tile_marks.wgsl`.
const PUFF_WORDS: u32 = 32;
/// Most puffs of steam in a frame.
pub(crate) const MOST_PUFFS: u32 = 32 * PUFF_WORDS;

/// Tiles in a row, and rows, of a view.
pub(crate) fn tiles_of([width, height]: [u32; 2]) -> [u32; 2] {
    [width.div_ceil(TILE), height.div_ceil(TILE)]
}

/// Class of the tiles in a list; the numbers are those of `common/picture/tile_pixels.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub(crate) enum Class {
    /// Liquid, and perhaps glass.
    Liquid = 0,
    /// Glass without liquid; every pixel is shaded.
    Glass = 1,
    /// Neither liquid nor glass; every pixel is shaded, and any part of the room may be seen.
    Plain = 2,
    /// Edges to be smoothed, without steam.
    Edges = 3,
    /// Steam, and perhaps edges.
    Steam = 4,
    /// Coloured spheres, or spray.
    Spheres = 5,
    /// Hands; every pixel is shaded.
    Hands = 6,
    /// Tiles of which blocks are shaded, without steam.
    Spread = 7,
    /// Tiles of which blocks are shaded, with steam.
    SpreadSteam = 8,
    /// Liquid, and perhaps glass; every pixel is shaded.
    SharpLiquid = 9,
    /// Liquid, and perhaps glass; blocks are shaded.
    CoarseLiquid = 10,
    /// Glass without liquid; blocks are shaded.
    CoarseGlass = 11,
    /// Neither liquid nor glass; blocks are shaded.
    CoarsePlain = 12,
    /// Hands; blocks are shaded.
    CoarseHands = 13,
    /// Neither liquid nor glass; of the room only the table's top is seen.
    Bench = 14,
    /// Neither liquid nor glass; the table, its fittings and what hangs at the back wall are not seen.
    Walls = 15,
    /// Neither liquid nor glass; any part of the room, and a panel, a sign or a pane.
    Sheets = 16,
    /// Neither liquid nor glass; what hangs at the back wall is not seen.
    Table = 17,
}

impl Class {
    /// Name of its share of the pass "picture".
    pub(crate) fn picture(self) -> &'static str {
        match self {
            Self::Bench => "picture: bench",
            Self::Walls => "picture: walls",
            Self::Table => "picture: table",
            Self::Plain | Self::CoarsePlain | Self::Sheets => "picture: room",
            Self::Glass | Self::CoarseGlass => "picture: glass",
            _ => "picture: liquid",
        }
    }
}

/// Number of lists, as in `render/tile_lists.wgsl`.
const LISTS: u64 = 18;

/// The marks of all views' tiles, and their lists.
pub(crate) struct Tiles {
    mark_pass: ComputePipeline,
    puffs_pass: ComputePipeline,
    lists_pass: ComputePipeline,
    marks: Buffer,
    lists: Buffer,
    /// Sizes of the dispatches over the lists.
    arguments: Buffer,
    puffs: Buffer,
}

impl Tiles {
    pub(crate) fn new(
        gpu: &Gpu,
        library: &Library,
        extent: [u32; 2],
        views: u32,
    ) -> Result<Self, RenderError> {
        let [columns, rows] = tiles_of(extent);
        let count = columns * rows * views;
        let words = |label: &str, words: u64| Buffer::storage(gpu, label, 4 * words);
        Ok(Self {
            mark_pass: compute(gpu, library, render::TILES, &[])?,
            puffs_pass: compute(gpu, library, render::TILE_PUFFS, &[])?,
            lists_pass: compute(gpu, library, render::TILE_LISTS, &[])?,
            marks: words("tiles", count.into())?,
            lists: words("tile lists", LISTS * u64::from(count))?,
            arguments: words("tile dispatches", 3 * LISTS)?,
            puffs: words("puffs in tiles", u64::from(PUFF_WORDS) * u64::from(count))?,
        })
    }

    /// Records the marking of the tiles of a frame's `views`, with `count` of `ellipsoids`.
    pub(crate) fn mark(
        &self,
        rec: &mut Recorder,
        uniforms: &Buffer,
        (ellipsoids, count): (&Buffer, u32),
        steam: Option<&SteamSource<'_>>,
        views: u32,
    ) -> Result<(), GpuError> {
        rec.group("tiles", |rec| {
            rec.fill(&self.marks, 0)?;
            rec.fill(&self.arguments, 0)?;
            rec.pass(&self.mark_pass)
                .label("tiles")
                .uniform("frame", uniforms)
                .read("ellipsoids", ellipsoids)
                .write("tiles", &self.marks)
                .constants(&layout::TileCount { count })
                .invocations(count.max(TABLE_POINTS))?;
            if let Some(steam) = steam {
                rec.fill(&self.puffs, 0)?;
                rec.pass(&self.puffs_pass)
                    .label("tiles")
                    .uniform("frame", uniforms)
                    .read("puffs", steam.puffs)
                    .write("puffs_in_tiles", &self.puffs)
                    .write("tiles", &self.marks)
                    .constants(&layout::PuffCount { count: steam.count })
                    .workgroups([steam.count.div_ceil(64), views, 1])?;
            }
            Ok(())
        })
    }

    /// Records the pass that lists the marked tiles of so many views of `extent` by class and by how sharp they are to be.
    pub(crate) fn list(
        &self,
        rec: &mut Recorder,
        uniforms: &Buffer,
        hidden: &Buffer,
        (extent, views): ([u32; 2], u32),
        foveae: &layout::Foveae,
    ) -> Result<(), GpuError> {
        let [columns, rows] = tiles_of(extent);
        rec.group("tiles", |rec| {
            rec.pass(&self.lists_pass)
                .label("tiles")
                .uniform("frame", uniforms)
                .read("tiles", &self.marks)
                .read("hidden_area", hidden)
                .write("tile_lists", &self.lists)
                .write("arguments", &self.arguments)
                .constants(foveae)
                .invocations(columns * rows * views)
        })
    }

    /// The marks, row by row, view by view.
    pub(crate) fn marks(&self) -> &Buffer {
        &self.marks
    }

    /// The puffs that each tile has, a bit each.
    pub(crate) fn puffs(&self) -> &Buffer {
        &self.puffs
    }

    /// Records a pass over the pixels of the tiles of a class; the pipeline is specialised for it.
    pub(crate) fn over(&self, class: Class, pass: Pass<'_>) -> Result<(), GpuError> {
        pass.read("tile_lists", &self.lists)
            .indirect(&self.arguments, 12 * class as u64)
    }
}
