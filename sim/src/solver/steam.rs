//! Steam in the room's air, as passes after a frame's substeps.

use super::buffers::Buffers;
use super::error::SolverError;
use super::pipelines::Constants;
use super::transfer::{read, write};
use crate::chemistry::puff::Room;
use crate::chemistry::{Chemistry, Physical};
use crate::parameters::Parameters;
use serde::{Deserialize, Serialize};
use vitriol_gpu::{Buffer, ComputePipeline, Gpu, GpuError, Recorder, bytes_of_elements};
use vitriol_shaders::layout::Puff;
use vitriol_shaders::{Library, sim};

/// Puffs of steam at most; a new one replaces its vent's oldest.
pub const PUFFS: u32 = 1024;

/// Puffs that a frame may bring.
const VENTS: u32 = 4;

/// Least steam of a puff, kg: 0.5 mg is a sphere of 12 mm across.
const LEAST_PUFF: f64 = 5e-7;

/// Steps of a frame. A puff of centimetres starts with some 10 m/s² and is
/// some 0.3 m/s fast: in 3 ms it goes a millimetre.
const STEPS: u32 = 4;

/// Temperature of a room whose scene names none, °C.
const ROOM_TEMPERATURE: f64 = 20.0;

/// Puffs and what makes them.
pub(super) struct Steam {
    pub(super) puffs: Buffer,
    vented: Buffer,
    made: Buffer,
    rise: ComputePipeline,
    vent: ComputePipeline,
}

/// What the next frame depends on; empty where no steam leaves.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub(super) struct SteamState {
    puffs: Vec<[f32; 12]>,
    vented: Vec<[f32; 2]>,
    made: Vec<u32>,
}

impl SteamState {
    /// How many elements its arrays have.
    pub(super) fn elements(&self) -> [usize; 3] {
        [self.puffs.len(), self.vented.len(), self.made.len()]
    }

    /// Mass of the mist, kg.
    pub(super) fn mist(&self) -> f64 {
        self.puffs.iter().map(|puff| f64::from(puff[10])).sum()
    }
}

impl Steam {
    /// `None` where no steam leaves the liquid.
    pub(super) fn new(
        gpu: &Gpu,
        library: &Library,
        parameters: &Parameters,
        count: u32,
        constants: &Constants,
    ) -> Result<Option<Self>, SolverError> {
        let Some(physical) = physical(parameters).filter(|p| p.bubble_speed.is_some()) else {
            return Ok(None);
        };
        let ambient = physical.losses.map_or(ROOM_TEMPERATURE, |l| l.ambient);
        let room = Room::at(ambient);
        let constants = constants.and(&[
            ("PUFFS", f64::from(PUFFS)),
            ("VENTS", f64::from(VENTS)),
            ("LEAST_PUFF", LEAST_PUFF),
            ("STEPS", f64::from(STEPS)),
            ("STEP_TIME", parameters.frame_time / f64::from(STEPS)),
            ("GRAVITY", -parameters.gravity[1]),
            ("ROOM_HUMIDITY", room.humidity),
            ("ROOM_ENTHALPY", room.enthalpy),
            ("ROOM_DENSITY", room.density),
        ]);
        let make = |shader| {
            let own = constants.of(library, shader, &[])?;
            let compiled = library.compile(&shader, "main", &own)?;
            Ok::<_, SolverError>(ComputePipeline::new(gpu, &compiled)?)
        };
        let n = count as usize;
        let buffer = |label, bytes| Buffer::storage(gpu, label, bytes);
        Ok(Some(Self {
            puffs: buffer("puffs", bytes_of_elements::<Puff>(PUFFS as usize))?,
            vented: buffer("vented", bytes_of_elements::<[f32; 2]>(n))?,
            made: buffer("made", bytes_of_elements::<u32>(VENTS as usize))?,
            rise: make(sim::RISE)?,
            vent: make(sim::VENT)?,
        }))
    }

    /// The state in which nothing has left yet, of `parameters`' scene.
    pub(super) fn start(parameters: &Parameters, count: usize) -> SteamState {
        if physical(parameters).is_none_or(|p| p.bubble_speed.is_none()) {
            return SteamState::default();
        }
        SteamState {
            puffs: vec![[0.0; 12]; PUFFS as usize],
            vented: vec![[0.0; 2]; count],
            made: vec![0; VENTS as usize],
        }
    }

    pub(super) fn snapshot(&self, gpu: &Gpu, count: usize) -> Result<SteamState, SolverError> {
        Ok(SteamState {
            puffs: read(gpu, &self.puffs, PUFFS as usize)?,
            vented: read(gpu, &self.vented, count)?,
            made: read(gpu, &self.made, VENTS as usize)?,
        })
    }

    pub(super) fn restore(&self, gpu: &Gpu, state: &SteamState) -> Result<(), GpuError> {
        write(gpu, &self.puffs, &state.puffs)?;
        write(gpu, &self.vented, &state.vented)?;
        write(gpu, &self.made, &state.made)
    }

    /// Records the rise of the puffs, and new ones of what left the liquid.
    pub(super) fn record(&self, rec: &mut Recorder, b: &Buffers) -> Result<(), GpuError> {
        rec.pass(&self.rise)
            .write("puffs", &self.puffs)
            .invocations(PUFFS)?;
        rec.pass(&self.vent)
            .write("puffs", &self.puffs)
            .read("position", &b.position)
            .read("tags", &b.tags)
            .read("ledger", &b.ledger)
            .write("vented", &self.vented)
            .write("made", &self.made)
            .workgroups([VENTS, 1, 1])
    }
}

fn physical(parameters: &Parameters) -> Option<&Physical> {
    match &parameters.chemistry {
        Some(Chemistry::Physical(physical)) => Some(physical),
        _ => None,
    }
}
