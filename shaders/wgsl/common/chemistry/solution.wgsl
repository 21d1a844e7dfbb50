// Sulfuric acid over composition: `chemistry/table.rs` in f32. h is relative
// to the pure liquids at 25 °C; temperatures are in °C.

/// Two rows per node: [h at 25 °C (J/kg), cp at 20 °C (J/(kg K)), T_b, ρ at 20 °C (kg/m³)],
/// [dρ/dT, ln η (Pa·s) at 20, 60 and 100 °C].
@group(0) @binding(18) var<storage, read> solution: array<vec4<f32>>;
/// Intervals of the table from pure water to pure acid.
override SOLUTION_INTERVALS: u32 = 1u;

const ENTHALPY_ZERO: f32 = 25.0;
const CAPACITY_AT: f32 = 20.0;
const STEAM_ENTHALPY: f32 = 2.442e6;
const STEAM_CAPACITY: f32 = 1.9e3;
const ABSOLUTE_ZERO: f32 = -273.15;
/// 1/T at 20, 60 and 100 °C, 1/K.
const INVERSE_20: f32 = 1.0 / 293.15;
const INVERSE_60: f32 = 1.0 / 333.15;
const INVERSE_100: f32 = 1.0 / 373.15;
/// Slope of the heat capacity in temperature, J/(kg K²), from this fraction on.
const CAPACITY_SLOPE: f32 = 1.0;
const CAPACITY_SLOPE_FROM: f32 = 0.6;
/// No more water boils out.
const AZEOTROPE: f32 = 0.983;
/// Vapour that a particle may hold at most: a trace of liquid stays.
const MOST_VAPOUR: f32 = 0.99;

struct Heats {
    /// h at 25 °C, J/kg.
    enthalpy: f32,
    /// cp at 20 °C, J/(kg K).
    capacity: f32,
    /// T_b, °C.
    boiling_point: f32,
}

/// Heat of one composition.
struct Row {
    acid: f32,
    value: Heats,
    /// Slopes in c over the interval.
    slope: Heats,
    /// dcp/dT, J/(kg K²).
    rise: f32,
}

fn unpack_heats(words: vec3<f32>) -> Heats {
    return Heats(words.x, words.y, words.z);
}

fn heats_of_node(node: u32) -> vec3<f32> {
    return solution[2u * node].xyz;
}

fn density_of_node(node: u32) -> f32 {
    return solution[2u * node].w;
}

/// dρ/dT.
fn expansion_of_node(node: u32) -> f32 {
    return solution[2u * node + 1u].x;
}

fn log_viscosities_of_node(node: u32) -> vec3<f32> {
    return solution[2u * node + 1u].yzw;
}

fn row_at(acid: f32) -> Row {
    let place = clamp(acid, 0.0, 1.0) * f32(SOLUTION_INTERVALS);
    let i = min(u32(place), SOLUTION_INTERVALS - 1u);
    let low = heats_of_node(i);
    let rise = heats_of_node(i + 1u) - low;
    let value = low + (place - f32(i)) * rise;
    return Row(
        acid, unpack_heats(value), unpack_heats(rise * f32(SOLUTION_INTERVALS)),
        CAPACITY_SLOPE * min(acid / CAPACITY_SLOPE_FROM, 1.0));
}

fn capacity_at(row: Row, temperature: f32) -> f32 {
    return row.value.capacity + row.rise * (temperature - CAPACITY_AT);
}

/// ∫ dT and ∫ (T − 20) dT from 25 °C.
fn warmth(temperature: f32) -> vec2<f32> {
    let t = temperature - ENTHALPY_ZERO;
    return vec2<f32>(t, t * (0.5 * t + ENTHALPY_ZERO - CAPACITY_AT));
}

fn enthalpy_at(row: Row, temperature: f32) -> f32 {
    let w = warmth(temperature);
    return row.value.enthalpy + row.value.capacity * w.x + row.rise * w.y;
}

/// ∂h/∂c at a temperature.
fn slope_at(row: Row, temperature: f32) -> f32 {
    let w = warmth(temperature);
    let rise = select(0.0, CAPACITY_SLOPE / CAPACITY_SLOPE_FROM, row.acid < CAPACITY_SLOPE_FROM);
    return row.slope.enthalpy + row.slope.capacity * w.x + rise * w.y;
}

