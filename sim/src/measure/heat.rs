//! Contents of the particles of a scene with heat, all together and at their
//! extremes.

use super::percentile::percentile;
use crate::chemistry::Chemistry;
use crate::chemistry::table::SolutionTable;
use crate::chemistry::wall_heat::RINGS;
use crate::parameters::Parameters;
use crate::solver::SolverState;
use serde::Serialize;
use std::f64::consts::PI;

/// Temperature, composition and, of the physical chemistry, enthalpy of the
/// liquid at one moment. Means are by mass.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HeatMeasurement {
    /// Mean temperature, °C.
    pub temperature_mean: f64,
    /// Standard deviation of the temperature, K.
    pub temperature_spread: f64,
    /// 99th percentile of the temperature over particles, °C.
    pub temperature_p99: f64,
    /// Highest temperature, °C.
    pub temperature_max: f64,
    /// Least and highest temperature in each flask, °C, up to the last one that
    /// holds any; of one that is empty, infinite.
    pub temperatures_in_flasks: Vec<[f64; 2]>,
    /// Least and highest temperature of each flask's glass, °C, where heat is lost to it.
    pub temperatures_of_glass: Vec<[f64; 2]>,
    /// Mean acid mass fraction.
    pub acid_mean: f64,
    /// Standard deviation of the acid fraction.
    pub acid_spread: f64,
    /// Least acid fraction.
    pub acid_min: f64,
    /// Largest acid fraction.
    pub acid_max: f64,
    /// Temperature above the boiling point, where there is one.
    pub superheat: Option<Superheat>,
    /// Mass and energy of the liquid, and of what it exchanged; of the physical chemistry.
    pub ledger: Option<Ledger>,
}

/// Temperature above the boiling point: T_B of the paper, or that of each
/// particle's composition.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Superheat {
    /// Largest, K; negative where nothing is above its boiling point.
    pub max: f64,
    /// Particles above it.
    pub particles: u64,
    /// Of these, the members of each flask, up to the last one that has any.
    pub in_flasks: Vec<u64>,
}

/// Mass and energy of the physical chemistry. Enthalpies are relative to the
/// pure liquids at 25 °C.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Ledger {
    /// Mass of liquid, of its drops that fly or cling, and of vapour that is still in it, in bubbles or in particles, kg.
    pub mass: f64,
    /// Mass of acid, kg.
    pub acid: f64,
    /// Mass of vapour that is still in the liquid, kg.
    pub vapour: f64,
    /// Mass of drops that bubbles threw up and that fly, kg.
    pub spray: f64,
    /// Mass of drops that came to rest on glass, table or floor since the start, kg.
    pub spray_fallen: f64,
    /// Mass of air that streams took down since the start, kg.
    pub air: f64,
    /// Mass of that air that is still in bubbles, kg.
    pub air_held: f64,
    /// Volume of all bubbles, m³.
    pub gas: f64,
    /// Volume of those that lie at the surface, m³.
    pub foam: f64,
    /// Mass of the particles that a cloth took up, or that turned non-finite, kg.
    pub taken_out: f64,
    /// Their enthalpy then, J.
    pub taken_out_enthalpy: f64,
    /// Enthalpy that is held, J.
    pub held: f64,
    /// Heat gained from around, J; negative where it was lost.
    pub exchanged: f64,
    /// Mass of the steam that left, kg.
    pub steam: f64,
    /// Mass of the steam that left and is mist in the air over the liquid, kg.
    pub mist: f64,
    /// Mass of the steam that left and is water on the glass over the liquid, kg.
    pub dew: f64,
    /// Enthalpy of the steam that left, J.
    pub steam_enthalpy: f64,
    /// Σ m|h|, J: the reference for errors.
    pub turnover: f64,
}

impl Ledger {
    /// held + steam + taken out − exchanged, J: the conserved enthalpy.
    pub fn balance(&self) -> f64 {
        self.held + self.steam_enthalpy + self.taken_out_enthalpy - self.exchanged
    }

