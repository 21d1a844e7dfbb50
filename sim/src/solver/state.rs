//! The solver's state on the host: its values at the start, and the properties of a particle that follow from it.

use super::bubbles::{self, BubbleState, VapourAccount};
use super::counters::Counters;
use super::grid::Grid;
use super::matter::Start;
use super::sleep::SleepState;
use super::spec::{Particle, SolverSpec};
use super::spray::{SprayAccount, SprayState, spray_left};
use super::steam::{SteamPasses, SteamState};
use super::wall_heat;
use crate::chemistry::Chemistry;
use crate::chemistry::dew::QUANTUM;
use crate::chemistry::table::SolutionTable;
use crate::parameters::Parameters;
use serde::{Deserialize, Serialize};
use vitriol_shaders::layout::{Bubble, Dew, Drops};

/// Everything that the next frame depends on. The neighbour list is part of
/// it: rebuilt at another step, it would hold the same pairs in another order,
/// and sums over them would differ in their last bits.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub struct SolverState {
    /// Positions in the stage (m) by slot; w is −1 for one taken out, else the
    /// vapour that it holds over V0·ρ0.
    pub positions: Vec<[f32; 4]>,
    /// Velocities (m/s) by slot; w is the carried multiplier −p/ρ (m²/s²).
    pub velocities: Vec<[f32; 4]>,
    /// (membership, identity) by slot: 0 in no flask, k + 1 in flask k,
    /// `u32::MAX` for one taken out; and the particle's index at the start.
    pub tags: Vec<[u32; 2]>,
    /// Predicted positions when the list was built.
    pub(super) list_origin: Vec<[f32; 4]>,
    pub(super) list_counts: Vec<u32>,
    /// The lists of all particles in their places, followed by the lists that are longer than a place, if they have room.
    pub(super) list: Vec<u32>,
    pub(super) counters: Vec<u32>,
    /// (temperature in °C, acid mass fraction, …) by slot; empty where no heat
    /// is modelled.
    pub heat: Vec<[f32; 4]>,
    /// Contents of a particle of the physical chemistry: (acid fraction, enthalpy in
    /// J/kg, vapour fraction, mass over that of a particle at rest density), by slot.
    pub matter: Vec<[f32; 4]>,
    /// Exchange of a particle of the physical chemistry with its surroundings, by identity: (heat gained, J; steam that left, kg,
    /// and its enthalpy, J; unused), each per kg of a particle at rest density.
    pub ledger: Vec<[f32; 4]>,
    /// (volume over V0, ρ0 over density, vapour over V0·ρ0, rounding remainders of c and h) by slot.
    pub(super) bulk: Vec<[f32; 4]>,
    /// (K in m²/s of the eddies, variance of the acid fraction within the liquid) of each particle, by slot.
    pub eddies: Vec<[f32; 2]>,
    /// T (°C) of each flask's rings of glass, and its rounding remainder; flask by flask, from the base up.
    pub glass: Vec<[f32; 2]>,
    pub(super) steam: SteamState,
    pub(super) bubbles: BubbleState,
    pub(super) spray: SprayState,
    /// Acceleration with which walls hold the surface's line (m/s²), and as w whose wall it is, by identity, until surface tension acts
    /// again; empty without hysteresis.
    pub(super) held: Vec<[f32; 4]>,
    pub(super) sleep: SleepState,
}

/// Membership of a particle that was taken out.
const REMOVED: u32 = u32::MAX;

impl SolverState {
    /// The state before the first frame: a list that is stale for all.
    pub(super) fn start(spec: &SolverSpec<'_>, grid: &Grid) -> Self {
        let (particles, parameters, flasks) = (spec.particles, &spec.parameters, spec.flasks.len());
        let chemistry = parameters.chemistry.as_ref();
        let ambient = wall_heat::losses(chemistry).map_or(0.0, |losses| losses.ambient);
        let n = particles.len();
        let words = |v: glam::DVec3, w: f32| [v.x as f32, v.y as f32, v.z as f32, w];
        let membership = |p: &Particle| p.flask.map_or(0, |flask| flask as u32 + 1);
        let mut state = Self {
            positions: particles.iter().map(|p| words(p.position, 0.0)).collect(),
            velocities: particles
                .iter()
                .map(|p| words(p.velocity, p.carried as f32))
                .collect(),
            tags: (0..)
                .zip(particles)
                .map(|(i, p)| [membership(p), i])
                .collect(),
            heat: Vec::new(),
            matter: Vec::new(),
            ledger: Vec::new(),
            bulk: Vec::new(),
            eddies: Vec::new(),
            glass: vec![[ambient as f32, 0.0]; wall_heat::ring_count(chemistry, flasks)],
            steam: SteamPasses::start(parameters, n, flasks),
            bubbles: BubbleState::start(parameters, n, grid.cells(), flasks),
            spray: SprayState::start(parameters, n, flasks),
            held: vec![[0.0; 4]; if parameters.sticks() { n } else { 0 }],
            list_origin: vec![[f32::NAN; 4]; n],
            list_counts: vec![0; n],
            list: vec![0; grid.places(n as u32) as usize],
            counters: vec![0; size_of::<Counters>() / 4],
            sleep: SleepState::start(spec),
        };
        match &parameters.chemistry {
            None => {}
            Some(Chemistry::Paper(_)) => {
                state.heat = particles
                    .iter()
                    .map(|p| [p.temperature as f32, p.acid as f32, 0.0, 0.0])
                    .collect();
            }
            Some(Chemistry::Physical(_)) => {
                let table = SolutionTable::new();
                for particle in particles {
                    let start = Start::of(&table, particle, parameters.rest_density);
                    state.heat.push(start.heat);
                    state.matter.push(start.matter);
                    state.bulk.push(start.bulk);
                }
                state.ledger = vec![[0.0; 4]; n];
                state.eddies = vec![[0.0; 2]; n];
            }
        }
        state
    }

