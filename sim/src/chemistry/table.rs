//! The properties as uniform tables with linear interpolation, the same ones
//! for the CPU and the GPU, and the enthalpy that follows from them.

use super::constants::ABSOLUTE_ZERO;
use super::properties::{CAPACITY_SLOPE, CAPACITY_SLOPE_FROM, COLUMN_TEMPERATURES, Properties};
use super::segregation::{Lamellae, USUAL_FEED};
use std::sync::{Arc, OnceLock};

/// Intervals of the table from pure water to pure acid. Against the curves
/// the enthalpy is off by 60 J/kg (14 mK) at most below 1 % acid and by 28
/// J/kg above, the boiling point by 0.05 K (1.2 K where the azeotrope's kink
/// falls between two nodes).
pub const INTERVALS: usize = 256;

/// Temperature of the pure liquids whose enthalpy is zero, °C: that of the
/// heats of mixing.
pub const ENTHALPY_ZERO: f64 = 25.0;

/// Temperature of the heat capacities, °C.
const CAPACITY_AT: f64 = 20.0;

/// Enthalpy of steam at 25 °C over liquid water's there, J/kg (CoolProp).
pub const STEAM_ENTHALPY: f64 = 2.442e6;

/// Temperatures between which densities follow their law, °C: acid boils at 337 °C.
const DENSITY_RANGE: [f64; 2] = [0.0, 340.0];

/// Heat capacity of steam, J/(kg K), mean from 25 to 150 °C.
pub const STEAM_CAPACITY: f64 = 1.9e3;

/// h_v(T), J/kg: steam of `temperature` (°C) over liquid water at 25 °C.
pub fn steam_enthalpy(temperature: f64) -> f64 {
    STEAM_ENTHALPY + STEAM_CAPACITY * (temperature - ENTHALPY_ZERO)
}

/// Properties of one composition, between two nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Row {
    /// Acid mass fraction.
    pub acid: f64,
    /// Enthalpy at 25 °C over the pure liquids' there, J/kg: minus the heat
    /// of mixing.
    pub enthalpy: f64,
    /// d/dc of it over the interval, J/kg.
    pub enthalpy_slope: f64,
    /// Heat capacity at 20 °C, J/(kg K).
    pub capacity: f64,
    /// d/dc of it over the interval, J/(kg K).
    pub capacity_slope: f64,
    /// dcp/dT, J/(kg K²).
    pub capacity_rise: f64,
    /// Boiling point, °C.
    pub boiling_point: f64,
    /// d/dc of it over the interval, K.
    pub boiling_slope: f64,
    /// Density at 20 °C, kg/m³.
    pub density: f64,
    /// Its slope in temperature, kg/(m³ K), 20 to 100 °C.
    pub density_slope: f64,
    /// ln of the viscosity in Pa·s at 20, 60 and 100 °C.
    pub log_viscosity: [f64; 3],
}

impl Row {
    /// cp(T), J/(kg K).
    pub fn capacity_at(&self, temperature: f64) -> f64 {
        self.capacity + self.capacity_rise * (temperature - CAPACITY_AT)
    }

    /// h(T) in J/kg over the pure liquids at 25 °C: minus the heat of mixing,
    /// plus ∫ cp dT.
    pub fn enthalpy_at(&self, temperature: f64) -> f64 {
        let (warmth, square) = warmth(temperature);
        self.enthalpy + self.capacity * warmth + self.capacity_rise * square
    }

    /// ∂h/∂c at `temperature`, J/kg.
    pub fn slope_at(&self, temperature: f64) -> f64 {
        let (warmth, square) = warmth(temperature);
        let rise = if self.acid < CAPACITY_SLOPE_FROM {
            CAPACITY_SLOPE / CAPACITY_SLOPE_FROM
        } else {
            0.0
        };
        self.enthalpy_slope + self.capacity_slope * warmth + rise * square
    }

    /// Enthalpy that it takes to evaporate water from the liquid at
    /// `temperature` (°C), J/kg of water: h_v − (h − c·∂h/∂c).
    pub fn latent_heat(&self, temperature: f64) -> f64 {
        let partial = self.enthalpy_at(temperature) - self.acid * self.slope_at(temperature);
        steam_enthalpy(temperature) - partial
    }

    /// T in °C of a mixture of this liquid and the mass fraction `vapour` of
    /// steam whose enthalpy is `enthalpy` J/kg. Closed form, as cp is linear
    /// in T.
    pub fn temperature_with_steam(&self, enthalpy: f64, vapour: f64) -> f64 {
        let liquid = 1.0 - vapour;
        let zero = liquid * self.enthalpy + vapour * STEAM_ENTHALPY;
        let linear = liquid * self.capacity + vapour * STEAM_CAPACITY;
        let square = 0.5 * liquid * self.capacity_rise;
        // With t = T − 20: square·(t² − 25) + linear·(t − 5) = enthalpy − zero.
        let offset = ENTHALPY_ZERO - CAPACITY_AT;
        let level = enthalpy - zero + linear * offset + square * offset * offset;
        // Below a radicand of zero there is no temperature; what is colder
        // than absolute zero stays there.
        let root = (linear * linear + 4.0 * square * level).max(0.0).sqrt();
        let temperature = CAPACITY_AT + 2.0 * level / (linear + root);
        temperature.max(ABSOLUTE_ZERO)
    }

    /// T in °C of this liquid with the enthalpy `enthalpy` J/kg.
    pub fn temperature(&self, enthalpy: f64) -> f64 {
        self.temperature_with_steam(enthalpy, 0.0)
    }

