//! What is measured of a run at one moment. Field names are the keys of
//! `report.json`.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The state at one moment of a run.
#[derive(Debug, Clone, PartialEq, Default, JsonSchema, Serialize, Deserialize)]
pub struct Sample {
    /// Simulated time, s.
    pub t_s: f64,
    /// Mean over particles of max(0, ρ/ρ₀ − 1).
    pub density_error_mean: f64,
    /// 99th percentile of the same.
    pub density_error_p99: f64,
    /// Kinetic energy, J.
    pub kinetic_energy_j: f64,
    /// What is where, kg.
    pub mass_kg: MassByPlace,
    /// Rebuilds of the neighbour list since the start.
    pub neighbour_rebuilds: u64,
    /// By flask: mass that has left it so far, each particle once, and drops of bubbles that came to rest elsewhere, kg.
    #[serde(default)]
    pub left_kg: BTreeMap<String, f64>,
    /// By flask: mass above its rim's plane, in no flask, that left it last, kg.
    #[serde(default)]
    pub above_rim_kg: BTreeMap<String, f64>,
    /// By flask that holds liquid: area of its inside at the height that the liquid would have at rest, upright and without
    /// bubbles, m².
    #[serde(default)]
    pub surface_m2: BTreeMap<String, f64>,
    /// Height of the highest liquid in no flask over the rim of the flask that it left last, m: particles and drops of bubbles.
    /// `None` where nothing is above its rim.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub highest_drop_m: Option<f64>,
    /// Temperature and composition, where heat is modelled.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heat: Option<HeatSample>,
}

/// Fluid mass by place, kg.
#[derive(Debug, Clone, PartialEq, Default, JsonSchema, Serialize, Deserialize)]
pub struct MassByPlace {
    /// Inside each flask, by the flask's name.
    pub flasks: BTreeMap<String, f64>,
    /// On the table, outside all flasks.
    pub table: f64,
    /// On the floor.
    pub floor: f64,
    /// Neither: in the stream, or flying.
    pub air: f64,
}

impl MassByPlace {
    /// All of it, kg.
    pub fn total(&self) -> f64 {
        self.flasks.values().sum::<f64>() + self.table + self.floor + self.air
    }

    /// Each place with its mass, flasks first.
    pub fn places(&self) -> impl Iterator<Item = (&str, f64)> {
        let flasks = self.flasks.iter().map(|(name, kg)| (name.as_str(), *kg));
        flasks.chain([
            ("table", self.table),
            ("floor", self.floor),
            ("air", self.air),
        ])
    }
}

/// Temperature and composition at one moment. Means are by mass.
#[derive(Debug, Clone, PartialEq, Default, JsonSchema, Serialize, Deserialize)]
pub struct HeatSample {
    /// Mean temperature, °C.
    pub temperature_mean_c: f64,
    /// 99th percentile of the temperature over particles, °C.
    pub temperature_p99_c: f64,
    /// Highest temperature, °C.
    pub temperature_max_c: f64,
    /// Least and highest temperature in each flask that holds liquid, °C.
    pub temperatures_in_flasks_c: BTreeMap<String, [f64; 2]>,
    /// Least and highest temperature of each flask's glass, °C; empty where none takes up heat.
    pub temperatures_of_glass_c: BTreeMap<String, [f64; 2]>,
    /// Mean acid mass fraction.
    pub acid_mean: f64,
    /// Least acid fraction.
    pub acid_min: f64,
    /// Largest acid fraction.
    pub acid_max: f64,
    /// Largest temperature above the boiling point, K (negative below it);
    /// where there is a boiling point.
    pub superheat_max_k: Option<f64>,
    /// Particles above it.
    pub boiling_particles: Option<u64>,
    /// Of these, the members of each flask.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub boiling_in_flasks: BTreeMap<String, u64>,
    /// Mass and energy; of the physical chemistry.
    pub ledger: Option<LedgerSample>,
}

/// Where the enthalpy is that there was at the start: initial + exchanged =
/// held + steam. Relative to the pure liquids at 25 °C.
#[derive(Debug, Clone, Copy, PartialEq, Default, JsonSchema, Serialize, Deserialize)]
pub struct LedgerSample {
    /// Enthalpy at the start, J.
    pub initial_j: f64,
    /// Heat gained from around, J; negative where it was lost.
    pub exchanged_j: f64,
    /// Enthalpy of what is still there, J.
    pub held_j: f64,
    /// Enthalpy that steam took along, J.
    pub steam_j: f64,
    /// By how much the two sides differ, over the sum of |h| at the start.
    pub closure: f64,
    /// Water that left as steam, kg.
    pub steam_kg: f64,
    /// Mist that it is in the air over the liquid, kg.
    pub mist_kg: f64,
    /// What of it condensed on the glass, kg.
    #[serde(default)]
    pub dew_kg: f64,
    /// Vapour that is still in the liquid, kg.
    pub vapour_kg: f64,
    /// Drops that bubbles threw up and that fly, kg.
    #[serde(default)]
    pub spray_kg: f64,
    /// Those that came to rest on glass, table and floor since the start, kg.
    #[serde(default)]
    pub spray_fallen_kg: f64,
    /// Air that streams took down since the start, kg.
    #[serde(default)]
    pub air_kg: f64,
    /// What of it is in bubbles, kg.
    #[serde(default)]
    pub air_held_kg: f64,
    /// Volume of all bubbles, m³.
    #[serde(default)]
    pub bubbles_m3: f64,
    /// Volume of those that lie at the surface, m³.
    #[serde(default)]
    pub foam_m3: f64,
}
