// The record `heat`: a particle's temperature and acid fraction, and what else its neighbours must know to
// exchange them. Each chemistry has its own; both begin with T (°C) and c, which the picture draws.
//!include common/chemistry/features.wgsl

/// T (°C) and c of a record of either chemistry.
fn temperature_in(heat: vec4<f32>) -> f32 {
    return heat.x;
}

fn acid_in(heat: vec4<f32>) -> f32 {
    return heat.y;
}

/// What must be finite in a record of either chemistry; the other word follows from these. Of the physical one h
/// tells, for T of an h that is no number is absolute zero.
fn tested_in(heat: vec4<f32>) -> vec3<f32> {
    if (PHYSICAL) { return heat.xyw; }
    return heat.xyz;
}

/// Of the paper's chemistry.
struct PaperHeat {
    /// °C.
    temperature: f32,
    acid: f32,
    /// e_i = ½ Σ w|v_ij|² of the substep before, J/kg.
    agitation: f32,
    /// What `acid` lacks by rounding.
    acid_lacking: f32,
}

fn pack_paper_heat(heat: PaperHeat) -> vec4<f32> {
    return vec4<f32>(heat.temperature, heat.acid, heat.agitation, heat.acid_lacking);
}

fn unpack_paper_heat(words: vec4<f32>) -> PaperHeat {
    return PaperHeat(words.x, words.y, words.z, words.w);
}

/// Of the physical chemistry.
struct Potential {
    /// °C.
    temperature: f32,
    /// Of the liquid, without its vapour.
    acid: f32,
    /// Mass of the liquid (V0·ρ0), and its specific heat capacity (J/(kg K)). They are only
    /// coefficients of the exchange, so 11 bits of each are enough; both sides of a pair unpack the
    /// same ones.
    mass: f32,
    capacity: f32,
    /// h of the liquid, without the vapour's, J/kg.
    enthalpy: f32,
}

/// Unit of the packed capacity, as in `solver/matter.rs`.
const CAPACITY_UNIT: f32 = 4000.0;

fn pack_potential(potential: Potential) -> vec4<f32> {
    let held = vec2<f32>(potential.mass, potential.capacity / CAPACITY_UNIT);
    return vec4<f32>(
        potential.temperature, potential.acid, bitcast<f32>(pack2x16float(held)), potential.enthalpy);
}

fn unpack_potential(words: vec4<f32>) -> Potential {
    let held = unpack2x16float(bitcast<u32>(words.z));
    return Potential(words.x, words.y, held.x, held.y * CAPACITY_UNIT, words.w);
}
