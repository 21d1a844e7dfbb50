// Steam that condenses on the vessels' inner walls, and evaporates again, in a frame: a thread a place of a wall
// (`chemistry/dew.rs` in f64). A place is in the air of the most humid puff that reaches it, else in the room's; it gathers,
// and what it takes from a puff is summed in whole quanta, so that no result depends on an order. `rise.wgsl` takes that out of the puff.
//!include common/chemistry/compensated.wgsl
//!include common/chemistry/dew.wgsl
//!include common/chemistry/humid_air.wgsl
//!include common/chemistry/puff.wgsl
//!include common/glass/vessel.wgsl

/// Δt_f, s.
override FRAME_TIME: f32 = 0.0111;
/// How many puffs there are, and workgroups that make them.
override PUFFS: u32 = 1024u;
override VENTS: u32 = 4u;
/// T of what is around, °C, and the pressure of the vapour in its air, Pa.
override AMBIENT: f32 = 20.0;
override ROOM_VAPOUR: f32 = 1170.0;
/// Mass transfer to the room's still air, m/s, and by a puff that moves, over √(its speed / its width), m/√s.
override STILL: f32 = 0.0055;
override SWEPT: f32 = 0.0039;
/// Heat that the outer air takes, W/(m² K).
override DEW_LOSS: f32 = 12.0;
/// Heat that water evolves where it condenses, J/kg.
override LATENT: f32 = 2.454e6;
/// Of the room's air, kg/m³.
override ROOM_DENSITY: f32 = 1.2;

@group(0) @binding(0) var<storage, read> puffs: array<Puff>;
@group(0) @binding(1) var<storage, read_write> dew: array<Dew>;
/// By puff: quanta that walls took from it.
@group(0) @binding(2) var<storage, read_write> taken: array<atomic<u32>>;
/// By flask and row: a bit a place that liquid touched in this frame.
@group(0) @binding(3) var<storage, read_write> wetted: array<atomic<u32>>;
/// By flask and ring: T, °C.
@group(0) @binding(4) var<storage, read> glass: array<vec2<f32>>;
@group(0) @binding(5) var<storage, read> dew_rows: array<DewRow>;
/// Behind what `vent.wgsl` counts, quanta that liquid washed off: low and high word.
@group(0) @binding(6) var<storage, read_write> made: array<atomic<u32>>;

/// Most of the room's pressure that vapour has: near the boiling point the flux has no bound.
const MOST_PRESSURE: f32 = 0.98;
/// Most of what a puff can give that it gives in a frame, over all places that it reaches.
const MOST_TAKEN: f32 = 0.5;
const TAU: f32 = 6.2831853;
const THREADS: u32 = 256u;

/// Puffs that may reach the flask: in any order.
var<workgroup> near: array<u32, 1024>;
var<workgroup> near_count: atomic<u32>;
var<workgroup> wet: array<u32, 8>;

/// Pressure of the vapour in a puff, Pa.
fn vapour_in(puff: Puff) -> f32 {
    let ratio = (puff.water - puff.mist) / max(puff.air, 1e-12);
    return min(PRESSURE * ratio / (AIR_CONSTANT / VAPOUR_CONSTANT + ratio), MOST_PRESSURE * PRESSURE);
}

