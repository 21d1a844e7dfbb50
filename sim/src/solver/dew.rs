//! Water on the flasks' inner walls, as a pass after a frame's substeps.

use super::SolverSpec;
use super::buffers::Buffers;
use super::error::SolverError;
use super::glass;
use super::pipelines::{Constants, SolverPass};
use super::transfer::upload;
use super::vapour::{PUFFS, VENTS, dew_places};
use super::vessels::Vessels;
use crate::chemistry::dew;
use crate::chemistry::glass::RINGS;
use crate::chemistry::puff::Room;
use vitriol_gpu::{Buffer, Gpu, GpuError, Recorder, bytes_of_elements};
use vitriol_shaders::layout::{Dew as Place, DewRow, Step};
use vitriol_shaders::{Library, sim};

/// What `sim/dew.wgsl` takes for granted: room for all puffs in a workgroup's memory, and two rings of the glass a row.
const _: () = assert!(PUFFS <= 1024 && RINGS == 2 * dew::UP);

/// Threads of a workgroup.
const THREADS: usize = 256;

/// The walls' water, and what condenses it.
pub(super) struct Dew {
    dew: Buffer,
    rows: Buffer,
    pass: SolverPass,
    places: usize,
}

impl Dew {
    /// `None` where none condenses; `steam` are its puffs, what walls take of them, and the counts.
    pub(super) fn new(
        gpu: &Gpu,
        library: &Library,
        spec: &SolverSpec<'_>,
        constants: &Constants,
        (buffers, vessels): (&Buffers, &Vessels),
        steam: [&Buffer; 3],
    ) -> Result<Option<Self>, SolverError> {
        let places = dew_places(&spec.parameters, spec.flasks.len());
        let losses = glass::losses(spec.parameters.chemistry.as_ref());
        let (Some(losses), 1..) = (losses, places) else {
            return Ok(None);
        };
        let room = Room::at(losses.ambient);
        let constants = constants.and(&[
            ("PUFFS", f64::from(PUFFS)),
            ("VENTS", f64::from(VENTS)),
            ("ROOM_VAPOUR", dew::vapour_of(&room)),
            ("ROOM_DENSITY", room.density),
            ("STILL", dew::still()),
            ("SWEPT", dew::swept()),
            ("DEW_LOSS", losses.glass),
            ("LATENT", dew::latent_heat(losses.ambient)),
        ]);
        let rows: Vec<DewRow> = spec.flasks.iter().flat_map(dew::rows).map(row).collect();
        let own = [
            Buffer::storage(gpu, "dew", bytes_of_elements::<Place>(places))?,
            upload(gpu, "dew_rows", &rows)?,
        ];
        let mut bound = buffers.all(vessels).to_vec();
        bound.extend(own.iter().chain(steam));
        let pass = constants.pass(gpu, library, &bound, sim::DEW, &[])?;
        let [dew, rows] = own;
        Ok(Some(Self {
            places,
            dew,
            rows,
            pass,
        }))
    }

    /// The walls' water, `array<Dew>`, and how many places it has.
    pub(super) fn places(&self) -> (&Buffer, usize) {
        (&self.dew, self.places)
    }

    /// Records what condenses and evaporates in a frame; `step` is that of its last substep.
    pub(super) fn record(
        &self,
        rec: &mut Recorder,
        (buffers, vessels): (&Buffers, &Vessels),
        steam: [&Buffer; 3],
        step: &Step,
    ) -> Result<(), GpuError> {
        let mut bound = buffers.all(vessels).to_vec();
        bound.extend([&self.dew, &self.rows].into_iter().chain(steam));
        let pass = self.pass.begin(rec, &bound).constants(step);
        pass.workgroups([(self.places / THREADS) as u32, 1, 1])
    }
}

fn row(row: dew::Row) -> DewRow {
    DewRow {
        height: row.height as f32,
        radius: row.radius as f32,
        area: row.area as f32,
        capacity: row.capacity as f32,
    }
}
