//! What a scene may ask for.

use serde::{Deserialize, Serialize};

/// What a scene models beyond a fluid with viscosity. What is not named
/// costs nothing.
#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Feature {
    /// Temperature and its diffusion.
    Heat,
    /// Acid fraction, its diffusion and the heat of solution.
    Dilution,
    /// Anti-viscosity above the boiling point.
    Boiling,
    /// Surface tension, and what glass and table are wetted by.
    Tension,
    /// Vorticity confinement.
    Vorticity,
    /// Density by composition and temperature: water floats on acid.
    Density,
    /// Viscosity by composition and temperature.
    Viscosity,
    /// Water that evaporates above the boiling point of the composition.
    Evaporation,
    /// Vapour that leaves the liquid, rises and condenses.
    Steam,
    /// Vapour in bubbles that have volume, in place of `Steam`.
    Bubbles,
    /// Drops that bubbles throw up when they burst.
    Spray,
    /// Air that streams take down, in bubbles.
    Air,
    /// Acid and water that are not mixed below a particle's size, of which the water boils first.
    Segregation,
    /// Heat lost through glass and at the free surface.
    Losses,
}

impl Feature {
    /// The name as scenes have it.
    pub fn name(self) -> String {
        format!("{self:?}").to_lowercase()
    }
}