/// kg/(m² s) that leaves a wall of that temperature into air of that vapour and temperature; negative where it condenses.
fn flux_from_wall(wall: f32, vapour: f32, air: f32, transfer: f32) -> f32 {
    let saturated = min(saturation_pressure(wall), MOST_PRESSURE * PRESSURE);
    let film = 0.5 * (wall + air) + KELVIN;
    return transfer * PRESSURE / (VAPOUR_CONSTANT * film) * log((PRESSURE - vapour) / (PRESSURE - saturated));
}

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) n: u32) {
    let first = group.x * THREADS;
    let k = first / (DEW_AROUND * DEW_UP);
    let pose = poses[step.after + k];
    // Memory of a workgroup begins with anything.
    if (n == 0u) { atomicStore(&near_count, 0u); }
    workgroupBarrier();
    for (var i = n; i < PUFFS; i += THREADS) {
        let puff = puffs[i];
        if (puff.radius > 0.0) {
            // Of those that are in the vessel or over its mouth.
            let p = flask_from_stage(pose, puff.position);
            let beside = dot(p.xz, p.xz) >= flasks[k].outer * flasks[k].outer;
            if (!beside && p.y > 0.0 && p.y - puff.radius < flasks[k].rim) {
                near[atomicAdd(&near_count, 1u)] = i;
            }
        }
    }
    if (n < 8u) { wet[n] = atomicExchange(&wetted[first / DEW_AROUND + n], 0u); }
    workgroupBarrier();

    let place = first + n;
    let row = dew_rows[place / DEW_AROUND];
    let around = place % DEW_AROUND;
    let angle = TAU * (f32(around) + 0.5) / f32(DEW_AROUND);
    let x = stage_from_flask(pose, vec3<f32>(row.radius * cos(angle), row.height, row.radius * sin(angle)));
    var vapour = ROOM_VAPOUR;
    var source = PUFFS;
    let count = atomicLoad(&near_count);
    for (var m = 0u; m < count; m++) {
        let i = near[m];
        let offset = x - puffs[i].position;
        if (dot(offset, offset) < puffs[i].radius * puffs[i].radius) {
            let here = vapour_in(puffs[i]);
            if (here > vapour || (here == vapour && i < source)) {
                vapour = here;
                source = i;
            }
        }
    }

    var own = dew[place];
    // Two rings of the glass a row.
    let base = 0.5 * (glass[2u * (place / DEW_AROUND)].x + glass[2u * (place / DEW_AROUND) + 1u].x);
    let wall = base + own.excess;
    var air = AMBIENT;
    var transfer = STILL;
    var most = f32(0x7fffff00u - own.water);
    if (source < PUFFS) {
        let puff = puffs[source];
        air = max(air, dew_point(AIR_CONSTANT / VAPOUR_CONSTANT * vapour / (PRESSURE - vapour)));
        let volume = 2.0 / 3.0 * TAU * puff.radius * puff.radius * puff.radius;
        let speed = abs(puff.momentum) / (puff.air + puff.water + VIRTUAL_MASS * ROOM_DENSITY * volume);
        transfer = max(transfer, SWEPT * sqrt(speed / (2.0 * puff.radius)));
        let saturated = min(saturation_pressure(wall), MOST_PRESSURE * PRESSURE);
        let held = puff.air * saturation_ratio(saturated);
        let reached = row.area / (2.0 * TAU * puff.radius * puff.radius);
        most = min(most, MOST_TAKEN * max(puff.water - held, 0.0) * min(reached, 1.0) / DEW_QUANTUM);
    }
    let gained = -flux_from_wall(wall, vapour, air, transfer) * row.area * FRAME_TIME / DEW_QUANTUM;
    var quanta = i32(clamp(round(gained), -f32(own.water), most));
    quanta = max(quanta, -i32(own.water));
    // What liquid washes off is gone, as it is too little for the liquid to gain by; none condenses behind it.
    let is_wet = (wet[n / DEW_AROUND] & (1u << around)) != 0u;
    if (is_wet) {
        quanta = 0;
        let before = atomicAdd(&made[VENTS], own.water);
        if (before > 0xffffffffu - own.water) { atomicAdd(&made[VENTS + 1u], 1u); }
    }
    if (quanta > 0 && source < PUFFS) { atomicAdd(&taken[source], u32(quanta)); }
    let mass = f32(quanta) * DEW_QUANTUM / row.area;
    let warmed = (LATENT * mass - DEW_LOSS * own.excess * FRAME_TIME) / row.capacity;
    let sum = compensated(Compensated(own.excess, own.lacking), warmed);
    let water = select(u32(i32(own.water) + quanta), 0u, is_wet);
    dew[place] = Dew(water, sum.value, sum.lacking, f32(water) * DEW_QUANTUM / row.area);
}
