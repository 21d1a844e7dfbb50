//! Water that leaves a free surface below its boiling point.
//!
//! Vapour diffuses out of the air's boundary layer against still room air,
//! which natural convection of the warm, moist air renews. As the air does not
//! enter the liquid, the vapour has to carry itself too (Stefan 1873). The
//! liquid below has a boundary layer of its own: near 90 °C its surface is
//! some 8 K colder than what lies under it, and without that twice as much
//! water would leave as was measured.

use super::constants::{ABSOLUTE_ZERO, GAS_CONSTANT, WATER_MOLAR_MASS};
use super::physical::Steam;
use super::puff::{AIR_CONSTANT, HUMIDITY, PRESSURE, VAPOUR_CONSTANT};
use super::table::{Row, SolutionTable, steam_enthalpy};
use super::transport::Potential;

/// Sh/(Gr Sc)^⅓ of turbulent natural convection over a level surface that
/// faces up (McAdams 1954, by the analogy of heat and mass).
const SHERWOOD: f64 = 0.14;

/// Diffusivity of vapour in air, m²/s K^-2.072, times K^2.072 (Marrero &
/// Mason 1972).
const DIFFUSIVITY: (f64, f64) = (1.87e-10, 2.072);

/// Kinematic viscosity of air at 20 °C (m²/s) and its exponent in kelvin
/// (Incropera, table A.4, 300 to 400 K).
const AIR_VISCOSITY: (f64, f64) = (1.51e-5, 1.75);

/// Heat that natural convection in the liquid brings to its surface, over
/// ΔT^4/3, W/(m² K^4/3): Nu = 0.15 Ra^⅓ (Incropera, Eq. 9.31) with the
/// properties of water at 80 °C. Water at 40 °C has 0.7 times that.
const SKIN: f64 = 480.0;

/// Newton's steps for the surface's temperature; they leave 0.1 K.
const SKIN_STEPS: u32 = 4;

/// d ln(flux)/dT that Newton's iteration takes, 1/K: that of water at 80 °C.
const FLUX_SLOPE: f64 = 0.06;

/// Most of the room's pressure that vapour has at the surface. At the boiling
/// point the flux has no bound; bubbles take over there.
const MOST_PRESSURE: f64 = 0.98;

/// The room's gravity, m/s².
const GRAVITY: f64 = 9.81;

/// Still air over a liquid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StillAir {
    /// Its temperature, K.
    kelvin: f64,
    /// Pressure of its vapour, Pa.
    vapour: f64,
}

impl StillAir {
    /// Air of `ambient` °C at [`HUMIDITY`].
    pub fn at(table: &SolutionTable, ambient: f64) -> Self {
        Self {
            kelvin: ambient - ABSOLUTE_ZERO,
            vapour: HUMIDITY * vapour_pressure(&table.at(0.0), ambient),
        }
    }

    /// Pressure of its vapour, Pa.
    pub fn vapour(&self) -> f64 {
        self.vapour
    }

    /// Water that leaves a surface of the liquid `row` at `surface` °C, kg/(m² s); none at or below the
    /// air's temperature, where no convection renews the air (0.05 kg/(m² h) in a room of 20 °C).
    pub fn flux_from_surface(&self, row: &Row, surface: f64) -> f64 {
        let kelvin = surface - ABSOLUTE_ZERO;
        let pressure = vapour_pressure(row, surface).min(MOST_PRESSURE * PRESSURE);
        if kelvin <= self.kelvin || pressure <= self.vapour {
            return 0.0;
        }
        let film = 0.5 * (kelvin + self.kelvin);
        let (here, around) = (density(kelvin, pressure), density(self.kelvin, self.vapour));
        let diffusivity = DIFFUSIVITY.0 * film.powf(DIFFUSIVITY.1);
        let viscosity = AIR_VISCOSITY.0 * (film / 293.15).powf(AIR_VISCOSITY.1);
        let lift = GRAVITY * (around - here).max(0.0) / (0.5 * (around + here));
        let transfer = SHERWOOD * diffusivity * (lift / (viscosity * diffusivity)).cbrt();
        let stefan = ((PRESSURE - self.vapour) / (PRESSURE - pressure)).ln();
        transfer * PRESSURE / (VAPOUR_CONSTANT * film) * stefan
    }

    /// Water that leaves the liquid `row` of `temperature` (°C), kg/(m² s), by the temperature at which its
    /// surface gets as much heat from below as the vapour takes.
    pub fn flux(&self, row: &Row, temperature: f64) -> f64 {
        // None is left of it above 1,000 °C.
        let latent = row.latent_heat(temperature).max(0.0);
        let mut colder = 0.0;
        let mut flux = self.flux_from_surface(row, temperature);
        for _ in 0..SKIN_STEPS {
            let wanted = (latent * flux / SKIN).powf(0.75);
            colder -= (colder - wanted) / (1.0 + 0.75 * FLUX_SLOPE * wanted);
            flux = self.flux_from_surface(row, temperature - colder);
        }
        flux
    }

    /// Water that leaves the liquid of `particle`, kg/(m² s). Unmixed lamellae all reach the surface: their water and their acid each
    /// have their share of the volume of it.
    pub fn flux_of_lamellae(&self, table: &SolutionTable, particle: &Potential) -> f64 {
        let temperature = particle.temperature;
        table
            .shown_of_lamellae(particle.acid, particle.variance, temperature)
            .iter()
            .filter(|(_, share)| *share > 0.0)
            .map(|(row, share)| share * self.flux(row, temperature))
            .sum()
    }
}

/// Most of a particle's water that evaporates in a substep: no film of it is dry before bubbles or
/// neighbours have had their share.
const MOST_EVAPORATED: f64 = 0.01;

/// Steam, mass (kg) and enthalpy (J), that a particle with the free surface `area` (m²) gives off to `air` in `time` seconds.
pub fn evaporated(
    table: &SolutionTable,
    air: &StillAir,
    particle: &Potential,
    area: f64,
    time: f64,
) -> Steam {
    if area <= 0.0 {
        return Steam::default();
    }
    let flux = air.flux_of_lamellae(table, particle);
    let most = MOST_EVAPORATED * (1.0 - particle.acid) * particle.mass;
    let mass = (flux * area * time).min(most);
    Steam {
        mass,
        enthalpy: mass * steam_enthalpy(particle.temperature),
    }
}

/// p of water over the liquid `row` at `temperature` (°C), Pa: one atmosphere at its boiling point, and
/// from there by Clausius and Clapeyron with the latent heat between the two.
pub fn vapour_pressure(row: &Row, temperature: f64) -> f64 {
    let latent = row.latent_heat(0.5 * (temperature + row.boiling_point));
    let inverse = |celsius: f64| 1.0 / (celsius - ABSOLUTE_ZERO);
    let kelvins = inverse(temperature) - inverse(row.boiling_point);
    PRESSURE * (-latent * WATER_MOLAR_MASS / GAS_CONSTANT * kelvins).exp()
}

/// Density of moist air, kg/m³.
fn density(kelvin: f64, vapour: f64) -> f64 {
    ((PRESSURE - vapour) / AIR_CONSTANT + vapour / VAPOUR_CONSTANT) / kelvin
}
