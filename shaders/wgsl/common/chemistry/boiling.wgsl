// Anti-viscosity (section 4.3, Eq. 17): what boils pushes its neighbours away.
// `chemistry/paper.rs` is the same in f64.
//
// Each particle has one signed coefficient, as a multiple of the substep's
// XSPH coefficient: 1 is ordinary viscosity, negative is anti-viscosity. A
// pair takes the mean of its two, or momentum would drift.
//!include common/liquid/step.wgsl
//!include common/liquid/viscosity.wgsl

/// T_B, °C.
override BOILING_POINT: f32 = 100.0;
/// Eq. 17 as printed, per substep however long that is.
override LITERAL_BOILING: bool = false;
/// P₀: power at twice T_B and k_v = 1, W/kg.
override BOILING_POWER: f32 = 200.0;
/// Most that is added to a relative velocity in a substep, as a share: with
/// nothing moving yet, the stated power would ask for any velocity.
const GROWTH_LIMIT: f32 = 0.3;

/// α for the specific energy `budget` (J/kg) to be injected at the agitation e
/// (J/kg).
fn bounded_growth(budget: f32, agitation: f32) -> f32 {
    if (budget <= 0.0) { return 0.0; }
    return select(GROWTH_LIMIT, budget / max(agitation, 1e-30), budget < GROWTH_LIMIT * agitation);
}

/// Line 27, Eq. 17: the coefficient of a particle at `temperature` (°C). `agitation` is e_i =
/// ½ Σ w |v_i − v_j|² (J/kg) of the substep before: this substep's is known
/// to nobody before the pass that needs it.
fn stirring(temperature: f32, agitation: f32) -> f32 {
    // Not by the excess: at k_v = 0 that of cold liquid is zero as well.
    if (temperature < BOILING_POINT) { return CALM; }
    let excess = step.intensity * (temperature - BOILING_POINT) / BOILING_POINT;
    if (LITERAL_BOILING) { return -excess * CALM; }
    return -bounded_growth(BOILING_POWER * excess * excess * step.time, agitation) / step.viscosity;
}
