// Puffs of steam rise through a frame, take in air and condense
// (`Puff::advance` of `chemistry/puff.rs`).
//!include common/chemistry/condensation.wgsl
//!include common/liquid/gravity.wgsl

/// Δt of a step (s) and how many a frame has.
override STEP_TIME: f32 = 0.0028;
override STEPS: u32 = 4u;

/// Radius beyond which a puff is room air, m.
const DISPERSED: f32 = 0.5;
/// Dry air over water beyond which a puff without mist has none to come.
const THIN: f32 = 60.0;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x >= PUFFS) { return; }
    var puff = puffs[id.x];
    if (puff.radius <= 0.0) { return; }
    for (var step = 0u; step < STEPS; step++) {
        let volume = 4.0 / 3.0 * PI * puff.radius * puff.radius * puff.radius;
        let displaced = ROOM_DENSITY * volume;
        puff.momentum += GRAVITY * (displaced - puff.air - puff.water) * STEP_TIME;
        let speed = puff.momentum / (puff.air + puff.water + VIRTUAL_MASS * displaced);
        puff.position += vec3<f32>(puff.drift.x, 1.0, puff.drift.y) * (speed * STEP_TIME);
        let surface = 4.0 * PI * puff.radius * puff.radius;
        let taken = ROOM_DENSITY * surface * ENTRAINMENT * abs(speed) * STEP_TIME;
        let air = taken / (1.0 + ROOM_HUMIDITY);
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
