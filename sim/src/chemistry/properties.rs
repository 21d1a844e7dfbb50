//! Properties of sulfuric acid over composition, from the tables in `data`.

use super::constants::{ABSOLUTE_ZERO, ACID_MOLAR_MASS, WATER_MOLAR_MASS};
use super::curve::Curve;

const ACID_TABLE: &str = include_str!("../../data/sulfuric_acid.csv");
const HEAT_TABLE: &str = include_str!("../../data/heat_of_mixing.csv");

/// Heat evolved in infinite dilution at 25 °C, kJ/mol H₂SO₄ (NBS 1982:
/// −909.27 for SO₄²⁻ + 2 H⁺ less −813.989 for the liquid).
const INFINITE_DILUTION: f64 = 95.28;

/// Heat evolved by the first trace of water in pure acid at 25 °C, kJ/mol of
/// water. No table reaches there: it goes on from k = 2, 1.5, 1, 0.5 (±2
/// moves the heat of 98 % acid by 2 kJ/kg).
const FIRST_WATER: f64 = 37.0;

/// Composition of the azeotrope, mass fraction: no more water boils out.
pub const AZEOTROPE: f64 = 0.983;

/// Slope of the heat capacity in temperature from 60 % acid on, J/(kg K²)
/// (Perry; ±100 % moves a mixture at 150 °C by 4 K).
pub const CAPACITY_SLOPE: f64 = 1.0;

/// Acid mass fraction from which the slope is that.
pub const CAPACITY_SLOPE_FROM: f64 = 0.6;

/// Temperatures of the three columns of density and viscosity, °C.
pub const COLUMN_TEMPERATURES: [f64; 3] = [20.0, 60.0, 100.0];

/// Curves through the tables, over the acid mass fraction.
///
/// Everything from 98 % (boiling point: 98.3 %, the azeotrope) to 100 % is
/// extrapolated. The boiling point stays that of the azeotrope: what boils
/// beyond is SO₃, which is not modelled.
#[derive(Clone, Debug, PartialEq)]
pub struct Properties {
    density: [Curve; 3],
    heat_capacity: Curve,
    log_viscosity: [Curve; 3],
    boiling_point: Curve,
    vapour_pressure: [Curve; 2],
    heat: Curve,
}

impl Properties {
    /// Reads the tables.
    pub fn new() -> Self {
        let rows: Vec<[f64; 11]> = table(ACID_TABLE);
        let column = |index: usize, unit: fn(f64) -> f64| {
            let points = rows.iter().map(|row| (row[0] / 100.0, unit(row[index])));
            Curve::through(&points.collect::<Vec<_>>())
        };
        let per_litre = |x: f64| 1000.0 * x;
        let log_of_milli = |x: f64| (1e-3 * x).ln();
        Self {
            density: [1, 2, 3].map(|index| column(index, per_litre)),
            heat_capacity: column(4, per_litre),
            log_viscosity: [5, 6, 7].map(|index| column(index, log_of_milli)),
            boiling_point: column(8, |x| x),
            vapour_pressure: [9, 10].map(|index| column(index, |x| x)),
            heat: heat_curve(),
        }
    }

    /// Density at [`COLUMN_TEMPERATURES`], kg/m³.
    pub fn densities(&self, acid: f64) -> [f64; 3] {
        [0, 1, 2].map(|i| self.density[i].at(acid))
    }

    /// ln of the viscosity in Pa·s at [`COLUMN_TEMPERATURES`].
    pub fn log_viscosities(&self, acid: f64) -> [f64; 3] {
        [0, 1, 2].map(|i| self.log_viscosity[i].at(acid))
    }

    /// Heat capacity at 20 °C, J/(kg K).
    pub fn heat_capacity(&self, acid: f64) -> f64 {
        self.heat_capacity.at(acid)
    }

    /// Boiling point at one atmosphere, °C.
    pub fn boiling_point(&self, acid: f64) -> f64 {
        self.boiling_point.at(acid.min(AZEOTROPE))
    }

    /// Partial pressure of water over the liquid, mmHg.
    pub fn vapour_pressure(&self, acid: f64, temperature: f64) -> f64 {
        let [a, b] = [0, 1].map(|i| self.vapour_pressure[i].at(acid));
        10f64.powf(a - b / (temperature - ABSOLUTE_ZERO))
    }

    /// Heat evolved at 25 °C on making the mixture from the pure liquids,
    /// J/kg of mixture.
    pub fn heat_of_mixing(&self, acid: f64) -> f64 {
        let (n_a, n_w) = (acid / ACID_MOLAR_MASS, (1.0 - acid) / WATER_MOLAR_MASS);
        1000.0 * self.heat.at(acid.sqrt()) * n_a * n_w / (n_a + n_w)
    }
}

impl Default for Properties {
    fn default() -> Self {
        Self::new()
    }
}

/// Q(k)·(k + 1)/k over √c, kJ/mol.
///
/// The heat per mole of mixture is x(1 − x) times this, with x the mole
/// fraction of acid: a factor of two over the whole range, finite at both
/// ends, where the heat itself has to vanish with the right slope. Over √c
/// since the heats of dilute solutions go on falling as their ions part, ever
/// faster towards c = 0.
fn heat_curve() -> Curve {
    let mut points: Vec<_> = table::<2>(HEAT_TABLE)
        .iter()
        .map(|&[k, heat]| {
            let acid = ACID_MOLAR_MASS / (ACID_MOLAR_MASS + k * WATER_MOLAR_MASS);
            (acid.sqrt(), heat * (k + 1.0) / k)
        })
        .chain([(0.0, INFINITE_DILUTION), (1.0, FIRST_WATER)])
        .collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    Curve::through(&points)
}

/// Rows of a table with N columns; an empty cell is not a number. Comments
/// and the header are left out.
pub(super) fn table<const N: usize>(text: &str) -> Vec<[f64; N]> {
    text.lines()
        .filter(|line| line.starts_with(|first: char| first.is_ascii_digit()))
        .map(|line| {
            let mut row = [f64::NAN; N];
            for (value, cell) in row.iter_mut().zip(line.split(',')) {
                *value = cell.trim().parse().unwrap_or(f64::NAN);
            }
            row
        })
        .collect()
}
