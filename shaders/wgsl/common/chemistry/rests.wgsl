// What a particle's acid fraction and enthalpy lack by rounding (`compensated.wgsl`), in one word.

struct Rests {
    acid: f32,
    /// J/kg.
    enthalpy: f32,
}

/// c's last bit below one half is 2⁻²⁵; in its units a half keeps ten digits of what is lacking.
const REST_UNIT: f32 = 16777216.0;

fn pack_rests(rests: Rests) -> f32 {
    return bitcast<f32>(pack2x16float(vec2<f32>(rests.acid * REST_UNIT, rests.enthalpy)));
}

fn unpack_rests(word: f32) -> Rests {
    let rests = unpack2x16float(bitcast<u32>(word)) / vec2<f32>(REST_UNIT, 1.0);
    return Rests(rests.x, rests.y);
}
