// Heat of solution by Thomsen's equation (Eqs 9 and 10); `chemistry/thomsen.rs`.

/// 17860 cal per mol of acid of 98 g, in J per kg.
const THOMSEN_SCALE: f32 = 17860.0 * 4.184 * 1000.0 / 98.0;
/// 1.7983·18/98 − 1.
const THOMSEN_BEND: f32 = 1.7983 * 18.0 / 98.0 - 1.0;

/// Secant slope (h(c′) − h(c))/(c′ − c) of the heat of solution, J/kg; the
/// derivative at c′ = c. Divided out by algebra: of the quotient of
/// differences no digit would be left in f32.
fn solution_heat_slope(c: f32, changed: f32) -> f32 {
    let below = (1.0 + THOMSEN_BEND * c) * (1.0 + THOMSEN_BEND * changed);
    return THOMSEN_SCALE * (1.0 - c - changed - THOMSEN_BEND * c * changed) / below;
}
