//! Constants that do not depend on the liquid's composition.

/// Absolute zero, °C.
pub const ABSOLUTE_ZERO: f64 = -273.15;

/// Gas constant R, J/(mol K) (CODATA 2018, rounded).
pub const GAS_CONSTANT: f64 = 8.314_463;

/// Molar mass of H₂SO₄, kg/mol (IUPAC 2021 atomic weights).
pub const ACID_MOLAR_MASS: f64 = 0.098_079;

/// Molar mass of water, kg/mol (IUPAC 2021 atomic weights).
pub const WATER_MOLAR_MASS: f64 = 0.018_015;

/// Diffusivity of sulfuric acid in water, m²/s (25 °C, CRC Handbook).
pub const ACID_DIFFUSIVITY: f64 = 1.7e-9;

/// Thermal diffusivity of water, m²/s (20 °C); 98 % acid has 1.3e-7.
pub const THERMAL_DIFFUSIVITY: f64 = 1.4e-7;
