//! The chemistry of diluting sulfuric acid, as pure functions.
//!
//! Two models. [`paper`] has Eqs 5 to 13 and 17 of the paper, with one boiling
//! point, one density and Thomsen's heat of solution. [`physical`] has what
//! its section 8 misses: mass fraction and specific enthalpy as the state,
//! properties by composition and temperature from tables, vapour that takes
//! latent heat and mass along, and anti-viscosity that is paid for.
//!
//! Units: J, kg, m, s and °C throughout; composition is the mass fraction of
//! H₂SO₄, 0 to 1. An energy per mass is per mass of mixture.

pub mod adiabatic;
pub mod curve;
mod error;
pub mod exchange;
mod model;
pub mod paper;
pub mod physical;
pub mod properties;
pub mod puff;
pub mod table;
pub mod thomsen;
pub mod transport;

#[cfg(test)]
mod tests;

pub use error::{OutOfRange, check_content};
pub use model::{Chemistry, Paper, PaperBoiling, PaperDilution, Physical};

/// Absolute zero, °C.
pub const ABSOLUTE_ZERO: f64 = -273.15;

/// Gas constant R, J/(mol K) (CODATA 2018, rounded).
pub const GAS_CONSTANT: f64 = 8.314_463;

/// Molar mass of H₂SO₄, kg/mol (IUPAC 2021 atomic weights).
pub const ACID_MOLAR_MASS: f64 = 0.098_079;

/// Molar mass of water, kg/mol (IUPAC 2021 atomic weights).
pub const WATER_MOLAR_MASS: f64 = 0.018_015;