    /// Change of the balance since `start`, over the enthalpy that
    /// was there, or over the heat that warms as much water by 1 K where that is more.
    pub fn closure(&self, start: &Self) -> f64 {
        let least = start.mass * WATER_KELVIN;
        (self.balance() - start.balance()) / start.turnover.max(least).max(f64::MIN_POSITIVE)
    }
}

fn range(rings: &[[f32; 2]]) -> [f64; 2] {
    let temperatures = rings.iter().map(|ring| f64::from(ring[0]));
    temperatures.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], t| {
        [low.min(t), high.max(t)]
    })
}

/// Mass of air over that of as much steam: 28.96 and 18.015 g/mol.
pub const AIR_OVER_STEAM: f64 = 28.96 / 18.015;

/// Heat that warms water by 1 K at 20 °C, J/kg.
const WATER_KELVIN: f64 = 4184.0;

/// Measures a state; `None` where no heat is modelled. Masses are in kg of
/// the scene, particles that were taken out do not count.
pub fn measure(parameters: &Parameters, state: &SolverState) -> Option<HeatMeasurement> {
    let chemistry = parameters.chemistry.as_ref()?;
    let present: Vec<usize> = (0..state.heat.len())
        .filter(|&slot| state.is_present(slot))
        .collect();
    let of = |axis: usize| {
        let values = present.iter().map(|&slot| {
            let value = state.heat[slot][axis];
            (state.mass_of(slot), f64::from(value))
        });
        Spread::of(values)
    };
    let (temperature, acid) = (of(0), of(1));
    let mut sorted: Vec<f32> = present.iter().map(|&slot| state.heat[slot][0]).collect();
    sorted.sort_by(f32::total_cmp);
    Some(HeatMeasurement {
        temperature_mean: temperature.mean,
        temperature_spread: temperature.deviation,
        temperature_p99: percentile(&sorted, 0.99),
        temperature_max: temperature.max,
        temperatures_in_flasks: by_flask(state, &present),
        temperatures_of_glass: state.glass.chunks(RINGS).map(range).collect(),
        acid_mean: acid.mean,
        acid_spread: acid.deviation,
        acid_min: acid.min,
        acid_max: acid.max,
        superheat: superheat(chemistry, state, &present),
        ledger: ledger(state, &present, parameters.particle_mass()),
    })
}

fn by_flask(state: &SolverState, present: &[usize]) -> Vec<[f64; 2]> {
    let mut found: Vec<[f64; 2]> = Vec::new();
    for &slot in present {
        if let Some(flask) = state.flask_of(slot) {
            let temperature = f64::from(state.heat[slot][0]);
            let flasks = found.len().max(flask + 1);
            found.resize(flasks, [f64::INFINITY, f64::NEG_INFINITY]);
            let [least, most] = found[flask];
            found[flask] = [least.min(temperature), most.max(temperature)];
        }
    }
    found
}

/// Mean, standard deviation and extremes of values with weights; all zero without values.
#[derive(Clone, Copy, Default)]
struct Spread {
    mean: f64,
    deviation: f64,
    min: f64,
    max: f64,
}

impl Spread {
    fn of(values: impl Iterator<Item = (f64, f64)> + Clone) -> Self {
        let weight: f64 = values.clone().map(|(weight, _)| weight).sum();
        if weight <= 0.0 {
            return Self::default();
        }
        let mean = values.clone().map(|(w, value)| w * value).sum::<f64>() / weight;
        let square = |(w, value): (f64, f64)| w * (value - mean).powi(2);
        let extreme = |start: f64, pick: fn(f64, f64) -> f64| {
            values.clone().map(|(_, value)| value).fold(start, pick)
        };
        Self {
            mean,
            deviation: (values.clone().map(square).sum::<f64>() / weight).sqrt(),
            min: extreme(f64::INFINITY, f64::min),
            max: extreme(f64::NEG_INFINITY, f64::max),
        }
    }
}

