// Air with vapour in it at the room's pressure: `chemistry/puff.rs` in f32.

const PRESSURE: f32 = 101325.0;
const AIR_CONSTANT: f32 = 287.05;
const VAPOUR_CONSTANT: f32 = 461.5;
const VAPOUR_CAPACITY: f32 = 1860.0;
const WATER_CAPACITY: f32 = 4186.0;
const VAPORISATION: f32 = 2.501e6;
const KELVIN: f32 = 273.15;

fn saturation_pressure(t: f32) -> f32 {
    return 610.94 * exp(17.625 * t / (t + 243.04));
}

fn dew_point(ratio: f32) -> f32 {
    let pressure = PRESSURE * ratio / (AIR_CONSTANT / VAPOUR_CONSTANT + ratio);
    let logarithm = log(pressure / 610.94);
    return 243.04 * logarithm / (17.625 - logarithm);
}

/// Vapour over dry air when saturated, of a pressure below the room's.
fn saturation_ratio(pressure: f32) -> f32 {
    return AIR_CONSTANT / VAPOUR_CONSTANT * pressure / (PRESSURE - pressure);
}
