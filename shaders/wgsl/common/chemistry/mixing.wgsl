// The record `mixing`: what lines 26 (its end), 27 and 28 need of line 26's first pass. Each chemistry
// has its own layout and fills in its own fields; the others are 0.
//!include common/chemistry/features.wgsl

struct Mixing {
    /// Of XSPH, as a multiple of the substep's; of the paper's chemistry negative for anti-viscosity.
    coefficient: f32,
    /// Paper: c before the substep.
    acid_before: f32,
    /// Paper: secant slope s_i of the heat of solution over the substep's change of c, J/kg.
    heat_slope: f32,
    /// Paper: what c lacks by rounding.
    acid_lacking: f32,
    /// Physical: s², the variance of the acid fraction within the liquid.
    variance: f32,
    /// Physical: mass over V0·ρ0.
    mass: f32,
    /// Physical: what c and h lack, see `rests.wgsl`.
    rests: f32,
}

fn pack_mixing(mixing: Mixing) -> vec4<f32> {
    if (PHYSICAL) { return vec4<f32>(mixing.coefficient, mixing.variance, mixing.mass, mixing.rests); }
    return vec4<f32>(mixing.acid_before, mixing.heat_slope, mixing.coefficient, mixing.acid_lacking);
}

fn unpack_mixing(words: vec4<f32>) -> Mixing {
    if (PHYSICAL) { return Mixing(words.x, 0.0, 0.0, 0.0, words.y, words.z, words.w); }
    return Mixing(words.z, words.x, words.y, words.w, 0.0, 0.0, 0.0);
}
