//! Exchange of acid and enthalpy between particles, and heat that leaves.

use super::exchange::Exchange;
use super::physical::Content;
use super::table::SolutionTable;

/// How liquids mix below the size of a particle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mixing {
    /// C_t: diffusivity over h·|v_ij|.
    pub turbulence: f64,
    /// Le = D_T/D_c of that mixing, at most 1.
    pub lewis: f64,
}

impl Default for Mixing {
    /// Smagorinsky's eddy viscosity (0.17·h)²·|S| (Lilly 1967) with
    /// |S| = |v_ij|/h, over a turbulent Schmidt number of 0.7; Le = 0.7.
    fn default() -> Self {
        Self {
            turbulence: 0.041,
            lewis: 0.7,
        }
    }
}

/// Diffusivity of sulfuric acid in water, m²/s (25 °C, CRC Handbook).
pub const ACID_DIFFUSIVITY: f64 = 1.7e-9;

/// Thermal diffusivity of water, m²/s (20 °C); 98 % acid has 1.3e-7.
pub const THERMAL_DIFFUSIVITY: f64 = 1.4e-7;

impl Mixing {
    /// (D_T, D_c), m²/s, of a pair with the relative speed `speed` (m/s) for
    /// the support radius `support` (m).
    ///
    /// Le ≤ 1 is that of the eddies alone, which carry both alike: in still
    /// liquid heat is a hundred times faster than acid.
    pub fn diffusivities(&self, support: f64, speed: f64) -> (f64, f64) {
        let eddies = self.turbulence * support * speed;
        (
            THERMAL_DIFFUSIVITY + self.lewis * eddies,
            ACID_DIFFUSIVITY + eddies,
        )
    }
}

/// What the exchange needs to know of a particle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Potential {
    /// Mass of its liquid, kg.
    pub mass: f64,
    /// Acid fraction of its liquid.
    pub acid: f64,
    /// T, °C.
    pub temperature: f64,
    /// ∂h/∂c at T, J/kg.
    pub slope: f64,
    /// Heat capacity of its liquid, J/K.
    pub capacity: f64,
}

impl Potential {
    /// That of `content`.
    pub fn of(table: &SolutionTable, content: &Content) -> Self {
        let row = content.liquid_row(table);
        let temperature = row.temperature_with_steam(content.enthalpy, content.vapour);
        let mass = content.liquid_mass();
        Self {
            mass,
            acid: row.acid,
            temperature,
            slope: row.slope_at(temperature),
            capacity: mass * row.capacity_at(temperature),
        }
    }
}

/// What a particle gets in a substep.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Flux {
    /// Acid, kg; as much water goes the other way.
    pub acid: f64,
    /// Enthalpy, J.
    pub enthalpy: f64,
}

/// What i gets from j at `distance` (m) in a substep; j gets the opposite,
/// bit for bit.
///
/// Acid carries ∂h/∂c, the difference of the partial enthalpies of the two
/// components, as the mean of both particles' own; so mixing neither makes
/// nor loses enthalpy, and the heat of mixing appears as the temperature that
/// the tables give to the same enthalpy at another composition. Masses and
/// heat capacities enter by their harmonic mean. The limit of [`Exchange`]
/// is taken on the smaller of the two, for which it is a share.
pub fn flux(
    exchange: &Exchange,
    (temperature_diffusivity, acid_diffusivity): (f64, f64),
    distance: f64,
    i: &Potential,
    j: &Potential,
) -> Flux {
    let of_acid = conductance(exchange, acid_diffusivity, distance, i.mass, j.mass);
    let of_heat = conductance(
        exchange,
        temperature_diffusivity,
        distance,
        i.capacity,
        j.capacity,
    );
    let acid = of_acid * (j.acid - i.acid);
    Flux {
        acid,
        enthalpy: acid * 0.5 * (i.slope + j.slope) + of_heat * (j.temperature - i.temperature),
    }
}

/// A pair's share of what the two can hold, `a` and `b`.
fn conductance(exchange: &Exchange, diffusivity: f64, distance: f64, a: f64, b: f64) -> f64 {
    // a·b first: the same bits whichever of the two comes first.
    let wanted = exchange.unlimited(diffusivity, distance) * (2.0 * (a * b) / (a + b));
    wanted.min(exchange.limit() * a.min(b))
}

/// Heat loss through a boundary at ambient temperature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Losses {
    /// Ambient temperature T_a, °C.
    pub ambient: f64,
    /// Through glass, W/(m² K).
    pub glass: f64,
    /// From the free surface, W/(m² K).
    pub surface: f64,
}

/// Natural convection of air and radiation around a vessel that is warm to
/// the hand, W/(m² K) (Incropera: 2 to 25 for convection, 6 for radiation at
/// 50 °C); 2 mm of glass have 500 and add nothing.
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

    /// Enthalpy that a particle gets from around it in `time` seconds, J,
    /// where `glass` and `surface` are its areas (m², see [`contact_area`]).
    ///
    /// By the exponential of its own decay, so that no time is too long.
    pub fn gain(&self, particle: &Potential, glass: f64, surface: f64, time: f64) -> f64 {
        let rate = (self.glass * glass + self.surface * surface) / particle.capacity;
        particle.capacity * (particle.temperature - self.ambient) * (-rate * time).exp_m1()
    }
}

/// Area of a boundary that belongs to a particle of volume `volume` (m³),
/// m², where `gradient` (1/m) is that of the boundary's part of the density
/// sum: |∇V_b| for glass, |Σ_j V₀∇W_ij + ∇V_b| for the free surface.
///
/// Over the depth of a plane boundary ∫|∇V| ds = V(0) = ½, so the areas of
/// all its particles sum to its own.
pub fn contact_area(volume: f64, gradient: f64) -> f64 {
    2.0 * volume * gradient
}

impl std::iter::Sum for Flux {
    fn sum<I: Iterator<Item = Self>>(fluxes: I) -> Self {
        fluxes.fold(Self::default(), |a, b| Self {
            acid: a.acid + b.acid,
            enthalpy: a.enthalpy + b.enthalpy,
        })
    }
}