/// `None` where nothing boils.
fn superheat(chemistry: &Chemistry, state: &SolverState, present: &[usize]) -> Option<Superheat> {
    let point: Box<dyn Fn(usize) -> f64> = match chemistry {
        Chemistry::Paper(paper) => {
            let boiling_point = paper.boiling?.boiling_point;
            Box::new(move |_| boiling_point)
        }
        Chemistry::Physical(physical) => {
            let table = SolutionTable::fed_by(physical.feed);
            // A particle's acid fraction there is that of its liquid, of which the most watery part boils.
            Box::new(move |slot| {
                let variance = state.eddies[slot][1].into();
                table
                    .of_lamellae(state.heat[slot][1].into(), variance)
                    .boiling_point
            })
        }
    };
    let mut found: Option<Superheat> = None;
    for &slot in present {
        let superheat = f64::from(state.heat[slot][0]) - point(slot);
        let so_far = found.get_or_insert(Superheat {
            max: superheat,
            particles: 0,
            in_flasks: Vec::new(),
        });
        so_far.max = so_far.max.max(superheat);
        if superheat > 0.0 {
            so_far.particles += 1;
            if let Some(flask) = state.flask_of(slot) {
                let flasks = so_far.in_flasks.len().max(flask + 1);
                so_far.in_flasks.resize(flasks, 0);
                so_far.in_flasks[flask] += 1;
            }
        }
    }
    found
}

fn ledger(state: &SolverState, present: &[usize], particle_mass: f64) -> Option<Ledger> {
    if state.matter.is_empty() {
        return None;
    }
    let mut sum = Ledger::default();
    for &slot in present {
        let [acid, enthalpy, vapour, mass] = state.matter[slot].map(f64::from);
        sum.mass += mass;
        sum.acid += mass * acid;
        sum.vapour += mass * vapour;
        sum.held += mass * enthalpy;
        sum.turnover += mass * enthalpy.abs();
    }
    for slot in (0..state.matter.len()).filter(|&slot| !state.is_present(slot)) {
        let [_, enthalpy, _, mass] = state.matter[slot].map(f64::from);
        // Of one that turned non-finite that may not be known.
        if (mass * enthalpy).is_finite() {
            sum.taken_out += mass;
            sum.taken_out_enthalpy += mass * enthalpy;
        }
    }
    // Also of particles that were taken out: their exchange until then counts.
    for &entry in &state.ledger {
        let [exchanged, steam, steam_enthalpy, _] = entry.map(f64::from);
        sum.exchanged += exchanged;
        sum.steam += steam;
        sum.steam_enthalpy += steam_enthalpy;
    }
    let bubbles = state.vapour();
    sum.mass += bubbles.held[0] + bubbles.pending[0];
    sum.vapour += bubbles.held[0];
    sum.held += bubbles.held[1] + bubbles.pending[1];
    sum.steam += bubbles.gone[0];
    sum.steam_enthalpy += bubbles.gone[1];
    sum.air = AIR_OVER_STEAM * (bubbles.air[0] + bubbles.air[1]);
    sum.air_held = AIR_OVER_STEAM * bubbles.air[0];
    for bubble in state
        .bubbles()
        .iter()
        .filter(|b| b.mass > 0.0 || b.air > 0.0)
    {
        let volume = 4.0 / 3.0 * PI * f64::from(bubble.radius).powi(3);
        sum.gas += volume;
        if bubble.surfaced > 0.0 {
            sum.foam += volume;
        }
    }
    let drops = state.sprayed();
    for part in [drops.flying, drops.fallen, drops.pending] {
        sum.mass += part[0];
        sum.acid += part[1];
        sum.held += part[2];
    }
    sum.spray = drops.flying[0];
    sum.spray_fallen = drops.fallen[0];
    let m = particle_mass;
    Some(Ledger {
        mass: m * sum.mass,
        acid: m * sum.acid,
        vapour: m * sum.vapour,
        taken_out: m * sum.taken_out,
        taken_out_enthalpy: m * sum.taken_out_enthalpy,
        spray: m * sum.spray,
        spray_fallen: m * sum.spray_fallen,
        air: m * sum.air,
        air_held: m * sum.air_held,
        gas: sum.gas,
        foam: sum.foam,
        held: m * sum.held,
        exchanged: m * sum.exchanged,
        steam: m * sum.steam,
        mist: state.mist(),
        dew: state.dew_mass(),
        steam_enthalpy: m * sum.steam_enthalpy,
        turnover: m * sum.turnover,
    })
}
