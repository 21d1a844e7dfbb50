// Puffs of steam rise through a frame, take in air and condense
// (`Puff::advance` of `chemistry/puff.rs`).
//!include common/chemistry/condensation.wgsl
//!include common/chemistry/dew.wgsl
//!include common/liquid/gravity.wgsl

/// Δt of a step (s) and how many a frame has.
override STEP_TIME: f32 = 0.0028;
override STEPS: u32 = 4u;

/// Whether steam condenses on glass, and T of what is around, °C.
override DEW: bool = false;
override AMBIENT: f32 = 20.0;

/// Quanta that walls took of each puff in this frame.
@group(0) @binding(1) var<storage, read_write> taken: array<u32>;

/// Radius beyond which a puff is room air, m.
const DISPERSED: f32 = 0.5;
/// Dry air over water beyond which a puff without mist has none to come.
const THIN: f32 = 60.0;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x >= PUFFS) { return; }
    var puff = puffs[id.x];
    if (puff.radius <= 0.0) { return; }
    if (DEW) {
        let gone = f32(taken[id.x]) * DEW_QUANTUM;
        taken[id.x] = 0u;
        puff.water -= gone;
        puff.enthalpy -= gone * (VAPORISATION + VAPOUR_CAPACITY * AMBIENT);
    }
    for (var step = 0u; step < STEPS; step++) {
        let volume = 4.0 / 3.0 * PI * puff.radius * puff.radius * puff.radius;
        let displaced = ROOM_DENSITY * volume;
        puff.momentum += GRAVITY * (displaced - puff.air - puff.water) * STEP_TIME;
        let speed = puff.momentum / (puff.air + puff.water + VIRTUAL_MASS * displaced);
        puff.position += vec3<f32>(puff.drift.x, 1.0, puff.drift.y) * (speed * STEP_TIME);
        let surface = 4.0 * PI * puff.radius * puff.radius;
        let entrained = ROOM_DENSITY * surface * ENTRAINMENT * abs(speed) * STEP_TIME;
        let air = entrained / (1.0 + ROOM_HUMIDITY);
        puff.air += air;
        puff.water += air * ROOM_HUMIDITY;
        puff.enthalpy += air * ROOM_ENTHALPY;
        puff = condensed(puff);
    }
    let vanished = puff.mist <= 0.0 && puff.air > THIN * (puff.water - puff.air * ROOM_HUMIDITY);
    if (vanished || puff.radius > DISPERSED) {
        puff.radius = 0.0;
        puff.mist = 0.0;
        puff.depth = 0.0;
    }
    puffs[id.x] = puff;
}
