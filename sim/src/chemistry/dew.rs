//! Water that condenses on a vessel's inner wall from the steam over its liquid, and evaporates again.
//!
//! Vapour diffuses to a wall below its dew point, against the air that it leaves behind (Stefan 1873), and warms
//! the wall by its latent heat; in the room's air it goes the other way. The wall's glass has one temperature through its
//! thickness. What gas gives it without condensing, about a seventh of the latent heat here, does not count, and no drop
//! runs down.

use super::constants::ABSOLUTE_ZERO;
use super::puff::{
    AIR_CONSTANT, PRESSURE, Room, VAPORISATION, VAPOUR_CAPACITY, VAPOUR_CONSTANT, WATER_CAPACITY,
    saturation_pressure,
};
use super::wall_heat::CAPACITY;
use crate::flask::Profile;
use crate::flask::glassware::BOROSILICATE;
use std::f64::consts::TAU;

/// Places around a wall.
pub const AROUND: usize = 32;

/// Places from the inner floor up to the rim.
pub const UP: usize = 16;

/// Least water that the device counts, kg.
pub const QUANTUM: f64 = 1e-14;

/// Heat transfer from a wall to still air by convection alone, W/(m² K) (Incropera: 2 to 25).
const CONVECTION: f64 = 6.0;

/// Density (kg/m³) and specific heat capacity (J/(kg K)) of air at 20 °C (Incropera, table A.4).
const AIR: [f64; 2] = [1.20, 1006.0];

/// Le of vapour in air, thermal diffusivity over diffusivity, at 20 °C (Incropera, tables A.4 and A.8).
const LEWIS: f64 = 0.85;

/// Diffusivity of vapour in air and kinematic viscosity of air at 47 °C, m²/s: half way between a puff and a wall
/// (Marrero & Mason 1972; Incropera, table A.4).
const AT_FILM: [f64; 2] = [2.90e-5, 1.76e-5];

/// Sh/(Re^½ Sc^⅓) of a plate in laminar flow, on the mean over its length (Pohlhausen 1921; Incropera, Eq. 7.31).
const PLATE: f64 = 0.664;

/// Most of the room's pressure that vapour has: near the boiling point the flux has no bound.
const MOST_PRESSURE: f64 = 0.98;

/// Mass transfer from a wall to the room's still air, m/s: that of heat, by Lewis' relation (Chilton & Colburn 1934).
pub fn still() -> f64 {
    CONVECTION / (AIR[0] * AIR[1] * LEWIS.powf(2.0 / 3.0))
}

/// Mass transfer to a puff over √(speed / width), m/√s.
pub fn swept() -> f64 {
    let [diffusivity, viscosity] = AT_FILM;
    PLATE * diffusivity * viscosity.powf(-0.5) * (viscosity / diffusivity).cbrt()
}

/// Heat that water evolves where it condenses, J/kg: at the room's temperature (°C), so that the same comes as goes.
/// At 60 °C it is 4 % less.
pub fn latent_heat(ambient: f64) -> f64 {
    VAPORISATION + (VAPOUR_CAPACITY - WATER_CAPACITY) * ambient
}

/// Pressure of the vapour in a room's air, Pa.
pub fn vapour_of(room: &Room) -> f64 {
    PRESSURE * room.humidity / (AIR_CONSTANT / VAPOUR_CONSTANT + room.humidity)
}

/// The air at a place of a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Air {
    /// Temperature, °C: of a puff its dew point.
    pub temperature: f64,
    /// Pressure of its vapour, Pa.
    pub vapour: f64,
    /// Mass transfer to it, m/s.
    pub transfer: f64,
}

/// Water that leaves a wall of `wall` °C, kg/(m² s); negative where it condenses.
pub fn flux(wall: f64, air: &Air) -> f64 {
    let most = MOST_PRESSURE * PRESSURE;
    let (here, there) = (saturation_pressure(wall).min(most), air.vapour.min(most));
    let film = 0.5 * (wall + air.temperature) - ABSOLUTE_ZERO;
    let stefan = ((PRESSURE - there) / (PRESSURE - here)).ln();
    air.transfer * PRESSURE / (VAPOUR_CONSTANT * film) * stefan
}

/// The places of one height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallRow {
    /// Height of their middles in the flask's frame, m.
    pub height: f64,
    /// Radius of the wall there, m.
    pub radius: f64,
    /// Area of each, m².
    pub area: f64,
    /// Heat capacity of the wall, J/(m² K).
    pub capacity: f64,
}

/// A flask's rows, from the inner floor up.
pub fn rows(profile: &Profile) -> Vec<WallRow> {
    let (floor, rim) = (profile.floor_height(), profile.rim_height());
    let step = (rim - floor) / UP as f64;
    let row = |j: usize| {
        let height = floor + (j as f64 + 0.5) * step;
        // A vessel's radius at its very floor may be a corner's.
        let [low, high] = [-0.5, 0.5].map(|way| profile.inner_radius(height + 0.999 * way * step));
        let slant = (high - low).hypot(step);
        let radius = profile.inner_radius(height);
        WallRow {
            height,
            radius,
            area: TAU * radius * slant / AROUND as f64,
            capacity: BOROSILICATE * CAPACITY * profile.wall(),
        }
    };
    (0..UP).map(row).collect()
}
