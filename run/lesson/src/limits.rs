//! Limits from which on something is an incident.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Acid mass fraction from which on acid is concentrated: where UN 1830 (more than 51 % acid) begins and UN 2796 ends.
pub(crate) const CONCENTRATED: f64 = 0.51;

/// Limits of rate, concentration, temperature, volume and speed from which on an observation is a pour or an incident.
#[derive(Clone, Copy, Debug, PartialEq, JsonSchema, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Limits {
    /// Fastest that acid and water may come together, m³/s, over half a second. Our choice, as the score's: 96 % acid that mixes with
    /// ten times its mass of water gives off some 0.7 MJ a kilogram (Thomsen's formula, docs/chemistry.md), so 5 mL/s are 6 kW, which
    /// warm 250 mL of water by 6 K each second.
    pub rate_m3_s: f64,
    /// Acid mass fraction from which on acid is concentrated.
    pub concentrated: f64,
    /// Mean temperature of a flask's liquid from which on it is an incident, °C: it burns through skin in six seconds (US Consumer Product
    /// Safety Commission, document 5098). Colder liquid is an incident only where it touches skin
    /// ([`SCALDS`](vitriol_sim::solver::SCALDS)).
    pub hot_c: f64,
    /// Least liquid of a pour, m³: less is drops that cling to a rim. Our choice.
    pub least_pour_m3: f64,
    /// Least liquid that is spilt, m³: two drops of 0.05 mL. Our choice.
    pub least_spill_m3: f64,
    /// Least volume that boiling throws out where the flask's mean temperature [scalds](vitriol_sim::solver::SCALDS), m³: a fifth of a
    /// drop, as spray, which an eye does not bear. Our choice.
    pub least_thrown_m3: f64,
    /// Least acid that boiling throws out where it does not scald, m³: as in a drop of 0.05 mL of battery acid (37 %), against which
    /// goggles are worn. Our choice. Drops of 10 % acid that a correct pour throws up have less (docs/measurements/lesson.md).
    pub least_thrown_acid_m3: f64,
    /// Least speed of impact of glass that is dropped, m/s: a fall of 5 cm. Our choice.
    pub least_blow_m_s: f64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            rate_m3_s: 5e-6,
            concentrated: CONCENTRATED,
            hot_c: 60.0,
            least_pour_m3: 0.5e-6,
            least_spill_m3: 0.1e-6,
            least_thrown_m3: 0.01e-6,
            least_thrown_acid_m3: 0.0185e-6,
            least_blow_m_s: 1.0,
        }
    }
}
