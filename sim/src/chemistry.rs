//! The chemistry of diluting sulfuric acid, as pure functions.
//!
//! Two models. [`paper`] has Eqs 5 to 13 and 17 of the paper, with one boiling
//! point, one density and Thomsen's heat of solution. [`physical`] adds what
//! its section 8 names as missing: mass fraction and specific enthalpy as the state,
//! properties by composition and temperature from tables, vapour that takes
//! latent heat and mass along, and anti-viscosity that is paid for.
//!
//! Units: J, kg, m, s and °C throughout; composition is the mass fraction of
//! H₂SO₄, 0 to 1. An energy per mass is per mass of mixture.

pub mod adiabatic;
pub mod bubbles;
mod constants;
pub mod curve;
pub mod dew;
pub mod eddies;
mod error;
pub mod evaporation;
pub mod exchange;
mod model;
pub mod paper;
pub mod physical;
pub mod properties;
pub mod puff;
pub mod segregation;
pub mod table;
pub mod thomsen;
pub mod transport;
pub mod wall_heat;

#[cfg(test)]
mod tests;

pub use constants::{
    ABSOLUTE_ZERO, ACID_DIFFUSIVITY, ACID_MOLAR_MASS, GAS_CONSTANT, THERMAL_DIFFUSIVITY,
    WATER_MOLAR_MASS,
};
pub use error::{OutOfRange, check_content};
pub use model::{Chemistry, Paper, PaperBoiling, PaperDilution, Physical};
