//! Measurements of a world, as a sample holds them.

use std::collections::BTreeMap;

use vitriol_sim::measure::{HeatMeasurement, Ledger};
use vitriol_sim::scene::Scene;

use crate::sample::{HeatSample, LedgerSample};

/// Values by the names of the scene's flasks.
pub(super) fn by_flask<T: Copy>(scene: &Scene, values: &[T]) -> BTreeMap<String, T> {
    let names = scene.flasks.iter().map(|flask| flask.name.clone());
    names.zip(values.iter().copied()).collect()
}

/// Heat, and the ledger since `start`.
pub(super) fn of_heat(scene: &Scene, heat: &HeatMeasurement, start: &Ledger) -> HeatSample {
    let superheat = heat.superheat.as_ref();
    let boiling_in_flasks = superheat.map(|superheat| {
        let mut counts = superheat.in_flasks.clone();
        counts.resize(scene.flasks.len(), 0);
        by_flask(scene, &counts)
    });
    HeatSample {
        temperature_mean_c: heat.temperature_mean,
        temperature_p99_c: heat.temperature_p99,
        temperature_max_c: heat.temperature_max,
        temperatures_in_flasks_c: by_flask(scene, &heat.temperatures_in_flasks)
            .into_iter()
            .filter(|(_, [least, most])| least <= most)
            .collect(),
        temperatures_of_glass_c: by_flask(scene, &heat.temperatures_of_glass),
        acid_mean: heat.acid_mean,
        acid_min: heat.acid_min,
        acid_max: heat.acid_max,
        superheat_max_k: superheat.map(|superheat| superheat.max),
        boiling_particles: superheat.map(|superheat| superheat.particles),
        boiling_in_flasks: boiling_in_flasks.unwrap_or_default(),
        ledger: heat.ledger.map(|ledger| LedgerSample {
            initial_j: start.balance(),
            exchanged_j: ledger.exchanged,
            held_j: ledger.held,
            steam_j: ledger.steam_enthalpy,
            closure: ledger.closure(start),
            steam_kg: ledger.steam,
            mist_kg: ledger.mist,
            dew_kg: ledger.dew,
            vapour_kg: ledger.vapour,
            spray_kg: ledger.spray,
            spray_fallen_kg: ledger.spray_fallen,
            air_kg: ledger.air,
            air_held_kg: ledger.air_held,
            bubbles_m3: ledger.gas,
            foam_m3: ledger.foam,
        }),
    }
}
