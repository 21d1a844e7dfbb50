//! Drops that bubbles throw up when they burst: their part of the state.

use super::buffers::{DROPS_WORDS, SPRAYED_WORDS};
use crate::parameters::Parameters;
use serde::{Deserialize, Serialize};
use vitriol_shaders::layout::Drops;

/// The spray's part of the state; empty where a scene has no spray.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub(super) struct SprayState {
    pub(super) drops: Vec<[f32; DROPS_WORDS]>,
    /// By identity.
    pub(super) sprayed: Vec<[i32; SPRAYED_WORDS]>,
    /// By flask.
    pub(super) left: Vec<u32>,
}

/// Quanta of mass and acid (V0·ρ0) and of enthalpy (J per V0·ρ0), and of mass that left a flask (V0·ρ0), as in
/// `common/chemistry/drops.wgsl`.
const QUANTA: [f64; 3] = [1.0 / 16_777_216.0, 1.0 / 16_777_216.0, 1.0 / 16.0];
const LEFT_QUANTUM: f64 = 1.0 / 65_536.0;

/// Mass and acid over V0·ρ0, and enthalpy, J per V0·ρ0.
pub(crate) type SprayedLiquid = [f64; 3];

/// The drops' liquid by where it is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct SprayAccount {
    /// In drops that fly.
    pub(crate) flying: SprayedLiquid,
    /// On glass, table and floor.
    pub(crate) fallen: SprayedLiquid,
    /// On its way to particles; negative where it is on its way from them.
    pub(crate) pending: SprayedLiquid,
}

/// A flask's quanta as mass over V0·ρ0.
pub(super) fn spray_left(quanta: Option<&u32>) -> f64 {
    f64::from(quanta.copied().unwrap_or_default()) * LEFT_QUANTUM
}

impl SprayState {
    /// The state without drops, of `count` particles and `flasks` flasks.
    pub(super) fn start(parameters: &Parameters, count: usize, flasks: usize) -> Self {
        match parameters
            .bubbles()
            .map(|bubbles| bubbles.places_of_drops() as usize)
        {
            None | Some(0) => Self::default(),
            Some(places) => Self {
                drops: vec![[0.0; DROPS_WORDS]; places],
                sprayed: vec![[0; SPRAYED_WORDS]; count],
                left: vec![0; flasks],
            },
        }
    }

    pub(super) fn records(&self) -> &[Drops] {
        bytemuck::cast_slice(&self.drops)
    }

    /// Sums of the drops' liquid by where it is.
    pub(super) fn account(&self) -> SprayAccount {
        let mut account = SprayAccount::default();
        for drops in self.records() {
            if drops.mass > 0.0 {
                let held = [drops.mass, drops.acid, drops.enthalpy];
                add(&mut account.flying, held.map(f64::from));
            }
            add(&mut account.fallen, drops.fallen.map(f64::from));
        }
        for given in &self.sprayed {
            let parts = [0, 1, 2].map(|k| f64::from(given[k]) * QUANTA[k]);
            add(&mut account.pending, parts);
        }
        account
    }
}

/// Adds each part to its sum.
pub(super) fn add<const N: usize>(sums: &mut [f64; N], parts: [f64; N]) {
    for (sum, part) in sums.iter_mut().zip(parts) {
        *sum += part;
    }
}
