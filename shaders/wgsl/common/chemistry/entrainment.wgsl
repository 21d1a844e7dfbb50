// Liquid that a churning pool throws up (Kataoka and Ishii 1984, Int. J. Heat Mass Transfer 27, 1999): how much, how fast and in which
// drops. How much of it comes how high follows from the drops' flight.
//!include common/chemistry/spray_laws.wgsl

/// Superficial velocity over (σgΔρ/ρ²)^¼ from which on a pool churns (Kataoka and Ishii 1987): below it bubbles burst one by one.
const CHURNS: f32 = 0.5;
/// Viscosity of steam at 100 °C, Pa s.
const STEAM_VISCOSITY: f32 = 1.23e-5;
/// Volume of the liquid that is thrown up over that of the gas: what they have near the surface.
const THROWN_UP: f32 = 4.84e-3;
/// Mass of liquid over that of gas which passes the height where the momentum of drops no longer decides alone.
const AT_KINK: f32 = 1.0e-3;
/// Exponents of height above it and below it.
const ABOVE_KINK: f32 = 3.0;
const BELOW_KINK: f32 = 7.0;
/// j*/h* below which the exponent is 1: their region of low flux.
const LOW_FLUX: f32 = 6.39e-4;
/// Greatest height of a drop over that height.
const HIGHEST: f32 = 20.0;
/// Greatest diameter of a drop over the capillary length, and exponent of the mass of finer ones: chosen, as with them the fog that
/// gas carries away is of the order of what Kataoka and Ishii give.
const WIDEST_DROP: f32 = 2.3;
const FINER: f32 = 3.5;
/// Powers of the lots by which rare fast and small drops are drawn more often, with less mass each.
const FAST_LOTS: f32 = 6.0;
const SMALL_LOTS: f32 = 2.0;

/// Gas that rises from a pool.
struct Pool {
    /// Superficial velocity, m/s.
    speed: f32,
    /// Width of the vessel at the surface, m.
    width: f32,
    /// Density of the gas, kg/m³.
    gas_density: f32,
}

fn churns(pool: Pool, around: Around) -> bool {
    let scale = sqrt(sqrt(around.tension * GRAVITY / around.density));
    return GRAVITY > 0.0 && pool.speed >= CHURNS * scale;
}

/// Drops that go with `volume` of gas (m³), of one speed (upwards) and size by the lots `fast` and `small`. Heights follow from the speed
/// without drag. The mean mass over all lots is THROWN_UP times gas; the share that starts faster than for the height y h_t is
/// s y^-7 below y = 1, s y^-3 from there to where j*/h* is LOW_FLUX, and as y^-1 above that; at most 1, where s = AT_KINK over what is
/// thrown up.
fn entrained(volume: f32, pool: Pool, around: Around, fast: f32, small: f32) -> Burst {
    let ratio = pool.gas_density / around.density;
    let capillary = sqrt(around.tension / (around.density * GRAVITY));
    let number = STEAM_VISCOSITY * inverseSqrt(pool.gas_density * around.tension * capillary);
    let speed_scale = sqrt(sqrt(around.tension * GRAVITY * around.density)) * inverseSqrt(pool.gas_density);
    let high = 5.7e-4 * inverseSqrt(number) * pow(pool.width / capillary, -0.42) * pow(ratio, 0.10);
    let kink = capillary * pool.speed / (speed_scale * high);
    let at_kink = AT_KINK * ratio / THROWN_UP;
    let share = pow(fast, FAST_LOTS);
    let relative = at_kink / share;
    let low = high / LOW_FLUX;
    var height = pow(relative, 1.0 / select(BELOW_KINK, ABOVE_KINK, relative > 1.0));
    if (height > low) { height = relative / (low * low); }
    height = min(height, HIGHEST) * kink;
    let weight = FAST_LOTS * pow(fast, FAST_LOTS - 1.0) * SMALL_LOTS * pow(small, SMALL_LOTS - 1.0);
    let radius = 0.5 * WIDEST_DROP * capillary * pow(small, SMALL_LOTS / FINER);
    return Burst(radius, THROWN_UP * volume * weight / bubble_volume(radius), sqrt(2.0 * GRAVITY * height), radius_of_volume(volume));
}
