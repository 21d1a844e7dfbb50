//! Exchange of acid and enthalpy between particles, and heat that leaves.

use super::constants::{ACID_DIFFUSIVITY, THERMAL_DIFFUSIVITY};
use super::exchange::Exchange;
use super::physical::Content;
use super::table::{SolutionTable, steam_enthalpy};

/// Diffusivities of acid and heat between two particles, m²/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Diffusivities {
    /// Eddies, which carry liquid: its acid and its enthalpy alike.
    pub eddies: f64,
    /// Molecular, of acid.
    pub acid: f64,
    /// Molecular, of heat.
    pub heat: f64,
}

impl Diffusivities {
    /// Molecules, and eddies of the diffusivity `eddies` (m²/s).
    pub fn with(eddies: f64) -> Self {
        Self {
            eddies,
            acid: ACID_DIFFUSIVITY,
            heat: THERMAL_DIFFUSIVITY,
        }
    }
}

/// Properties of a particle that the exchange reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Potential {
    /// Mass of its liquid, kg.
    pub mass: f64,
    /// Acid fraction of its liquid.
    pub acid: f64,
    /// T, °C.
    pub temperature: f64,
    /// h of its liquid, without the vapour's, J/kg.
    pub enthalpy: f64,
    /// Specific heat capacity of its liquid at T, J/(kg K).
    pub capacity: f64,
    /// s²: variance of the acid fraction within its liquid.
    pub variance: f64,
}

impl Potential {
    /// Properties of `content`.
    pub fn of(table: &SolutionTable, content: &Content) -> Self {
        let row = content.liquid_row(table);
        let temperature = row.temperature_with_steam(content.enthalpy, content.vapour);
        let steam = content.vapour * steam_enthalpy(temperature);
        Self {
            mass: content.liquid_mass(),
            acid: row.acid,
            temperature,
            enthalpy: (content.enthalpy - steam) / (1.0 - content.vapour),
            capacity: row.capacity_at(temperature),
            variance: content.variance,
        }
    }

    /// Heat capacity of its liquid, J/K.
    pub fn heat_capacity(&self) -> f64 {
        self.mass * self.capacity
    }
}

/// Acid, enthalpy and variance that a particle gets in a substep.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Flux {
    /// Acid, kg; as much water goes the other way.
    pub acid: f64,
    /// Enthalpy, J.
    pub enthalpy: f64,
    /// Σ (c − c_i)² of the incoming liquid less that of the outgoing, kg. The parts of i and j are not
    /// opposite: liquid that eddies bring arrives unmixed.
    pub variance: f64,
}

/// Share of all that i has, of liquid or of heat, which it would swap with j at `distance` (m) in a substep.
///
/// Summed over its neighbours that is its turnover. Up to 1 its new state is a mean of old ones.
pub fn turnover(
    exchange: &Exchange,
    diffusivities: &Diffusivities,
    distance: f64,
    i: &Potential,
    j: &Potential,
) -> f64 {
    let fastest = diffusivities.eddies + diffusivities.heat.max(diffusivities.acid);
    let swapped = Swapped::by(exchange, distance, i, j);
    fastest * (swapped.liquid / i.mass).max(swapped.heat / i.heat_capacity())
}

/// Share of its exchange that a pair of these turnovers keeps: all of it unless either is above 1. Both particles have the same
/// share, so that one gains as much as the other loses.
pub fn kept(own: f64, other: f64) -> f64 {
    1.0 / own.max(other).max(1.0)
}

/// Conductances of a pair over a substep: exchange per diffusivity.
struct Swapped {
    /// kg·s/m².
    liquid: f64,
    /// J·s/(K m²).
    heat: f64,
}

impl Swapped {
    /// Masses and heat capacities enter by their harmonic mean.
    fn by(exchange: &Exchange, distance: f64, i: &Potential, j: &Potential) -> Self {
        let per_diffusivity = exchange.unlimited(1.0, distance);
        Self {
            liquid: per_diffusivity * harmonic(i.mass, j.mass),
            heat: per_diffusivity * harmonic(i.heat_capacity(), j.heat_capacity()),
        }
    }
}

