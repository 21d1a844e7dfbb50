//! Final state of a closed, insulated, well stirred vessel at one atmosphere.

use super::error::OutOfRange;
use super::physical::Content;
use super::table::SolutionTable;

/// Steps after which Newton's iteration has settled anywhere in the table.
const STEPS: u32 = 100;

/// A liquid that is poured in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Feed {
    /// Mass, kg.
    pub mass: f64,
    /// Acid mass fraction.
    pub acid: f64,
    /// Temperature, °C.
    pub temperature: f64,
}

/// The mixture's state in equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mixture {
    /// Temperature, °C.
    pub temperature: f64,
    /// Temperature that it would have without evaporation, °C.
    pub temperature_unboiled: f64,
    /// Acid mass fraction of the liquid.
    pub acid: f64,
    /// Mass of the liquid, kg.
    pub mass: f64,
    /// Volume of the liquid, m³.
    pub volume: f64,
    /// Mass of water that has evaporated, kg.
    pub evaporated: f64,
}

/// The state that mass, acid and enthalpy of all `feeds` (at least one) have
/// together, whichever came first.
///
/// # Errors
/// [`OutOfRange`] for a feed that no liquid is.
pub fn mix(table: &SolutionTable, feeds: &[Feed]) -> Result<Mixture, OutOfRange> {
    let (mut mass, mut acid, mut enthalpy) = (0.0, 0.0, 0.0);
    for feed in feeds {
        let content = Content::liquid(table, feed.mass, feed.acid, feed.temperature)?;
        mass += content.mass;
        acid += content.mass * content.acid;
        enthalpy += content.mass * content.enthalpy;
    }
    if mass <= 0.0 {
        return Err(OutOfRange::Mass(mass));
    }
    let mut all = Content {
        mass,
        acid: acid / mass,
        enthalpy: enthalpy / mass,
        vapour: 0.0,
        variance: 0.0,
    };
    let temperature_unboiled = all.temperature(table);
    all.vapour = all.equilibrium(table, STEPS);
    Ok(Mixture {
        temperature: all.temperature(table),
        temperature_unboiled,
        acid: all.liquid_acid(),
        mass: all.liquid_mass(),
        volume: all.liquid_volume(table),
        evaporated: all.mass * all.vapour,
    })
}
