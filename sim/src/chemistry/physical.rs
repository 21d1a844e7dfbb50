//! The physical chemistry's state, and the equilibrium towards which it boils.

use super::error::{OutOfRange, check_content};
use super::properties::AZEOTROPE;
use super::segregation::without_water;
use super::table::{Row, STEAM_CAPACITY, SolutionTable, steam_enthalpy};

/// Newton's steps towards the equilibrium of liquid and vapour. From the
/// present vapour they leave an error below 1e-4 in its mass fraction, which
/// the next substep corrects: h is the state, so no energy is lost by it.
pub const FLASH_STEPS: u32 = 3;

/// Largest vapour fraction of a particle: the liquid that remains has a composition and a
/// temperature, however hot.
const MOST_VAPOUR: f64 = 0.99;

/// Least change of y of which a secant is taken, and the slopes dS/dy (K) that one may have: of water it
/// is −540 K, of acid more than ten times that.
const SECANT_FROM: f64 = 1e-5;
const FLATTEST: f64 = 300.0;
const STEEPEST: f64 = 2e4;

/// Content of a particle: liquid, and without bubbles its vapour too.
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
    /// s²: variance of the acid fraction within the liquid.
    pub variance: f64,
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
    /// [`OutOfRange`] for a composition or temperature that no liquid has.
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
            variance: 0.0,
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

    /// Properties of the liquid and its lamellae.
    pub fn liquid_row(&self, table: &SolutionTable) -> Row {
        table.of_lamellae(self.liquid_acid(), self.variance)
    }

    /// T of liquid and vapour, °C.
    pub fn temperature(&self, table: &SolutionTable) -> f64 {
        self.liquid_row(table)
            .temperature_with_steam(self.enthalpy, self.vapour)
    }

    /// S = T − T_b, K, of the liquid's most watery part.
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
    ///
    /// Of a liquid with lamellae it is their water that boils.
    pub fn equilibrium(&self, table: &SolutionTable, steps: u32) -> f64 {
        if self.variance > 0.0 {
            return self.flash(table, steps);
        }
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

    /// y at which the most watery part of the lamellae has its boiling point, by
    /// secants from the present y: their slope is first that of a particle
    /// whose latent heat and boiling point are as they are now.
    fn flash(&self, table: &SolutionTable, steps: u32) -> f64 {
        let most = (1.0 - self.acid / AZEOTROPE).clamp(0.0, MOST_VAPOUR);
        let superheat = |vapour: f64| {
            let row = self.boiled_to(table, vapour).liquid_row(table);
            row.temperature_with_steam(self.enthalpy, vapour) - row.boiling_point
        };
        let row = self.liquid_row(table);
        let latent = steam_enthalpy(row.boiling_point) - row.enthalpy_at(row.boiling_point);
        let first = latent / row.capacity_at(row.boiling_point) + row.boiling_slope * row.acid;
        let (mut slope, mut vapour) = (-first, self.vapour);
        let mut here = superheat(vapour);
        for _ in 0..steps {
            let next = (vapour - here / slope).clamp(0.0, most);
            let there = superheat(next);
            let found = (there - here) / (next - vapour);
            if (next - vapour).abs() > SECANT_FROM && (-STEEPEST..-FLATTEST).contains(&found) {
                slope = found;
            }
            (vapour, here) = (next, there);
        }
        vapour
    }

    /// This with the vapour fraction `vapour`, whose water came from or went to the most watery part.
    fn boiled_to(&self, table: &SolutionTable, vapour: f64) -> Self {
        let gone = (vapour - self.vapour) / (1.0 - self.vapour);
        Self {
            vapour,
            variance: self.variance_without(table, gone),
            ..*self
        }
    }

    /// s² after the share `gone` of the liquid has left its most watery part as water.
    fn variance_without(&self, table: &SolutionTable, gone: f64) -> f64 {
        if self.variance <= 0.0 {
            return 0.0;
        }
        let acid = self.liquid_acid();
        let depth = table.lamellae().excess(acid, self.variance).depth;
        without_water(self.variance, acid, acid - depth, gone)
    }

    /// Boils, or lets vapour condense, for `time` seconds: y goes towards its
    /// equilibrium with the time constant `settling` (s). Returns the change
    /// of y.
    pub fn boil(&mut self, table: &SolutionTable, time: f64, settling: f64) -> f64 {
        let way = self.equilibrium(table, FLASH_STEPS) - self.vapour;
        let change = way * -(-time / settling).exp_m1();
        *self = self.boiled_to(table, self.vapour + change);
        change
    }

    /// Takes away water that evaporates; the vapour in bubbles stays.
    pub fn take_out_water(&mut self, table: &SolutionTable, gone: &Steam) {
        let mass = self.mass - gone.mass;
        self.variance = self.variance_without(table, gone.mass / self.liquid_mass());
        self.acid *= self.mass / mass;
        self.enthalpy = (self.mass * self.enthalpy - gone.enthalpy) / mass;
        self.vapour *= self.mass / mass;
        self.mass = mass;
    }
}

fn liquid_acid(acid: f64, vapour: f64) -> f64 {
    (acid / (1.0 - vapour)).min(1.0)
}