    /// ρ(T), kg/m³: linear from 0 to 340 °C, and no further. CARMA's table has it
    /// so to 200 °C, and it rests on measurements up to 100 °C; water at 150 °C
    /// is 1.7 % lighter (IAPWS-95), and other continuations of acid's differ by 2 %.
    /// Above 200 °C we found no measurement: for acid of 98 % at 337 °C this is
    /// 1,527, and Rackett's equation from the critical point (924 K) estimates 1,408.
    pub fn density_at(&self, temperature: f64) -> f64 {
        let [coldest, hottest] = DENSITY_RANGE;
        let warm = temperature.clamp(coldest, hottest) - COLUMN_TEMPERATURES[0];
        self.density + self.density_slope * warm
    }

    /// Viscosity, Pa·s: ln η is linear in 1/T (Andrade) between 20, 60 and
    /// 100 °C, and on to either side.
    pub fn viscosity_at(&self, temperature: f64) -> f64 {
        let inverse = |celsius: f64| 1.0 / (celsius - ABSOLUTE_ZERO);
        let nodes = COLUMN_TEMPERATURES.map(inverse);
        let at = inverse(temperature.clamp(0.0, 350.0));
        let i = usize::from(at < nodes[1]);
        let share = (at - nodes[i]) / (nodes[i + 1] - nodes[i]);
        let log = &self.log_viscosity;
        (log[i] + share * (log[i + 1] - log[i])).exp()
    }
}

/// T − 25 and ½((T − 20)² − 25): ∫ dT and ∫ (T − 20) dT from 25 °C.
fn warmth(temperature: f64) -> (f64, f64) {
    let warmth = temperature - ENTHALPY_ZERO;
    (
        warmth,
        warmth * (0.5 * warmth + ENTHALPY_ZERO - CAPACITY_AT),
    )
}

/// [`Properties`] at [`INTERVALS`] + 1 nodes over the acid mass fraction, and those of lamellae.
#[derive(Clone, Debug)]
pub struct SolutionTable {
    nodes: Vec<[f64; 8]>,
    /// Acid fraction of the acid's layers.
    feed: f64,
    /// Made when they are first asked for.
    lamellae: OnceLock<Arc<Lamellae>>,
}

impl SolutionTable {
    /// Table of the project's own data, for lamellae of water and concentrated acid.
    pub fn new() -> Self {
        Self::fed_by(USUAL_FEED)
    }

    /// The same for lamellae of water and acid of the mass fraction `feed`, above 0 and up to 1.
    pub fn fed_by(feed: f64) -> Self {
        let curves = Properties::new();
        let node = |i: usize| {
            let acid = i as f64 / INTERVALS as f64;
            let [cold, _, hot] = curves.densities(acid);
            let [at_20, at_60, at_100] = curves.log_viscosities(acid);
            [
                -curves.heat_of_mixing(acid),
                curves.heat_capacity(acid),
                curves.boiling_point(acid),
                cold,
                (hot - cold) / (COLUMN_TEMPERATURES[2] - COLUMN_TEMPERATURES[0]),
                at_20,
                at_60,
                at_100,
            ]
        };
        Self {
            nodes: (0..=INTERVALS).map(node).collect(),
            feed,
            lamellae: OnceLock::new(),
        }
    }

    /// Properties of lamellae less those of their mean.
    pub fn lamellae(&self) -> &Lamellae {
        self.lamellae.get_or_init(|| Lamellae::of(self.feed))
    }

    /// For the GPU: two vectors per node, at 2i and 2i + 1 for the acid
    /// fraction i/[`INTERVALS`]:
    /// - [h at 25 °C (J/kg), cp at 20 °C (J/(kg K)), T_b (°C), ρ at 20 °C
    ///   (kg/m³)],
    /// - [dρ/dT (kg/(m³ K)), ln η (η in Pa·s) at 20, 60 and 100 °C].
    ///
    /// Slopes in c are the difference of two nodes times [`INTERVALS`].
    pub fn rows(&self) -> Vec<[f32; 4]> {
        self.nodes
            .iter()
            .flat_map(|node| {
                let [a, b, c, d, e, f, g, h] = node.map(|value| value as f32);
                [[a, b, c, d], [e, f, g, h]]
            })
            .collect()
    }

    /// Properties at the acid mass fraction `acid`, which is taken into 0 to 1.
    pub fn at(&self, acid: f64) -> Row {
        let acid = acid.clamp(0.0, 1.0);
        let place = acid * INTERVALS as f64;
        let i = (place as usize).min(INTERVALS - 1);
        let t = place - i as f64;
        let (low, high) = (&self.nodes[i], &self.nodes[i + 1]);
        let value = |k: usize| low[k] + t * (high[k] - low[k]);
        let slope = |k: usize| (high[k] - low[k]) * INTERVALS as f64;
        Row {
            acid,
            enthalpy: value(0),
            enthalpy_slope: slope(0),
            capacity: value(1),
            capacity_slope: slope(1),
            capacity_rise: CAPACITY_SLOPE * (acid / CAPACITY_SLOPE_FROM).min(1.0),
            boiling_point: value(2),
            boiling_slope: slope(2),
            density: value(3),
            density_slope: value(4),
            log_viscosity: [value(5), value(6), value(7)],
        }
    }

    /// Specific enthalpy of a liquid of acid fraction `acid` at
    /// `temperature` (°C), J/kg over the pure liquids at 25 °C.
    pub fn enthalpy(&self, acid: f64, temperature: f64) -> f64 {
        self.at(acid).enthalpy_at(temperature)
    }
}

impl Default for SolutionTable {
    fn default() -> Self {
        Self::new()
    }
}
