//! Steam in the room's air, as passes after a frame's substeps.

use super::buffers::Buffers;
use super::dew::Dew;
use super::error::SolverError;
use super::pipelines::{Constants, SolverPass};
use super::spec::SolverSpec;
use super::transfer::write;
use super::vapour::{PUFFS, VENTS, dew_places, with_steam};
use super::vessels::Vessels;
use crate::chemistry::puff::Room;
use crate::parameters::Parameters;
use serde::{Deserialize, Serialize};
use vitriol_gpu::{Buffer, Gpu, GpuError, Recorder, bytes_of_elements};
use vitriol_shaders::layout::{self, Puff, Step};
use vitriol_shaders::{Library, sim};

/// Counts that are kept: puffs of each workgroup that makes them, and quanta of water that were washed off glass, as
/// low and high word.
const COUNTS: usize = VENTS as usize + 2;

/// Least steam of a puff, kg: 0.5 mg is a sphere of 12 mm across.
const LEAST_PUFF: f64 = 5e-7;

/// Steps of a frame. A puff of centimetres starts with some 10 m/s² and is
/// some 0.3 m/s fast: in 3 ms it goes a millimetre.
const STEPS: u32 = 4;

/// Temperature of a room whose scene names none, °C.
const ROOM_TEMPERATURE: f64 = 20.0;

/// Puffs and what makes them.
pub(super) struct Steam {
    /// `puffs`, `vented`, `made`, and `taken`: what walls take of each puff.
    own: [Buffer; 4],
    /// Where it condenses on glass.
    dew: Option<Dew>,
    rise: SolverPass,
    vent: SolverPass,
}

/// What the next frame depends on; empty where no steam leaves.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub(super) struct SteamState {
    pub(super) puffs: Vec<[f32; 12]>,
    pub(super) vented: Vec<[f32; 2]>,
    /// [`COUNTS`].
    pub(super) made: Vec<u32>,
    /// What the flasks' walls have of it, by place: the words of `Dew`.
    pub(super) dew: Vec<[u32; 4]>,
}

impl SteamState {
    /// Mass of the mist, kg.
    pub(super) fn mist(&self) -> f64 {
        self.puffs.iter().map(|puff| f64::from(puff[10])).sum()
    }

    /// Quanta of water that liquid washed off glass.
    pub(super) fn washed(&self) -> u64 {
        match self.made[..] {
            [.., low, high] => u64::from(low) | (u64::from(high) << 32),
            _ => 0,
        }
    }

    /// Its water on glass.
    pub(super) fn dew(&self) -> &[layout::Dew] {
        bytemuck::cast_slice(&self.dew)
    }
}

impl Steam {
    /// `None` where no steam leaves the liquid.
    pub(super) fn new(
        gpu: &Gpu,
        library: &Library,
        spec: &SolverSpec<'_>,
        count: u32,
        constants: &Constants,
        of_solver: (&Buffers, &Vessels),
    ) -> Result<Option<Self>, SolverError> {
        let parameters = &spec.parameters;
        let Some(physical) = with_steam(parameters) else {
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
            buffer("made", bytes_of_elements::<u32>(COUNTS))?,
            buffer("taken", bytes_of_elements::<u32>(PUFFS as usize))?,
        ];
        let [puffs, _, made, taken] = &own;
        let of_steam = [puffs, taken, made];
        let dew = Dew::new(gpu, library, spec, &constants, of_solver, of_steam)?;
        let bound = bound(&own, of_solver.0);
        let make = |shader| constants.pass(gpu, library, &bound, shader, &[]);
        Ok(Some(Self {
            rise: make(sim::RISE)?,
            vent: make(sim::VENT)?,
            dew,
            own,
        }))
    }

    /// The state in which nothing has left yet, of `parameters`' scene.
    pub(super) fn start(parameters: &Parameters, count: usize, flasks: usize) -> SteamState {
        if with_steam(parameters).is_none() {
            return SteamState::default();
        }
        SteamState {
            puffs: vec![[0.0; 12]; PUFFS as usize],
            vented: vec![[0.0; 2]; count],
            made: vec![0; COUNTS],
            dew: vec![[0; 4]; dew_places(parameters, flasks)],
        }
    }

    pub(super) fn puffs(&self) -> &Buffer {
        &self.own[0]
    }

    /// Its water on glass, where any condenses there.
    pub(super) fn dew(&self) -> Option<&Buffer> {
        self.dew.as_ref().map(|dew| dew.places().0)
    }

    /// What a state has of it, with `count` particles: buffers and their elements.
    pub(super) fn state(&self, count: usize) -> [(&Buffer, usize); 3] {
        let [puffs, vented, made, _] = &self.own;
        [(puffs, PUFFS as usize), (vented, count), (made, COUNTS)]
    }

    pub(super) fn restore(&self, gpu: &Gpu, state: &SteamState) -> Result<(), GpuError> {
        let [puffs, vented, made, taken] = &self.own;
        write(gpu, taken, &[0_u32; PUFFS as usize])?;
        if let Some(dew) = self.dew() {
            write(gpu, dew, &state.dew)?;
        }
        write(gpu, puffs, &state.puffs)?;
        write(gpu, vented, &state.vented)?;
        write(gpu, made, &state.made)
    }

    /// What of the state is on glass: the buffer and its elements.
    pub(super) fn state_of_dew(&self) -> Option<(&Buffer, usize)> {
        self.dew.as_ref().map(Dew::places)
    }

    /// Records what condenses of the puffs, their rise, and new ones of what left the liquid; `step` is that of the
    /// frame's last substep.
    pub(super) fn record(
        &self,
        rec: &mut Recorder,
        of_solver: (&Buffers, &Vessels),
        step: &Step,
    ) -> Result<(), GpuError> {
        let [puffs, _, made, taken] = &self.own;
        if let Some(dew) = &self.dew {
            dew.record(rec, of_solver, [puffs, taken, made], step)?;
        }
        let all = bound(&self.own, of_solver.0);
        self.rise.begin(rec, &all).invocations(PUFFS)?;
        self.vent.begin(rec, &all).workgroups([VENTS, 1, 1])
    }
}

/// What the two passes bind.
fn bound<'a>([puffs, vented, made, taken]: &'a [Buffer; 4], b: &'a Buffers) -> [&'a Buffer; 8] {
    [
        taken,
        puffs,
        vented,
        made,
        &b.position,
        &b.tags,
        &b.ledger,
        &b.bubbles,
    ]
}
