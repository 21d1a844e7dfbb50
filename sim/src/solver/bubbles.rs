//! Line 26, of vapour: bubbles, and their part of the state.

use super::buffers::{BUBBLE_WORDS, BUBBLED_WORDS};
use super::spray::add;
use super::{Solver, SolverError, lanes};
use crate::chemistry::bubbles::Bubbles;
use crate::chemistry::table::steam_enthalpy;
use crate::chemistry::{ABSOLUTE_ZERO, GAS_CONSTANT, WATER_MOLAR_MASS};
use crate::parameters::Parameters;
use glam::DVec3;
use serde::{Deserialize, Serialize};
use vitriol_gpu::Recorder;
use vitriol_shaders::layout::{Bubble, Step};

/// As in `common/liquid/step.wgsl`.
const ACTED: u32 = 1;
const ACT: u32 = 2;

/// Bytes of a set of records in `live_args`, and where in it the size of the dispatch over drops is, as in
/// `common/chemistry/live_places.wgsl`.
const SET_ARGS: u64 = 32;
const DROPS_ARGS: u64 = 12;

/// `live_args` where no place of a bubble has anything: of each set of records two dispatches of no workgroups, and padding.
const NO_PLACES: [u32; 16] = [0, 1, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 1, 0, 0];

/// Threads of a workgroup of the passes over bubbles.
pub(super) const GROUP: u32 = 64;

/// Flags of substep `n` of `substeps`: whether bubbles acted right before it ([`ACTED`]), and whether they act after it ([`ACT`]).
pub(super) fn flags(n: u32, substeps: u32) -> u32 {
    let acts = |n: u32| Bubbles::step_after(n, substeps).is_some();
    let acted = n == 0 || acts(n - 1);
    u32::from(acted) * ACTED + u32::from(acts(n)) * ACT
}

/// The bubbles' part of the state; empty where a scene has no bubbles.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub(super) struct BubbleState {
    pub(super) bubbles: Vec<[f32; BUBBLE_WORDS]>,
    /// By identity.
    pub(super) bubbled: Vec<[i32; BUBBLED_WORDS]>,
    pub(super) gas: Vec<[f32; 4]>,
    pub(super) merging: Vec<[i32; 3]>,
    /// By identity, where streams take air down.
    pub(super) falls: Vec<[f32; 2]>,
    /// By flask: quanta of gas that bubbles let go since the last step, and the flow of it, m³/s, as bits.
    pub(super) venting: Vec<[u32; 2]>,
    /// The neighbour search's table, in which bubbles look for particles.
    pub(super) cell_starts: Vec<u32>,
}

/// One atmosphere, Pa.
const ATMOSPHERE: f64 = 101_325.0;

/// Quanta of mass (V0·ρ0) and enthalpy (J per V0·ρ0) of the exchange of bubbles with particles, and of bubbles that join others, as in
/// `common/chemistry/bubbled.wgsl`.
const QUANTA: [f64; 2] = [1.0 / 2_147_483_648.0, 1.0 / 512.0];
const JOINED: [f64; 2] = [1.0 / 16_777_216.0, 1.0 / 16.0];

/// Mass and enthalpy of vapour, over V0·ρ0 and in J per V0·ρ0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct VapourAccount {
    /// In bubbles.
    pub(crate) held: [f64; 2],
    /// On its way to particles; negative where it is on its way from them.
    pub(crate) pending: [f64; 2],
    /// Left the liquid.
    pub(crate) gone: [f64; 2],
    /// Air in bubbles, and air that left from them, each as the mass of steam that has as many molecules.
    pub(crate) air: [f64; 2],
}

/// A bubble of steam of `temperature` (°C) with `radius` (m).
pub(super) fn record(
    parameters: &Parameters,
    tag: u32,
    [position, velocity]: [DVec3; 2],
    [radius, temperature]: [f64; 2],
) -> Bubble {
    let density = ATMOSPHERE * WATER_MOLAR_MASS / (GAS_CONSTANT * (temperature - ABSOLUTE_ZERO));
    let volume = 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3);
    let mass = volume * density / parameters.particle_mass();
    Bubble {
        position: position.as_vec3().to_array(),
        velocity: velocity.as_vec3().to_array(),
        mass: mass as f32,
        enthalpy: (mass * steam_enthalpy(temperature)) as f32,
        membership: tag,
        radius: radius as f32,
        radius_before: radius as f32,
        position_before: position.as_vec3().to_array(),
        ..Bubble::default()
    }
}

