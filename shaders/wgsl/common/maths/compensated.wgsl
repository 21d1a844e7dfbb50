// Compensated addition (Kahan 1965). What an addition rounds away is kept for
// the next one: acid that diffuses through liquid at rest comes by 1e-8 of a
// substep, which is gone beside c = 0.9 (its last bit is 6e-8) and not beside
// c = 0, so that the liquid would gain acid.
//!include common/liquid/step.wgsl

/// A sum as it was rounded. Compilers may take (x + w) − x for w, and Mesa's
/// does; they do not know that no scene has 2³¹ poses.
fn rounded(sum: f32) -> f32 {
    return bitcast<f32>(bitcast<u32>(sum) ^ (step.next >> 31u));
}

/// (x + change, rounded; what that lacks) for x that lacks `rest`.
fn compensated(x: f32, rest: f32, change: f32) -> vec2<f32> {
    let wanted = change + rest;
    let sum = rounded(x + wanted);
    return vec2<f32>(sum, wanted - (sum - x));
}

/// c's last bit below one half is 2⁻²⁵; in its units a half keeps ten digits of what is lacking.
const REST_UNIT: f32 = 16777216.0;

/// What c and h (J/kg) lack, in one word.
fn pack_rests(acid: f32, enthalpy: f32) -> f32 {
    return bitcast<f32>(pack2x16float(vec2<f32>(acid * REST_UNIT, enthalpy)));
}

fn unpack_rests(rests: f32) -> vec2<f32> {
    return unpack2x16float(bitcast<u32>(rests)) / vec2<f32>(REST_UNIT, 1.0);
}
