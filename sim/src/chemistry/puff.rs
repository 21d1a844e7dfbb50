//! Steam in the room's air.
//!
//! Steam leaves the liquid in puffs. Each is a thermal: it rises by its
//! buoyancy, and its surface takes in air at a speed proportional to its own
//! (Morton, Taylor & Turner 1956). The air cools it below its dew point, and
//! the water that condenses then is the visible mist (steam itself is invisible);
//! further up the puff is so thin that the droplets evaporate again.
//!
//! Glass does not act on a puff: inside a vessel it takes in room air, and
//! its sides may reach through a wall. Water that condenses on the wall leaves it (`dew.rs`). It takes
//! nothing from the liquid, whose ledger counts the steam when it leaves.

use super::constants::ABSOLUTE_ZERO;
use super::table::{STEAM_CAPACITY, steam_enthalpy};
use std::f64::consts::PI;

/// Entrainment coefficient α of a thermal: share of its speed at which its
/// surface takes in air (Turner 1963: 0.25 ± 0.1 in experiments).
pub const ENTRAINMENT: f64 = 0.25;

/// Mass of air that is moved along, over that displaced: a sphere's.
pub const VIRTUAL_MASS: f64 = 0.5;

/// Pressure of the room, Pa.
pub const PRESSURE: f64 = 101_325.0;

/// Gas constants of dry air and of water vapour, J/(kg K).
pub const AIR_CONSTANT: f64 = 287.05;
/// See [`AIR_CONSTANT`].
pub const VAPOUR_CONSTANT: f64 = 461.5;

/// Heat capacities of dry air, water vapour and water, J/(kg K) (ASHRAE
/// Handbook of Fundamentals 2017, chapter 1: 1.006, 1.86 and 4.186 kJ).
pub const AIR_CAPACITY: f64 = 1006.0;
/// See [`AIR_CAPACITY`].
pub const VAPOUR_CAPACITY: f64 = 1860.0;
/// See [`AIR_CAPACITY`].
pub const WATER_CAPACITY: f64 = 4186.0;

/// Enthalpy of vapour at 0 °C over that of water there, J/kg (the same).
pub const VAPORISATION: f64 = 2.501e6;

/// Relative humidity of the room.
pub const HUMIDITY: f64 = 0.5;

/// Radius of mist's droplets, m: the mode of steam fog and of the mist over
/// a cup is 4 to 6 µm.
pub const DROPLET_RADIUS: f64 = 5e-6;

/// Dry air over steam in a puff that begins.
pub const FIRST_AIR: f64 = 0.1;

/// Density of the droplets, kg/m³.
const WATER_DENSITY: f64 = 1000.0;

/// Newton's steps for the temperature of a saturated puff.
const NEWTON_STEPS: u32 = 5;

/// Magnus' form: Pa, 1, °C.
const MAGNUS: [f64; 3] = [610.94, 17.625, 243.04];

/// e_s, Pa, over water at `t` °C: Magnus' form with the coefficients of
/// Alduchov & Eskridge (1996), within 0.4 % from −40 to 50 °C, and 3 % above
/// at 100 °C.
pub fn saturation_pressure(t: f64) -> f64 {
    MAGNUS[0] * (MAGNUS[1] * t / (t + MAGNUS[2])).exp()
}

/// Temperature at which `ratio` of vapour over dry air is saturated, °C.
pub fn dew_point(ratio: f64) -> f64 {
    let pressure = PRESSURE * ratio / (AIR_CONSTANT / VAPOUR_CONSTANT + ratio);
    let log = (pressure / MAGNUS[0]).ln();
    MAGNUS[2] * log / (MAGNUS[1] - log)
}

/// Vapour over dry air (kg/kg) when saturated at `t` °C; infinite where water boils.
pub fn saturation_ratio(t: f64) -> f64 {
    let pressure = saturation_pressure(t);
    if pressure < PRESSURE {
        AIR_CONSTANT / VAPOUR_CONSTANT * pressure / (PRESSURE - pressure)
    } else {
        f64::INFINITY
    }
}

/// The room's air, per kg of dry air.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Room {
    /// Temperature, °C.
    pub temperature: f64,
    /// Vapour over dry air, kg/kg.
    pub humidity: f64,
    /// Enthalpy, J/kg, relative to dry air and water at 0 °C.
    pub enthalpy: f64,
    /// Density of the moist air, kg/m³.
    pub density: f64,
}

impl Room {
    /// Air at `temperature` °C and [`HUMIDITY`].
    pub fn at(temperature: f64) -> Self {
        let humidity = HUMIDITY * saturation_ratio(temperature);
        let vapour = VAPORISATION + VAPOUR_CAPACITY * temperature;
        let volume = (AIR_CONSTANT + humidity * VAPOUR_CONSTANT) * kelvin(temperature) / PRESSURE;
        Self {
            temperature,
            humidity,
            enthalpy: AIR_CAPACITY * temperature + humidity * vapour,
            density: (1.0 + humidity) / volume,
        }
    }
}

