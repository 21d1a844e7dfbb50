//! The cells in which the picture's rays look for the liquid's bubbles, and the flights of the drops that the bubbles threw up.

use vitriol_gpu::{Buffer, ComputePipeline, Gpu, GpuError, Recorder, bytes_of_elements};
use vitriol_shaders::{Library, fluid, layout};

use super::SLOTS;
use crate::RenderError;
use crate::compute::compute;
use crate::frame::bubble_cell;
use crate::resting::MOST_RESTING;
use crate::source::BubbleSource;

/// Size of the hash table of cells, as in `common/picture/bubble_cells.wgsl`; behind it is the number of entries.
const CELLS: usize = 32_768;
/// Radius from which on a bubble is not drawn, since a solver that has failed made it, metres as drawn.
const LARGEST: f32 = 0.05;
/// Entries for each bubble, on the average: one of 2 mm reaches into two or three cells, one of 6 mm into eight at most. And entries for
/// few bubbles that may be large.
const ENTRIES: u32 = 8;
const LEAST_ENTRIES: u32 = 1 << 16;

/// Words before the numbers of flights in `flying`, as in `common/picture/spray_drops.wgsl`.
const FLYING: usize = 4;

/// The cells of the frames that are in flight.
pub(super) struct BubbleCells {
    pass: ComputePipeline,
    flights_pass: ComputePipeline,
    /// Most entries of a frame.
    entries: u32,
    views: u32,
    cells: [Cells; SLOTS],
}

/// The cells and flights of one frame.
pub(crate) struct Cells {
    /// For each place of the table its first entry plus one, then the number of entries.
    pub(crate) heads: Buffer,
    pub(crate) entries: Buffer,
    /// Two flights of drops for each place of a bubble, then those that lie where they came to rest.
    pub(crate) flights: Buffer,
    /// Indices of the flights that have drops, after the size of the dispatch over them (`common/picture/spray_drops.wgsl`).
    pub(crate) flying: Buffer,
}

impl BubbleCells {
    /// Cells for at most `most` bubbles, seen in `views` views.
    pub(super) fn new(
        gpu: &Gpu,
        library: &Library,
        most: u32,
        views: u32,
    ) -> Result<Self, RenderError> {
        let entries = match most {
            0 => 0,
            _ => (ENTRIES * most).max(LEAST_ENTRIES),
        };
        let cells = || -> Result<Cells, RenderError> {
            let heads = bytes_of_elements::<u32>(CELLS + 1);
            let places = 2 * most.max(1) as usize + MOST_RESTING;
            let flights = bytes_of_elements::<layout::Flight>(places);
            let flying = bytes_of_elements::<u32>(FLYING + places);
            let held = bytes_of_elements::<layout::BubbleEntry>(entries.max(1) as usize);
            let cells = Cells {
                heads: Buffer::storage(gpu, "bubble cells", heads)?,
                entries: Buffer::storage(gpu, "bubbles in cells", held)?,
                flights: Buffer::storage(gpu, "flights of drops", flights)?,
                flying: Buffer::storage(gpu, "flights with drops", flying)?,
            };
            // Frames without bubbles do not write them.
            gpu.write_ahead(&cells.heads, &vec![0_u32; CELLS + 1])?;
            Ok(cells)
        };
        Ok(Self {
            pass: compute(gpu, library, fluid::BUBBLES, &[])?,
            flights_pass: compute(gpu, library, fluid::FLIGHTS, &[])?,
            entries,
            views,
            cells: [cells()?, cells()?],
        })
    }

    /// Records the passes that sort bubbles into cells and list the flights; a unit of the scene is drawn as `length_scale` metres.
    pub(super) fn record(
        &self,
        rec: &mut Recorder,
        source: Option<BubbleSource<'_>>,
        length_scale: f32,
        slot: usize,
    ) -> Result<(), GpuError> {
        if self.entries == 0 {
            return Ok(());
        }
        let cells = self.of(slot);
        rec.group("bubbles", |rec| {
            rec.fill(&cells.heads, 0)?;
            let Some(source) = source else { return Ok(()) };
            rec.pass(&self.pass)
                .label("bubbles")
                .read("bubbles", source.bubbles)
                .write("bubble_heads", &cells.heads)
                .write("bubble_entries", &cells.entries)
                .constants(&layout::BubbleRun {
                    count: source.count,
                    entries: self.entries,
                    cell: bubble_cell(length_scale),
                    largest: LARGEST / length_scale,
                })
                .invocations(source.count)?;
            let Some(spray) = source.spray else {
                return Ok(());
            };
            let count = 2 * source.count;
            rec.fill(&cells.flying, 0)?;
            rec.pass(&self.flights_pass)
                .label("bubbles")
                .read("drops", spray.drops)
                .write("flights", &cells.flights)
                .write("flying", &cells.flying)
                .constants(&layout::FlightRun {
                    count,
                    mass: spray.mass,
                    views: self.views,
                })
                .invocations(count + MOST_RESTING as u32)
        })
    }

    pub(super) fn of(&self, slot: usize) -> &Cells {
        &self.cells[slot % SLOTS]
    }
}