impl BubbleState {
    /// The state without bubbles, of `count` particles in as many cells and as many flasks.
    pub(super) fn start(parameters: &Parameters, count: usize, cells: u32, flasks: usize) -> Self {
        let Some(bubbles) = parameters.bubbles() else {
            return Self::default();
        };
        let slots = bubbles.slots() as usize;
        Self {
            bubbles: vec![[0.0; BUBBLE_WORDS]; slots],
            bubbled: vec![[0; BUBBLED_WORDS]; count],
            gas: vec![[0.0; 4]; count],
            merging: vec![[0; 3]; slots],
            falls: vec![[0.0; 2]; if bubbles.air { count } else { 0 }],
            venting: vec![[0; 2]; flasks],
            cell_starts: vec![0; cells as usize],
        }
    }

    pub(super) fn records(&self) -> &[Bubble] {
        bytemuck::cast_slice(&self.bubbles)
    }

    /// Sums of the vapour by where it is.
    pub(super) fn account(&self) -> VapourAccount {
        let mut account = VapourAccount::default();
        for bubble in self.records() {
            let held = [bubble.mass, bubble.enthalpy];
            add(&mut account.held, held.map(f64::from));
            let air = [bubble.air, bubble.air_gone];
            add(&mut account.air, air.map(f64::from));
            add(&mut account.gone, bubble.gone.map(f64::from));
        }
        let air = self.merging.iter().map(|joins| f64::from(joins[2]));
        account.air[0] += JOINED[0] * air.sum::<f64>();
        for given in &self.bubbled {
            let parts = [0, 1].map(|k| f64::from(given[k]) * QUANTA[k]);
            add(&mut account.pending, parts);
        }
        for joins in &self.merging {
            let parts = [0, 1].map(|k| f64::from(joins[k]) * JOINED[k]);
            add(&mut account.held, parts);
        }
        account
    }
}

impl Solver {
    /// The constants `step` of substep `n` with those of the next step of the bubbles.
    pub(super) fn with_bubbles(&self, step: Step, n: u32) -> Step {
        let substeps = self.parameters.substeps;
        let (Some(bubbles), Some(next)) =
            (self.parameters.bubbles(), Bubbles::step_from(n, substeps))
        else {
            return step;
        };
        Step {
            bubbles: flags(n, substeps),
            approach: Bubbles::approach(n, substeps) as f32,
            bubble_time: (f64::from(next.substeps) * self.parameters.substep_time()) as f32,
            before_bubbles: u32::from(next.second) * bubbles.slots(),
            cavity: Bubbles::covered(n, substeps) as f32,
            ..step
        }
    }

    /// `live` and `live_args` at a frame's end: the places of bubbles that are a cavity, or were one a step before, as the frame's last
    /// step listed them; of drops none, as those are listed anew before they fly.
    pub(super) fn listed_places(&self, bubbles: &[Bubble]) -> (Vec<u32>, [u32; 16]) {
        let seen = (0u32..).zip(bubbles);
        let seen = seen.filter(|(_, bubble)| bubble.radius > 0.0 || bubble.radius_before > 0.0);
        let mut live: Vec<u32> = seen.map(|(slot, _)| slot).collect();
        let count = live.len() as u32;
        live.resize(bubbles.len(), 0);
        live.extend([0, count]);
        let lanes = lanes::of_bubbles(&self.gpu, self.lanes);
        let mut args = NO_PLACES;
        args[(SET_ARGS / 4) as usize] = (count * lanes).div_ceil(GROUP);
        (live, args)
    }

    /// Line 18, of cavities.
    pub(super) fn displace(&self, rec: &mut Recorder, step: &Step) -> Result<(), SolverError> {
        let Some(pass) = &self.pipelines.cavity else {
            return Ok(());
        };
        // The places that the step of the bubbles before this substep listed.
        let set = u64::from(step.before_bubbles == 0);
        self.pass(rec, pass)
            .constants(step)
            .indirect(&self.buffers.live_args, set * SET_ARGS)?;
        Ok(())
    }

    /// The step of the bubbles after substep `n`, if there is one.
    pub(super) fn bubble(
        &self,
        rec: &mut Recorder,
        step: &Step,
        n: u32,
    ) -> Result<(), SolverError> {
        let (Some(pass), Some(bubbles)) = (&self.pipelines.bubbles, self.parameters.bubbles())
        else {
            return Ok(());
        };
        let substeps = self.parameters.substeps;
        let Some(part) = Bubbles::step_after(n, substeps) else {
            return Ok(());
        };
        let args = &self.buffers.live_args;
        let first = u64::from(part.second) * SET_ARGS;
        if let Some(live) = &self.pipelines.live {
            let size = 4 * u64::from(bubbles.slots());
            self.pass(rec, live)
                .constants(step)
                .indirect(&self.buffers.claims, size)?;
        }
        self.pass(rec, pass).constants(step).indirect(args, first)?;
        if let Some(spray) = &self.pipelines.spray {
            self.pass(rec, spray)
                .constants(step)
                .indirect(args, first + DROPS_ARGS)?;
        }
        Ok(())
    }
}
