//! The physical chemistry's state, its boiling and what boiling pays for.

use super::constants::{ABSOLUTE_ZERO, GAS_CONSTANT, WATER_MOLAR_MASS};
use super::error::{OutOfRange, check_content};
use super::properties::AZEOTROPE;
use super::table::{Row, STEAM_CAPACITY, SolutionTable, steam_enthalpy};

/// Newton's steps towards the equilibrium of liquid and vapour. From the
/// vapour that is there they leave an error below 1e-4 in its mass fraction,
/// and what they leave is left to the next substep: h is the state, so no
/// energy is lost by it.
pub const FLASH_STEPS: u32 = 3;

/// Most of a particle that is vapour: what is left has a composition and a
/// temperature, however hot.
const MOST_VAPOUR: f64 = 0.99;

/// What a particle holds: liquid, and vapour in bubbles that have not left.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Content {
    /// Mass of both, kg.
    pub mass: f64,
    /// c: acid over that mass.
    pub acid: f64,
    /// h: enthalpy over that mass, J/kg, relative to the pure liquids at 25 °C.
    pub enthalpy: f64,
    /// y: vapour over that mass.
    pub vapour: f64,
}

/// Vapour on its way.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Steam {
    /// Its mass, kg.
    pub mass: f64,
    /// Its enthalpy, J.
    pub enthalpy: f64,
}

impl Content {
    /// `mass` kg of liquid of acid fraction `acid` at `temperature` (°C).
    ///
    /// # Errors
    /// [`OutOfRange`] for what no liquid has.
    pub fn liquid(
        table: &SolutionTable,
        mass: f64,
        acid: f64,
        temperature: f64,
    ) -> Result<Self, OutOfRange> {
        check_content(acid, temperature)?;
        if !(mass.is_finite() && mass > 0.0) {
            return Err(OutOfRange::Mass(mass));
        }
        Ok(Self {
            mass,
            acid,
            enthalpy: table.enthalpy(acid, temperature),
            vapour: 0.0,
        })
    }

    /// Mass of the liquid, kg.
    pub fn liquid_mass(&self) -> f64 {
        self.mass * (1.0 - self.vapour)
    }

    /// c/(1 − y): acid fraction of the liquid.
    pub fn liquid_acid(&self) -> f64 {
        liquid_acid(self.acid, self.vapour)
    }

    /// Properties of the liquid.
    pub fn liquid_row(&self, table: &SolutionTable) -> Row {
        table.at(self.liquid_acid())
    }

    /// T of liquid and vapour, °C.
    pub fn temperature(&self, table: &SolutionTable) -> f64 {
        self.liquid_row(table)
            .temperature_with_steam(self.enthalpy, self.vapour)
    }

    /// S = T − T_b(c/(1 − y)), K.
    pub fn superheat(&self, table: &SolutionTable) -> f64 {
        self.temperature(table) - self.liquid_row(table).boiling_point
    }

    /// Volume of the liquid, m³.
    pub fn liquid_volume(&self, table: &SolutionTable) -> f64 {
        let density = self.liquid_row(table).density_at(self.temperature(table));
        self.liquid_mass() / density
    }

    /// y at which liquid and vapour are in equilibrium at one atmosphere, by
    /// `steps` of Newton's iteration from the present y.
    ///
    /// The enthalpy of the boiling mixture,
    /// (1 − y)·h(c_l, T_b(c_l)) + y·h_v(T_b(c_l)) with c_l = c/(1 − y), is
    /// convex in y: the iteration overshoots once at most and then comes
    /// down. It ends at the azeotrope, however hot the liquid is.
    pub fn equilibrium(&self, table: &SolutionTable, steps: u32) -> f64 {
        let most = (1.0 - self.acid / AZEOTROPE).clamp(0.0, MOST_VAPOUR);
        let mut vapour = self.vapour.clamp(0.0, most);
        for _ in 0..steps {
            let row = table.at(liquid_acid(self.acid, vapour));
            let at = row.boiling_point;
            let (liquid, steam) = (row.enthalpy_at(at), steam_enthalpy(at));
            let boiling = liquid + vapour * (steam - liquid);
            let liquid_slope = row.slope_at(at) + row.capacity_at(at) * row.boiling_slope;
            let steam_slope = STEAM_CAPACITY * row.boiling_slope;
            let slope =
                steam - liquid + row.acid * (liquid_slope + steam_slope * vapour / (1.0 - vapour));
            vapour = (vapour + (self.enthalpy - boiling) / slope).clamp(0.0, most);
        }
        vapour
    }

    /// Boils, or lets vapour condense, for `time` seconds: y goes towards its
    /// equilibrium with the time constant `settling` (s). Returns the change
    /// of y.
    pub fn boil(&mut self, table: &SolutionTable, time: f64, settling: f64) -> f64 {
        let way = self.equilibrium(table, FLASH_STEPS) - self.vapour;
        let change = way * -(-time / settling).exp_m1();
        self.vapour += change;
        change
    }

    /// Takes away water that evaporates; the vapour in bubbles stays.
    pub fn take_out_water(&mut self, gone: &Steam) {
        let mass = self.mass - gone.mass;
        self.acid *= self.mass / mass;
        self.enthalpy = (self.mass * self.enthalpy - gone.enthalpy) / mass;
        self.vapour *= self.mass / mass;
        self.mass = mass;
    }

    /// Vapour that comes; what leaves is negative. No more can leave than is
    /// there; beyond that it is water that goes.
    pub fn take_up(&mut self, steam: &Steam) {
        let mass = self.mass + steam.mass;
        let vapour = self.mass * self.vapour + steam.mass;
        self.acid *= self.mass / mass;
        self.enthalpy = (self.mass * self.enthalpy + steam.enthalpy) / mass;
        self.vapour = (vapour / mass).max(0.0);
        self.mass = mass;
    }
}

fn liquid_acid(acid: f64, vapour: f64) -> f64 {
    (acid / (1.0 - vapour)).min(1.0)
}

/// What evaporation of the mass fraction `evaporated` at `temperature` (°C)
/// may spend on motion, J/kg: η·x·R·T/M.
pub fn motion_budget(share: f64, evaporated: f64, temperature: f64) -> f64 {
    let kelvin = temperature - ABSOLUTE_ZERO;
    share * evaporated.max(0.0) * GAS_CONSTANT * kelvin / WATER_MOLAR_MASS
}
