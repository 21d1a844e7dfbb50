//! The paper's chemistry: heat of solution (Eqs 6 to 8 and 11 to 13) and
//! anti-viscosity (Eq. 17).

use super::constants::ABSOLUTE_ZERO;
use super::error::OutOfRange;
use super::thomsen::{self, JOULES_PER_CALORIE};

/// ε of Eqs 11 and 12, mass fraction.
const EPSILON: f64 = 1e-6;

/// P₀: specific power at twice T_B and k_v = 1, W/kg, in a world of the
/// paper's size.
///
/// Eq. 17 as printed injects in proportion to the superheat and to the
/// energy that is there, which itself grows with the superheat; hence the
/// square in [`AntiViscosity::power`]. Of one constant for both, 200 lets
/// Fig. 7's soup (10 K above T_B) simmer and Fig. 6's acid (50 to 150 K
/// above) splash.
pub const REFERENCE_POWER: f64 = 200.0;

/// Most that anti-viscosity adds to a particle's relative velocity in a
/// substep, as a share. It decides where little moves yet, and for how long
/// the injected energy exceeds αe by its second order, α²·|Σw v_ij|²/2 (a
/// tenth at this α among uncorrelated velocities).
pub const GROWTH_LIMIT: f64 = 0.3;

/// How Eq. 5 weights a pair.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub enum Diffusion {
    /// 4m/(ρ_i + ρ_j) at rest density: one gains as much as the other loses.
    #[default]
    Conservative,
    /// m_j/ρ_j·4ρ_i/(ρ_i + ρ_j) as printed: Σc drifts.
    Literal,
}

/// Law of anti-viscosity for particles hotter than T_B.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub enum Boiling {
    /// Anti-viscosity injects a stated power, see [`AntiViscosity::growth`].
    #[default]
    Power,
    /// Eq. 17 as printed, a coefficient per substep: relative velocities grow
    /// by 1 + |μ| in each, so twice as many substeps inject far more.
    Literal,
}

/// Heat of solution of a pair, and the rise in temperature that Eq. 13 gives for it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dilution {
    kelvin_per_joule: f64,
    mass: f64,
}

impl Dilution {
    /// Heat generation `k_d` in K/cal, as Table 1 has it, for particles of
    /// `mass` kg.
    pub fn new(k_d: f64, mass: f64) -> Self {
        Self {
            kelvin_per_joule: k_d / JOULES_PER_CALORIE,
            mass,
        }
    }

    /// q_ij, J, of a pair in which i gained `change` (Δc_ij), where s_i and
    /// s_j are each particle's own [`thomsen::secant`] from its old to its
    /// new composition.
    ///
    /// Eq. 8 with each pair's own Δc on the old c, summed over all of a
    /// particle's pairs, heats too much, as h is concave: 0.3 % in a box,
    /// most of the heat again where many neighbours give a lot. With the
    /// secants the sum is Σ s_i·Δc_i, the enthalpy change itself.
    pub fn pair_heat(&self, (s_i, s_j): (f64, f64), change: f64) -> f64 {
        self.mass * (s_i - s_j) * change
    }

    /// ΔT_i of Eqs 11 and 13, K, from q_ij = `heat` (J) between particles of
    /// old compositions c_i and c_j.
    ///
    /// The printed weights sum to (c_i + c_j)/(c_i + c_j + ε), and heat is
    /// lost in dilute liquid; ε/2 in the numerator makes it one.
    pub fn warming(&self, heat: f64, c_i: f64, c_j: f64) -> f64 {
        self.kelvin_per_joule * heat * (c_j + 0.5 * EPSILON) / (c_i + c_j + EPSILON)
    }

    /// Heat of solution in a particle, J, relative to the pure liquids.
    pub fn heat(&self, acid: f64) -> f64 {
        self.mass * thomsen::heat(acid)
    }

    /// Heat capacity of a particle of the paper's world, J/K: 1/k_d.
    pub fn heat_capacity(&self) -> f64 {
        1.0 / self.kelvin_per_joule
    }
}

/// Line 27 of a liquid that boils.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AntiViscosity {
    boiling_point: f64,
    intensity: f64,
}

impl AntiViscosity {
    /// Boiling point T_B (°C) and intensity k_v.
    ///
    /// # Errors
    /// [`OutOfRange::BoilingPoint`] for T_B ≤ 0 °C: Eq. 17 divides by it.
    pub fn new(boiling_point: f64, intensity: f64) -> Result<Self, OutOfRange> {
        if boiling_point.is_finite() && boiling_point > 0.0 {
            Ok(Self {
                boiling_point,
                intensity,
            })
        } else {
            Err(OutOfRange::BoilingPoint(boiling_point))
        }
    }

    /// Whether a particle of `temperature` (°C) boils.
    pub fn boils(&self, temperature: f64) -> bool {
        temperature >= self.boiling_point
    }

    /// k_v·(T − T_B)/T_B: Eq. 17 without μ₀, from zero at T_B.
    fn excess(&self, temperature: f64) -> f64 {
        let above = (temperature.max(ABSOLUTE_ZERO) - self.boiling_point).max(0.0);
        self.intensity * above / self.boiling_point
    }

    /// P_i, W/kg: power injected into a particle of `temperature` (°C).
    pub fn power(&self, temperature: f64) -> f64 {
        REFERENCE_POWER * self.excess(temperature).powi(2)
    }

    /// α_i = min(0.3, P_i·Δt/e_i): strength with which relative velocities
    /// around i grow in a substep of `time` s, where e_i = ½Σ_j w_ij·|v_ij|²
    /// = `agitation` (J/kg).
    ///
    /// The pair impulses Δv_i = Σ_j (α_i + α_j)/2·w_ij·(v_i − v_j) with
    /// w_ij = V₀W_ij keep momentum and do the work Σ_i m·α_i·e_i to first
    /// order in α: the stated power, whatever Δt. Eq. 17's own coefficient
    /// injects in proportion to the energy that is there, without end.
    ///
    /// e_i is the one of the substep before, so that it takes no pass of its
    /// own; at rest α is the bound.
    pub fn growth(&self, temperature: f64, agitation: f64, time: f64) -> f64 {
        bounded_growth(self.power(temperature) * time, agitation)
    }

    /// μ_i of Eq. 17 as printed, for μ₀ = `viscosity`.
    pub fn literal(&self, temperature: f64, viscosity: f64) -> f64 {
        if self.boils(temperature) {
            -viscosity * self.excess(temperature)
        } else {
            viscosity
        }
    }
}

/// α for the specific energy `budget` (J/kg) to be injected at the
/// agitation e (J/kg).
pub fn bounded_growth(budget: f64, agitation: f64) -> f64 {
    if budget <= 0.0 {
        0.0
    } else if budget < GROWTH_LIMIT * agitation {
        budget / agitation
    } else {
        GROWTH_LIMIT
    }
}
