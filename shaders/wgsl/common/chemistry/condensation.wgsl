// Steam in the room's air: `chemistry/puff.rs` in f32.
//!include common/chemistry/humid_air.wgsl
//!include common/chemistry/puff.wgsl

@group(0) @binding(0) var<storage, read_write> puffs: array<Puff>;

/// How many puffs there are.
override PUFFS: u32 = 1024u;

/// The room's air: vapour over dry air; enthalpy (J) per kg of dry air; density (kg/m³).
override ROOM_HUMIDITY: f32 = 0.0073;
override ROOM_ENTHALPY: f32 = 38600.0;
override ROOM_DENSITY: f32 = 1.2;

const FIRST_AIR: f32 = 0.1;
const ENTRAINMENT: f32 = 0.25;
const AIR_CAPACITY: f32 = 1006.0;
const DROPLET_RADIUS: f32 = 5e-6;
const WATER_DENSITY: f32 = 1000.0;
const PI: f32 = 3.14159265;

/// The puff with the mist, radius and optical depth of what it holds.
fn condensed(before: Puff) -> Puff {
    var puff = before;
    let gaseous = puff.air * AIR_CAPACITY + puff.water * VAPOUR_CAPACITY;
    var t = (puff.enthalpy - puff.water * VAPORISATION) / gaseous;
    puff.mist = 0.0;
    let dry = saturation_pressure(t);
    if (dry < PRESSURE) {
        if (puff.air * saturation_ratio(dry) < puff.water) {
            t = dew_point(puff.water / puff.air);
            let fixed = puff.air * AIR_CAPACITY + puff.water * WATER_CAPACITY;
            for (var step = 0u; step < 5u; step++) {
                let pressure = saturation_pressure(t);
                let vapour = puff.air * saturation_ratio(pressure);
                let steeper = 17.625 * 243.04 / ((t + 243.04) * (t + 243.04)) * PRESSURE / (PRESSURE - pressure);
                let evaporation = VAPORISATION + (VAPOUR_CAPACITY - WATER_CAPACITY) * t;
                let slope = fixed + vapour * (VAPOUR_CAPACITY - WATER_CAPACITY) + vapour * steeper * evaporation;
                t -= (fixed * t + vapour * evaporation - puff.enthalpy) / slope;
            }
            puff.mist = max(puff.water - puff.air * saturation_ratio(saturation_pressure(t)), 0.0);
        }
    }
    let gas = puff.air * AIR_CONSTANT + (puff.water - puff.mist) * VAPOUR_CONSTANT;
    puff.radius = pow(0.75 / PI * gas * (t + KELVIN) / PRESSURE, 1.0 / 3.0);
    puff.depth = 1.5 * puff.mist / (PI * WATER_DENSITY * DROPLET_RADIUS * puff.radius * puff.radius);
    return puff;
}