    /// Bubbles in the liquid; a record without steam and air is an empty place. Masses are over V0·ρ0; empty where a scene has no bubbles.
    pub fn bubbles(&self) -> &[Bubble] {
        self.bubbles.records()
    }

    /// Records of [`Self::bubbles`], mutable.
    pub fn bubbles_mut(&mut self) -> &mut [Bubble] {
        bytemuck::cast_slice_mut(&mut self.bubbles.bubbles)
    }

    /// Puts a bubble of steam of `temperature` (°C) into place `slot` of [`Self::bubbles`], with membership `tag`, at
    /// `position` with `radius` (m).
    pub fn put_bubble(
        &mut self,
        parameters: &Parameters,
        slot: usize,
        tag: u32,
        [position, velocity]: [glam::DVec3; 2],
        [radius, temperature]: [f64; 2],
    ) {
        let at = bubbles::record(parameters, tag, [position, velocity], [radius, temperature]);
        if let Some(place) = self.bubbles_mut().get_mut(slot) {
            *place = at;
        }
    }

    /// Drops that bubbles threw up; a record of mass 0 has none. Records 2n and 2n + 1 are the jet and the film of the bubble in place n of
    /// [`Self::bubbles`]. Masses are over V0·ρ0; empty where a scene has no spray.
    pub fn drops(&self) -> &[Drops] {
        self.spray.records()
    }

    /// Records of [`Self::drops`], mutable.
    pub fn drops_mut(&mut self) -> &mut [Drops] {
        bytemuck::cast_slice_mut(&mut self.spray.drops)
    }

    /// Mass of drops that came from the liquid in a flask and came to rest elsewhere, over that of a particle at rest density.
    pub fn spray_left(&self, flask: usize) -> f64 {
        spray_left(self.spray.left.get(flask))
    }

    /// Mass, acid and enthalpy of the drops' liquid by where it is.
    pub(crate) fn sprayed(&self) -> SprayAccount {
        self.spray.account()
    }

    /// Mass and enthalpy of the bubbles' vapour by where it is.
    pub(crate) fn vapour(&self) -> VapourAccount {
        self.bubbles.account()
    }

    /// Water on the flasks' inner walls: by flask, from the inner floor up, and around from +X towards +Z; empty where none
    /// condenses.
    pub fn dew(&self) -> &[Dew] {
        bytemuck::cast_slice(&self.steam.dew)
    }

    /// Places of [`Self::dew`], mutable.
    pub fn dew_mut(&mut self) -> &mut [Dew] {
        bytemuck::cast_slice_mut(&mut self.steam.dew)
    }

    /// Mass of that water, kg.
    pub fn dew_mass(&self) -> f64 {
        let quanta: u64 = self.dew().iter().map(|place| u64::from(place.water)).sum();
        QUANTUM * quanta as f64
    }

    /// Mass of the water that liquid washed off its vessels' walls, kg: too little to be added to the liquid.
    pub fn washed_mass(&self) -> f64 {
        let quanta = match self.steam.made[..] {
            [.., low, high] => u64::from(low) | (u64::from(high) << 32),
            _ => 0,
        };
        QUANTUM * quanta as f64
    }

    /// Mass of the mist over the liquid, kg; 0 where no steam is modelled.
    pub fn mist(&self) -> f64 {
        let puffs = self.steam.puffs.iter();
        puffs.map(|puff| f64::from(puff[10])).sum()
    }

    /// Whether the particle in a slot is still there.
    pub fn is_present(&self, slot: usize) -> bool {
        self.tags[slot][0] != REMOVED
    }

    /// Sets the flow of the gas that bubbles of a flask let go, m³/s, where the scene has bubbles and that flask.
    pub fn set_vented_flow(&mut self, flask: usize, flow: f64) {
        if let Some([_, bits]) = self.bubbles.venting.get_mut(flask) {
            *bits = (flow as f32).to_bits();
        }
    }

    /// Mass of the particle in a slot over that of one at rest density.
    pub fn mass_of(&self, slot: usize) -> f64 {
        self.matter.get(slot).map_or(1.0, |held| held[3].into())
    }

    /// Volume of the particle in a slot, its vapour included, over that of one
    /// at rest density.
    pub fn volume_of(&self, slot: usize) -> f64 {
        self.bulk.get(slot).map_or(1.0, |bulk| bulk[0].into())
    }

    /// Index of the flask that the particle in a slot is in.
    pub fn flask_of(&self, slot: usize) -> Option<usize> {
        match self.tags[slot][0] {
            0 | REMOVED => None,
            membership => Some(membership as usize - 1),
        }
    }
}
