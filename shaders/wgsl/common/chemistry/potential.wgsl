// What neighbours need to know of a particle of the physical chemistry, in one
// vector. Mass and heat capacity are only coefficients of the exchange, so 11
// bits of each are enough; both sides of a pair unpack the same ones.
//!include common/chemistry/solution.wgsl

/// T (°C), acid fraction of the liquid, its mass and heat capacity (in units of V0·ρ0 and of
/// that of 4 kJ/K), ∂h/∂c (J/kg).
fn potential(acid: f32, enthalpy: f32, vapour: f32, mass: f32) -> vec4<f32> {
    let row = row_at(liquid_acid(acid, vapour));
    let temperature = temperature_with_steam(row, enthalpy, vapour);
    let liquid = mass * (1.0 - vapour);
    let packed = pack2x16float(vec2<f32>(liquid, liquid * capacity_at(row, temperature) / 4000.0));
    return vec4<f32>(temperature, row.acid, bitcast<f32>(packed), slope_at(row, temperature));
}

/// Mass of the liquid (V0·ρ0) and its heat capacity (J/K per V0·ρ0).
fn held(potential: vec4<f32>) -> vec2<f32> {
    return unpack2x16float(bitcast<u32>(potential.z)) * vec2<f32>(1.0, 4000.0);
}
