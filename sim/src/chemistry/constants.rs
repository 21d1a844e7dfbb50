//! What does not depend on the liquid.

/// Absolute zero, °C.
pub const ABSOLUTE_ZERO: f64 = -273.15;

/// Gas constant R, J/(mol K) (CODATA 2018, rounded).
pub const GAS_CONSTANT: f64 = 8.314_463;

/// Molar mass of H₂SO₄, kg/mol (IUPAC 2021 atomic weights).
pub const ACID_MOLAR_MASS: f64 = 0.098_079;

/// Molar mass of water, kg/mol (IUPAC 2021 atomic weights).
pub const WATER_MOLAR_MASS: f64 = 0.018_015;
