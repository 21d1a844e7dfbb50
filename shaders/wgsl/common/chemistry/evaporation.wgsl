// Water that leaves a free surface below its boiling point: `chemistry/evaporation.rs` in f32.
//!include common/chemistry/solution.wgsl

/// T of what is around, °C, and the pressure of the vapour in its air, Pa.
override AMBIENT: f32 = 20.0;
override AIR_VAPOUR: f32 = 0.0;

const PRESSURE: f32 = 101325.0;
/// M/R of water, kg K/J.
const WATER_OVER_GAS: f32 = 0.018015 / 8.314463;
/// Gas constants of dry air and of vapour, J/(kg K).
const AIR_GAS: f32 = 287.05;
const VAPOUR_GAS: f32 = 461.5;
const SHERWOOD: f32 = 0.14;
const SKIN: f32 = 480.0;
const SKIN_STEPS: u32 = 4u;
const FLUX_SLOPE: f32 = 0.06;
const MOST_PRESSURE: f32 = 0.98;
const STANDARD_GRAVITY: f32 = 9.81;

/// Enthalpy that it takes to evaporate water from the liquid at a temperature, J/kg.
fn latent_heat(row: Row, temperature: f32) -> f32 {
    return steam_enthalpy(temperature) - enthalpy_at(row, temperature) + row.acid * slope_at(row, temperature);
}

/// p of water over the liquid, Pa.
fn vapour_pressure(row: Row, temperature: f32) -> f32 {
    let latent = latent_heat(row, 0.5 * (temperature + row.value.boiling_point));
    let here = temperature - ABSOLUTE_ZERO;
    let boiling = row.value.boiling_point - ABSOLUTE_ZERO;
    return PRESSURE * exp(latent * WATER_OVER_GAS * (temperature - row.value.boiling_point) / (here * boiling));
}

/// Density of moist air, kg/m³.
fn air_density(kelvin: f32, vapour: f32) -> f32 {
    return ((PRESSURE - vapour) / AIR_GAS + vapour / VAPOUR_GAS) / kelvin;
}

/// kg/(m² s) from a surface of that temperature.
fn flux_from_surface(row: Row, surface: f32) -> f32 {
    let pressure = min(vapour_pressure(row, surface), MOST_PRESSURE * PRESSURE);
    if (surface <= AMBIENT || pressure <= AIR_VAPOUR) { return 0.0; }
    let kelvin = surface - ABSOLUTE_ZERO;
    let room = AMBIENT - ABSOLUTE_ZERO;
    let film = 0.5 * (kelvin + room);
    let here = air_density(kelvin, pressure);
    let around = air_density(room, AIR_VAPOUR);
    let diffusivity = 1.87e-10 * pow(film, 2.072);
    let viscosity = 1.51e-5 * pow(film / 293.15, 1.75);
    let lift = STANDARD_GRAVITY * max(around - here, 0.0) / (0.5 * (around + here));
    let transfer = SHERWOOD * diffusivity * pow(lift / (viscosity * diffusivity), 1.0 / 3.0);
    return transfer * PRESSURE / (VAPOUR_GAS * film) * log((PRESSURE - AIR_VAPOUR) / (PRESSURE - pressure));
}

/// kg/(m² s) from a liquid of that temperature, whose surface is colder.
fn evaporation_flux(row: Row, temperature: f32) -> f32 {
    // None is left of it above 1,000 °C.
    let latent = max(latent_heat(row, temperature), 0.0);
    var colder = 0.0;
    var flux = flux_from_surface(row, temperature);
    for (var step = 0u; step < SKIN_STEPS; step++) {
        let wanted = pow(latent * flux / SKIN, 0.75);
        colder -= (colder - wanted) / (1.0 + 0.75 * FLUX_SLOPE * wanted);
        flux = flux_from_surface(row, temperature - colder);
    }
    return flux;
}
