//! Thomsen's heat of solution (Eqs 9 and 10).

/// Joules in a thermochemical calorie (exact by definition).
pub const JOULES_PER_CALORIE: f64 = 4.184;

/// 17860 cal per mol of H₂SO₄: the limit of Eq. 9 for much water.
const FULL_HEAT: f64 = 17_860.0;

/// Moles of water per mol of H₂SO₄ at which half of it is evolved.
const HALF_AT: f64 = 1.7983;

/// M(H₂SO₄) as the paper has it, g/mol.
const ACID_MOLAR_MASS: f64 = 98.0;

/// M(H₂O) as the paper has it, g/mol.
const WATER_MOLAR_MASS: f64 = 18.0;

/// h = 17860·n_a·n_w/(n_w + 1.7983·n_a) cal with n_a = c/98 and
/// n_w = (1 − c)/18 mol per gram, as h = SCALE·c·(1 − c)/(1 + BEND·c) J/kg.
const SCALE: f64 = FULL_HEAT * JOULES_PER_CALORIE * 1000.0 / ACID_MOLAR_MASS;

/// BEND = 1.7983·18/98 − 1.
const BEND: f64 = HALF_AT * WATER_MOLAR_MASS / ACID_MOLAR_MASS - 1.0;

/// Q(k) of Eq. 9, J per mol of H₂SO₄: heat evolved on mixing it with `k` ≥ 0
/// mol of water.
pub fn heat_per_mole_of_acid(k: f64) -> f64 {
    FULL_HEAT * JOULES_PER_CALORIE * k / (k + HALF_AT)
}

/// h(c) of Eq. 10 per mass, J/kg of mixture: heat evolved on making it from
/// the pure liquids.
///
/// Eq. 10 as printed is 0/0 at c = 0, where k is infinite; this form is
/// finite everywhere.
pub fn heat(acid: f64) -> f64 {
    SCALE * acid * (1.0 - acid) / (1.0 + BEND * acid)
}

/// (h(b) − h(a))/(b − a), J/kg; dh/dc where the two are equal.
///
/// The difference is divided out by algebra: h is a rational function, and
/// h(b) − h(a) has the factor b − a. The quotient of differences would have
/// no digit left in f32 once a and b agree to 1e-6.
pub fn secant(a: f64, b: f64) -> f64 {
    SCALE * (1.0 - a - b - BEND * a * b) / ((1.0 + BEND * a) * (1.0 + BEND * b))
}
