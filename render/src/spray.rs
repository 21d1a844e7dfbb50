//! Drops that bubbles threw up, finer than particles.

use vitriol_gpu::{Buffer, ComputePipeline, Gpu, GpuError, Recorder};
use vitriol_shaders::{Library, layout, spray};

use crate::RenderError;
use crate::compute::compute;
use crate::resting::{Resting, RestingDrop};
use crate::solids::Solids;
use crate::tiles::{Class, Tiles};

/// The nearest drop at each pixel and its light.
pub(crate) struct Spray {
    nearest_pass: ComputePipeline,
    light_pass: ComputePipeline,
    resting: Resting,
}

/// Flights of drops as they are drawn.
#[derive(Clone, Copy)]
pub(crate) struct Flights<'a> {
    /// `array<Flight>`.
    pub(crate) buffer: &'a Buffer,
    /// Indices of the flights that have drops, after the size of the dispatch over them.
    pub(crate) flying: &'a Buffer,
    /// Flights of the bubbles' places; behind them are those of drops that rest.
    pub(crate) places: usize,
}

impl Spray {
    pub(crate) fn new(gpu: &Gpu, library: &Library) -> Result<Self, RenderError> {
        // One kind of spheres is drawn at a time: particles that are coloured, or spray.
        let class = ("CLASS", f64::from(Class::Spheres as u32));
        Ok(Self {
            nearest_pass: compute(gpu, library, spray::NEAREST, &[])?,
            light_pass: compute(gpu, library, spray::LIGHT, &[class])?,
            resting: Resting::new(gpu)?,
        })
    }

    /// Records the passes that find the nearest drop of each pixel and mark the tiles with drops, after the other marks and before the
    /// lists. `resting` are the drops that rest, and the metres that a unit of the scene is drawn as.
    pub(crate) fn record_nearest(
        &self,
        rec: &mut Recorder,
        uniforms: &Buffer,
        (flights, resting): (Flights<'_>, (&[RestingDrop], f32)),
        solids: &Solids,
        tiles: &Tiles,
    ) -> Result<(), GpuError> {
        rec.group("spray", |rec| {
            self.resting.record(rec, flights, resting)?;
            rec.fill(&solids.depths, 0)?;
            rec.fill(&solids.nearest, 0)?;
            for numbers in [0, 1] {
                rec.pass(&self.nearest_pass)
                    .label("spray")
                    .uniform("frame", uniforms)
                    .read("flights", flights.buffer)
                    .read("flying", flights.flying)
                    .write("depths", &solids.depths)
                    .write("nearest", &solids.nearest)
                    .write("tiles", tiles.marks())
                    .constants(&layout::SprayRun { numbers })
                    .indirect(flights.flying, 0)?;
            }
            Ok(())
        })
    }

    /// Records their light, after the lists of tiles.
    pub(crate) fn record_light(
        &self,
        rec: &mut Recorder,
        uniforms: &Buffer,
        flights: Flights<'_>,
        solids: &Solids,
        tiles: &Tiles,
    ) -> Result<(), GpuError> {
        let pass = rec
            .pass(&self.light_pass)
            .label("spray")
            .uniform("frame", uniforms)
            .read("flights", flights.buffer)
            .write("nearest", &solids.nearest);
        tiles.over(Class::Spheres, pass)
    }
}
