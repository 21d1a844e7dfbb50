//! Steam in the room's air, as passes after a frame's substeps.

use super::buffers::Buffers;
use super::error::SolverError;
use super::pipelines::{Constants, SolverPass};
use super::transfer::write;
use crate::chemistry::puff::Room;
use crate::chemistry::{Chemistry, Physical};
use crate::parameters::Parameters;
use serde::{Deserialize, Serialize};
use vitriol_gpu::{Buffer, Gpu, GpuError, Recorder, bytes_of_elements};
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
    /// `puffs`, `vented` and `made`.
    own: [Buffer; 3],
    rise: SolverPass,
    vent: SolverPass,
}

/// What the next frame depends on; empty where no steam leaves.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub(super) struct SteamState {
    pub(super) puffs: Vec<[f32; 12]>,
    pub(super) vented: Vec<[f32; 2]>,
    pub(super) made: Vec<u32>,
}

impl SteamState {
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
        buffers: &Buffers,
    ) -> Result<Option<Self>, SolverError> {
        let Some(physical) = physical(parameters) else {
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
        let buffer = |label, bytes| Buffer::storage(gpu, label, bytes);
        let own = [
            buffer("puffs", bytes_of_elements::<Puff>(PUFFS as usize))?,
            buffer("vented", bytes_of_elements::<[f32; 2]>(count as usize))?,
            buffer("made", bytes_of_elements::<u32>(VENTS as usize))?,
        ];
        let bound = bound(&own, buffers);
        let make = |shader| constants.pass(gpu, library, &bound, shader, &[]);
        Ok(Some(Self {
            rise: make(sim::RISE)?,
            vent: make(sim::VENT)?,
            own,
        }))
    }

    /// The state in which nothing has left yet, of `parameters`' scene.
    pub(super) fn start(parameters: &Parameters, count: usize) -> SteamState {
        if physical(parameters).is_none() {
            return SteamState::default();
        }
        SteamState {
            puffs: vec![[0.0; 12]; PUFFS as usize],
            vented: vec![[0.0; 2]; count],
            made: vec![0; VENTS as usize],
        }
    }

    pub(super) fn puffs(&self) -> &Buffer {
        &self.own[0]
    }

    /// What a state has of it, with `count` particles: buffers and their elements.
    pub(super) fn state(&self, count: usize) -> [(&Buffer, usize); 3] {
        let [puffs, vented, made] = &self.own;
        [
            (puffs, PUFFS as usize),
            (vented, count),
            (made, VENTS as usize),
        ]
    }

    pub(super) fn restore(&self, gpu: &Gpu, state: &SteamState) -> Result<(), GpuError> {
        let [puffs, vented, made] = &self.own;
        write(gpu, puffs, &state.puffs)?;
        write(gpu, vented, &state.vented)?;
        write(gpu, made, &state.made)
    }

    /// Records the rise of the puffs, and new ones of what left the liquid.
    pub(super) fn record(&self, rec: &mut Recorder, b: &Buffers) -> Result<(), GpuError> {
        let all = bound(&self.own, b);
        self.rise.begin(rec, &all).invocations(PUFFS)?;
        self.vent.begin(rec, &all).workgroups([VENTS, 1, 1])
    }
}

/// What the two passes bind.
fn bound<'a>([puffs, vented, made]: &'a [Buffer; 3], b: &'a Buffers) -> [&'a Buffer; 7] {
    [
        puffs,
        vented,
        made,
        &b.position,
        &b.tags,
        &b.ledger,
        &b.bubbles,
    ]
}

/// The chemistry, where steam leaves the liquid.
fn physical(parameters: &Parameters) -> Option<&Physical> {
    match &parameters.chemistry {
        Some(Chemistry::Physical(p)) if p.bubbles.is_some() => Some(p),
        _ => None,
    }
}
