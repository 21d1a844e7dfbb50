//! Steam in the room's air, as passes after a frame's substeps.

use super::error::SolverError;
use super::pipelines::{Constants, SolverPass};
use super::spec::SolverSpec;
use super::vapour::{COUNTS, PUFFS, VENTS, dew_places, with_steam};
use crate::chemistry::dew;
use crate::chemistry::puff::Room;
use crate::chemistry::wall_heat::RINGS;
use crate::parameters::Parameters;
use serde::{Deserialize, Serialize};
use vitriol_gpu::{Buffer, Gpu, GpuError, Recorder};
use vitriol_shaders::layout::Step;
use vitriol_shaders::{Library, sim};

/// Assumptions of `sim/dew.wgsl`: room for all puffs in a workgroup's memory, and two rings of the glass a row.
const _: () = assert!(PUFFS <= 1024 && RINGS == 2 * dew::UP);

/// Threads of a workgroup of `sim/dew.wgsl`.
const DEW_THREADS: usize = 256;

/// Least steam of a puff, kg: 0.5 mg is a sphere of 12 mm across.
const LEAST_PUFF: f64 = 5e-7;

/// Steps of a frame. A puff of centimetres starts with some 10 m/s² and is
/// some 0.3 m/s fast: in 3 ms it goes a millimetre.
const STEPS: u32 = 4;

/// Temperature of a room whose scene names none, °C.
pub(super) const ROOM_TEMPERATURE: f64 = 20.0;

/// Passes that move puffs, make new ones, and condense their water on glass.
pub(super) struct SteamPasses {
    rise: SolverPass,
    vent: SolverPass,
    /// With its workgroups; `None` where none condenses.
    dew: Option<(SolverPass, u32)>,
}

/// The steam's part of the state; empty where no steam leaves the liquid.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub(super) struct SteamState {
    pub(super) puffs: Vec<[f32; 12]>,
    pub(super) vented: Vec<[f32; 2]>,
    /// [`COUNTS`].
    pub(super) made: Vec<u32>,
    /// Water on the flasks' walls, by place: the words of `Dew`.
    pub(super) dew: Vec<[u32; 4]>,
}

impl SteamPasses {
    /// `None` where no steam leaves the liquid.
    pub(super) fn new(
        gpu: &Gpu,
        library: &Library,
        spec: &SolverSpec<'_>,
        constants: &Constants,
        buffers: &[&Buffer],
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
        let make = |shader| constants.pass(gpu, library, buffers, shader, &[]);
        let places = dew_places(parameters, spec.flasks.len());
        let losses = physical.losses.filter(|_| places > 0);
        let dew = losses.map(|losses| {
            let room = Room::at(losses.ambient);
            let constants = constants.and(&[
                ("ROOM_VAPOUR", dew::vapour_of(&room)),
                ("STILL", dew::still()),
                ("SWEPT", dew::swept()),
                ("DEW_LOSS", losses.glass),
                ("LATENT", dew::latent_heat(losses.ambient)),
            ]);
            let pass = constants.pass(gpu, library, buffers, sim::DEW, &[])?;
            Ok::<_, SolverError>((pass, (places / DEW_THREADS) as u32))
        });
        Ok(Some(Self {
            rise: make(sim::RISE)?,
            vent: make(sim::VENT)?,
            dew: dew.transpose()?,
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

    /// Whether any of it condenses on glass.
    pub(super) fn condenses(&self) -> bool {
        self.dew.is_some()
    }

    /// Records the condensation of the puffs on glass, their rise, and new puffs from the steam that left the liquid; `step` is that of
    /// the frame's last substep.
    pub(super) fn record(
        &self,
        rec: &mut Recorder,
        buffers: &[&Buffer],
        step: &Step,
    ) -> Result<(), GpuError> {
        if let Some((pass, workgroups)) = &self.dew {
            let pass = pass.begin(rec, buffers).constants(step);
            pass.workgroups([*workgroups, 1, 1])?;
        }
        self.rise.begin(rec, buffers).invocations(PUFFS)?;
        self.vent.begin(rec, buffers).workgroups([VENTS, 1, 1])
    }
}