/// A puff of steam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Puff {
    /// Height of its centre, m.
    pub height: f64,
    /// Upward momentum with that of the air moved along, kg m/s.
    pub momentum: f64,
    /// Dry air in it, kg.
    pub air: f64,
    /// Water in it, vapour and mist, kg.
    pub water: f64,
    /// Enthalpy, J, relative to dry air and water at 0 °C.
    pub enthalpy: f64,
    /// Temperature, °C.
    pub temperature: f64,
    /// Part of the water that is mist, kg.
    pub mist: f64,
}

impl Puff {
    /// `mass` kg of steam whose specific enthalpy is `enthalpy` (J/kg, as the
    /// liquid's ledger has it: relative to water at 25 °C) at `height`, with
    /// the first of the `room`'s air in it, [`FIRST_AIR`]: of none there is no
    /// dew point.
    pub fn of_steam(mass: f64, enthalpy: f64, height: f64, room: &Room) -> Self {
        // The ledger's tables and the air's meet in the steam's temperature.
        let temperature = (enthalpy - steam_enthalpy(0.0)) / STEAM_CAPACITY;
        let air = FIRST_AIR * mass;
        let steam = VAPORISATION + VAPOUR_CAPACITY * temperature;
        let mut puff = Self {
            height,
            momentum: 0.0,
            air,
            water: mass + air * room.humidity,
            enthalpy: mass * steam + air * room.enthalpy,
            temperature,
            mist: 0.0,
        };
        puff.condense();
        puff
    }

    /// Its volume, m³.
    pub fn volume(&self) -> f64 {
        let gas = self.air * AIR_CONSTANT + (self.water - self.mist) * VAPOUR_CONSTANT;
        gas * kelvin(self.temperature) / PRESSURE
    }

    /// Radius of the sphere that it is, m.
    pub fn radius(&self) -> f64 {
        (0.75 / PI * self.volume()).cbrt()
    }

    /// Upward speed, m/s.
    pub fn speed(&self, room: &Room) -> f64 {
        let moved = self.air + self.water + VIRTUAL_MASS * room.density * self.volume();
        self.momentum / moved
    }

    /// Optical depth of the mist along a diameter's mean chord, 4r/3:
    /// droplets much larger than light's wavelength take twice their section
    /// (van de Hulst 1957).
    pub fn optical_depth(&self) -> f64 {
        1.5 * self.mist / (PI * WATER_DENSITY * DROPLET_RADIUS * self.radius().powi(2))
    }

    /// Rises, takes in air and condenses for `time` seconds under gravity `g` (m/s²).
    pub fn advance(&mut self, room: &Room, g: f64, time: f64) {
        let volume = self.volume();
        let buoyancy = room.density * volume - self.air - self.water;
        self.momentum += g * buoyancy * time;
        let speed = self.speed(room);
        self.height += speed * time;
        let surface = 4.0 * PI * self.radius().powi(2);
        let taken = room.density * surface * ENTRAINMENT * speed.abs() * time;
        let air = taken / (1.0 + room.humidity);
        self.air += air;
        self.water += air * room.humidity;
        self.enthalpy += air * room.enthalpy;
        self.condense();
    }

    /// Temperature and mist that follow from its air, water and enthalpy.
    pub fn condense(&mut self) {
        let gaseous = self.air * AIR_CAPACITY + self.water * VAPOUR_CAPACITY;
        let dry = (self.enthalpy - self.water * VAPORISATION) / gaseous;
        if saturation_pressure(dry) >= PRESSURE || self.air * saturation_ratio(dry) >= self.water {
            self.temperature = dry;
            self.mist = 0.0;
            return;
        }
        // The mixture's enthalpy is convex in T, and at the dew point it is too
        // much: from there Newton's steps come down to the temperature.
        let mut t = dew_point(self.water / self.air);
        for _ in 0..NEWTON_STEPS {
            let vapour = self.air * saturation_ratio(t);
            let steeper = MAGNUS[1] * MAGNUS[2] / (t + MAGNUS[2]).powi(2) * PRESSURE
                / (PRESSURE - saturation_pressure(t));
            let evaporation = VAPORISATION + (VAPOUR_CAPACITY - WATER_CAPACITY) * t;
            let fixed = self.air * AIR_CAPACITY + self.water * WATER_CAPACITY;
            let held = fixed * t + vapour * evaporation;
            let slope = fixed
                + vapour * (VAPOUR_CAPACITY - WATER_CAPACITY)
                + vapour * steeper * evaporation;
            t -= (held - self.enthalpy) / slope;
        }
        self.temperature = t;
        self.mist = (self.water - self.air * saturation_ratio(t)).max(0.0);
    }
}

fn kelvin(t: f64) -> f64 {
    t - ABSOLUTE_ZERO
}