fn steam_enthalpy(temperature: f32) -> f32 {
    return STEAM_ENTHALPY + STEAM_CAPACITY * (temperature - ENTHALPY_ZERO);
}

/// T of this liquid with the fraction `vapour` of steam whose enthalpy together is `enthalpy`.
fn temperature_with_steam(row: Row, enthalpy: f32, vapour: f32) -> f32 {
    let liquid = 1.0 - vapour;
    let linear = liquid * row.value.capacity + vapour * STEAM_CAPACITY;
    let square = 0.5 * liquid * row.rise;
    let offset = ENTHALPY_ZERO - CAPACITY_AT;
    let zero = liquid * row.value.enthalpy + vapour * STEAM_ENTHALPY;
    let level = (enthalpy - zero) + offset * (linear + square * offset);
    let root = sqrt(max(linear * linear + 4.0 * square * level, 0.0));
    return max(CAPACITY_AT + 2.0 * level / (linear + root), ABSOLUTE_ZERO);
}

/// c/(1 − y): acid fraction of the liquid.
fn liquid_acid(acid: f32, vapour: f32) -> f32 {
    return min(acid / (1.0 - vapour), 1.0);
}

/// y at which liquid and vapour of composition `acid` and enthalpy `enthalpy` are in equilibrium at
/// one atmosphere, by Newton's iteration from `start`.
fn equilibrium(acid: f32, enthalpy: f32, start: f32) -> f32 {
    let most = clamp(1.0 - acid / AZEOTROPE, 0.0, MOST_VAPOUR);
    var vapour = clamp(start, 0.0, most);
    for (var step = 0u; step < 3u; step++) {
        let row = row_at(liquid_acid(acid, vapour));
        let at = row.value.boiling_point;
        let liquid = enthalpy_at(row, at);
        let steam = steam_enthalpy(at);
        let boiling = liquid + vapour * (steam - liquid);
        let liquid_slope = slope_at(row, at) + capacity_at(row, at) * row.slope.boiling_point;
        let steam_slope = STEAM_CAPACITY * row.slope.boiling_point;
        let slope = steam - liquid + row.acid * (liquid_slope + steam_slope * vapour / (1.0 - vapour));
        vapour = clamp(vapour + (enthalpy - boiling) / slope, 0.0, most);
    }
    return vapour;
}

/// Temperatures between which densities follow their law, °C (`chemistry/table.rs`).
const TABLES_FROM: f32 = 0.0;
const TABLES_TO: f32 = 340.0;

/// ρ, kg/m³.
fn density_of(acid: f32, temperature: f32) -> f32 {
    let place = clamp(acid, 0.0, 1.0) * f32(SOLUTION_INTERVALS);
    let i = min(u32(place), SOLUTION_INTERVALS - 1u);
    let t = place - f32(i);
    let cold = mix(density_of_node(i), density_of_node(i + 1u), t);
    let slope = mix(expansion_of_node(i), expansion_of_node(i + 1u), t);
    return cold + slope * (clamp(temperature, TABLES_FROM, TABLES_TO) - 20.0);
}

/// η, Pa·s: ln η is linear in 1/T between 20, 60 and 100 °C, and on to either side.
fn viscosity_of(acid: f32, temperature: f32) -> f32 {
    let place = clamp(acid, 0.0, 1.0) * f32(SOLUTION_INTERVALS);
    let i = min(u32(place), SOLUTION_INTERVALS - 1u);
    let logs = mix(log_viscosities_of_node(i), log_viscosities_of_node(i + 1u), place - f32(i));
    let at = 1.0 / (clamp(temperature, 0.0, 350.0) - ABSOLUTE_ZERO);
    let cool = logs.x + (at - INVERSE_20) / (INVERSE_60 - INVERSE_20) * (logs.y - logs.x);
    let warm = logs.y + (at - INVERSE_60) / (INVERSE_100 - INVERSE_60) * (logs.z - logs.y);
    return exp(select(cool, warm, at < INVERSE_60));
}
