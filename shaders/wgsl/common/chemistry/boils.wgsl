// What a particle is to the bubbles around it: its superheat (K, negative where it is colder than its boiling point), the steam
// that a kelvin of it makes (V0·ρ0/K), and the share of it that drives a bubble's growth, as that needs water.
//!include common/chemistry/heat.wgsl
//!include common/chemistry/matter.wgsl
//!include common/chemistry/molecules.wgsl
//!include common/chemistry/segregation.wgsl
//!include common/chemistry/slots.wgsl
//!include common/chemistry/solution.wgsl

/// Excess pressure of vapour, over an atmosphere, at which as many nuclei grow as there are particles.
override NUCLEUS_PRESSURE: f32 = 1e9;
/// Time between two bubbles of a nucleus that grows, s: frequency times diameter is 0.59 (σ g/ρ)^¼ (Zuber 1963), 0.092 m/s in water at
/// 100 °C, and bubbles leave with 4 mm (chosen, as they leave what is clean).
const NUCLEUS_WAIT: f32 = 0.0435;

/// Latent heat of water over the gas constant of its vapour, K.
const LATENT_TEMPERATURE: f32 = 4890.0;
/// Superheat below which no nucleus grows, K: one would be wider than 30 µm, and such gas rises out of liquid.
const NUCLEATION: f32 = 1.0;
/// Least superheat of which a secant is taken, K.
const SUPERHEATED: f32 = 0.01;

/// Bits that have lost their order (O'Neill's PCG).
fn scattered(number: u32) -> u32 {
    let state = number * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

/// Excess pressure of the vapour over an atmosphere in liquid of `temperature` (°C) that is `superheat` K above its boiling point
/// (Clausius and Clapeyron).
fn excess_pressure(superheat: f32, temperature: f32) -> f32 {
    let absolute = temperature - ABSOLUTE_ZERO;
    return exp(LATENT_TEMPERATURE * superheat / (absolute * (absolute - superheat))) - 1.0;
}

/// Nuclei that grow in a particle, in the mean. One of radius R does where vapour exceeds the pressure by 2σ/R, and N(>R) ∝ R⁻³ (Brennen
/// 1995, Cavitation and Bubble Dynamics).
fn growing_nuclei(superheat: f32, temperature: f32) -> f32 {
    if (superheat <= NUCLEATION) { return 0.0; }
    return pow(excess_pressure(superheat, temperature) / NUCLEUS_PRESSURE, 3.0);
}

/// Whether a particle has one of `nuclei` that grow in the mean, by Poisson's law.
fn nucleus_grows(identity: u32, nuclei: f32) -> bool {
    let chance = (f32(scattered(identity) >> 8u) + 0.5) / 16777216.0;
    return nuclei > -log(chance);
}

/// What a nucleus's wait is multiplied by in a particle where one or more of `nuclei` in the mean grow, (1 − exp(−n))/n: each nucleus then has
/// its bubbles, as many in coarse particles as in fine ones.
fn share_of_nuclei(nuclei: f32) -> f32 {
    // Of few, the difference would be rounding.
    return select(1.0 - 0.5 * nuclei, (1.0 - exp(-nuclei)) / nuclei, nuclei > 0.01);
}

/// Place of a bubble that is born at a particle at x: another one each time.
fn place_of_birth(identity: u32, x: vec3<f32>) -> u32 {
    let bits = bitcast<vec3<u32>>(x);
    return scattered(identity ^ scattered(bits.x ^ scattered(bits.y ^ scattered(bits.z)))) % SLOTS;
}

fn boil_of(content: Content, variance: f32, potential: Potential) -> vec4<f32> {
    let acid = potential.acid;
    let row = row_of_lamellae(acid, variance);
    let point = row.value.boiling_point;
    let superheat = potential.temperature - point;
    let poorest = poorest_of(acid, variance);
    let latent = steam_enthalpy(point) - enthalpy_at(row, point);
    let capacity = capacity_at(row, point);
    // K of a mass fraction that boils away: of the latent heat, and of the boiling point, which rises.
    let fall = latent / capacity + row.slope.boiling_point * poorest;
    var per_kelvin = content.mass / fall;
    if (superheat > SUPERHEATED) {
        var vapour = 0.0;
        if (SEGREGATION && variance > 0.0) {
            vapour = flash(content.acid, content.enthalpy, 0.0, variance, poorest);
        } else {
            vapour = equilibrium(content.acid, content.enthalpy, 0.0);
        }
        per_kelvin = content.mass * vapour / superheat;
    }
    // Water runs out around a bubble (Scriven 1959, binary): it comes by diffusion, which is slower than heat.
    let viscosity = viscosity_of(acid, potential.temperature);
    let warmth = (potential.temperature - ABSOLUTE_ZERO) / 298.15;
    let diffusivity = ACID_DIFFUSIVITY * warmth * WATER_VISCOSITY / viscosity;
    let depletion = sqrt(THERMAL_DIFFUSIVITY / diffusivity) * poorest * max(row.slope.boiling_point, 0.0);
    return vec4<f32>(superheat, per_kelvin, latent / (latent + capacity * depletion), 0.0);
}
