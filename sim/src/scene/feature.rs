//! Features that a scene may name.

use serde::{Deserialize, Serialize};

/// A feature that a scene models beyond a fluid with viscosity. Features that are not named
/// cost nothing.
#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Feature {
    /// Temperature and its diffusion.
    Heat,
    /// Acid fraction, its diffusion and the heat of solution.
    Dilution,
    /// The paper's anti-viscosity above the boiling point.
    Boiling,
    /// Surface tension, and the contact angles of glass and table.
    Tension,
    /// Vorticity confinement.
    Vorticity,
    /// Density by composition and temperature: water floats on acid.
    Density,
    /// Viscosity by composition and temperature.
    Viscosity,
    /// Water that boils above the boiling point of the composition, and evaporates at the surface below it.
    Evaporation,
    /// Vapour in bubbles that have volume, rise and leave; without them particles hold it.
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
    /// All of them.
    pub const ALL: [Self; 13] = [
        Self::Heat,
        Self::Dilution,
        Self::Boiling,
        Self::Tension,
        Self::Vorticity,
        Self::Density,
        Self::Viscosity,
        Self::Evaporation,
        Self::Bubbles,
        Self::Spray,
        Self::Air,
        Self::Segregation,
        Self::Losses,
    ];

    /// The name as scenes have it.
    pub fn name(self) -> String {
        format!("{self:?}").to_lowercase()
    }
}