/// Gain of i from j at `distance` (m) in a substep, of whose exchange they
/// keep the share [`kept`]; j gets the opposite, bit for bit.
///
/// Eddies carry liquid: with K·(c_j − c_i) of acid comes K·(h_j − h_i) of
/// enthalpy, so a mixture stays on the straight line between what it was made
/// of, and its heat of mixing is the temperature that the tables give there.
/// Molecules carry acid and heat apart. Acid by itself brings the chord
/// h(c_j, T̄) − h(c_i, T̄), which is (h_j − h_i) less ½(cp_i + cp_j)·(T_j − T_i),
/// and heat is conducted by T. The mean of both particles' ∂h/∂c is not the
/// chord: across a fresh contact of water and acid it is +540 kJ/kg for −26,
/// at any resolution.
///
/// A limit cuts all parts by the same share: else a limited mixture would leave its line.
pub fn flux(
    exchange: &Exchange,
    diffusivities: &Diffusivities,
    distance: f64,
    i: &Potential,
    j: &Potential,
    kept: f64,
) -> Flux {
    let Diffusivities { eddies, acid, heat } = *diffusivities;
    let swapped = Swapped::by(exchange, distance, i, j);
    let carried = kept * (eddies + acid) * swapped.liquid;
    let brought = acid * swapped.liquid * 0.5 * (i.capacity + j.capacity);
    let conducted = kept * (heat * swapped.heat - brought);
    Flux {
        acid: carried * (j.acid - i.acid),
        enthalpy: carried * (j.enthalpy - i.enthalpy) + conducted * (j.temperature - i.temperature),
        variance: kept
            * eddies
            * swapped.liquid
            * (j.variance - i.variance + (j.acid - i.acid).powi(2)),
    }
}

/// Of a·b first: the same bits whichever of the two comes first.
fn harmonic(a: f64, b: f64) -> f64 {
    2.0 * (a * b) / (a + b)
}

/// Heat loss through a boundary at ambient temperature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Losses {
    /// Ambient temperature T_a, °C.
    pub ambient: f64,
    /// From glass to the air, W/(m² K).
    pub glass: f64,
    /// From the free surface, W/(m² K).
    pub surface: f64,
}

/// Natural convection of air and radiation around a vessel that is warm to
/// the hand, W/(m² K) (Incropera: 2 to 25 for convection, 6 for radiation at
/// 50 °C).
pub const AIR_TRANSFER: f64 = 12.0;

impl Losses {
    /// Losses to still air of `ambient` °C.
    pub fn to_air(ambient: f64) -> Self {
        Self {
            ambient,
            glass: AIR_TRANSFER,
            surface: AIR_TRANSFER,
        }
    }
}

/// Heat that a particle gets in `time` seconds from surroundings at `around` °C
/// through `conductance` (W/K), J.
///
/// By the exponential of its own decay, so that no time is too long.
pub fn heat_from(particle: &Potential, around: f64, conductance: f64, time: f64) -> f64 {
    let capacity = particle.heat_capacity();
    let rate = conductance / capacity;
    capacity * (particle.temperature - around) * (-rate * time).exp_m1()
}

/// Area of a boundary that belongs to a particle of volume `volume` (m³),
/// m², where `gradient` (1/m) is that of the boundary's part of the density
/// sum, |∇V_b| for glass.
///
/// Over the depth of a plane boundary ∫|∇V| ds = V(0) = ½, so the areas of
/// all its particles sum to its own.
pub fn contact_area(volume: f64, gradient: f64) -> f64 {
    2.0 * volume * gradient
}

/// Area of the free surface that belongs to a particle of volume `volume`
/// (m³), m², where `gradient` (1/m) is |Σ_j V₀∇W_ij + ∇V_b|.
///
/// That is [`contact_area`] at a surface, about d² a particle, and not zero
/// inside: 0.02 d² in liquid at rest, along glass too, and 0.2 d² of a lattice
/// shaken by a tenth of its spacing. So what is below 0.3 d² is none, and from
/// 0.5 d² on all is.
pub fn surface_area(volume: f64, gradient: f64) -> f64 {
    let area = contact_area(volume, gradient);
    let share = (area / volume.powf(2.0 / 3.0) - INSIDE) / (SURFACE - INSIDE);
    let t = share.clamp(0.0, 1.0);
    area * t * t * (3.0 - 2.0 * t)
}

/// Area over d² that disorder makes of a particle inside, and what one at a surface has at least.
const INSIDE: f64 = 0.3;
const SURFACE: f64 = 0.5;

impl std::iter::Sum for Flux {
    fn sum<I: Iterator<Item = Self>>(fluxes: I) -> Self {
        fluxes.fold(Self::default(), |a, b| Self {
            acid: a.acid + b.acid,
            enthalpy: a.enthalpy + b.enthalpy,
            variance: a.variance + b.variance,
        })
    }
}
