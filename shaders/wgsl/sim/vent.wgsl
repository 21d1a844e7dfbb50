// What steam left the liquid becomes puffs. Each workgroup gathers the steam
// of a share of the particles and of the bubbles, and lets it rise from one of them: that with
// the most, by lot, so that the puffs come from all over the surface.
// As the last pass of a frame that looks at bubbles, it also puts their passes to sleep where there are none.
//!include common/chemistry/bubble.wgsl
//!include common/chemistry/condensation.wgsl
//!include common/chemistry/features.wgsl
//!include common/chemistry/ledger.wgsl
//!include common/chemistry/particle_mass.wgsl
//!include common/chemistry/venting.wgsl
//!include common/liquid/particle.wgsl
//!include common/maths/lot.wgsl

/// Workgroups: puffs that a frame may bring.
override VENTS: u32 = 4u;
/// Whether the passes over bubbles may be dormant; else they look for bubbles in each of their steps.
override DORMANT_BUBBLES: bool = false;
override FLASKS: u32 = 0u;
/// Steam that makes a puff, kg; less waits for more.
override LEAST_PUFF: f32 = 5e-7;

@group(0) @binding(1) var<storage, read> position: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> tags: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read> ledger: array<vec4<f32>>;
/// By identity: steam's mass and enthalpy of which puffs were made.
@group(0) @binding(4) var<storage, read_write> vented: array<vec2<f32>>;
/// Puffs made, by workgroup; behind them what `dew.wgsl` counts.
@group(0) @binding(5) var<storage, read_write> made: array<u32>;

@group(0) @binding(6) var<storage, read_write> bubbles: array<Bubble>;
@group(0) @binding(7) var<storage, read_write> claims: array<u32>;
/// As `common/chemistry/live_places.wgsl` has it.
@group(0) @binding(8) var<storage, read> live: array<u32>;

const THREADS: u32 = 256u;

var<workgroup> sums: array<vec2<f32>, THREADS>;
var<workgroup> lots: array<f32, THREADS>;
/// Particles that drew them.
var<workgroup> drawers: array<u32, THREADS>;

/// Without a place that the frame's last step listed there is no bubble, no drop and nothing that comes to one; and the flow of gas,
/// of which `sim/live.wgsl` takes a mean, is and stays 0.
fn sleep_without_bubbles() {
    var busy = live[SLOTS] + live[SLOTS + 1u];
    for (var k = 0u; k < FLASKS; k++) {
        busy += select(0u, 1u, atomicLoad(&venting[k].quanta) > 0u || bitcast<u32>(venting[k].flow) != 0u);
    }
    if (busy == 0u) { claims[SLOTS + LIVE_GROUPS] = 0u; }
}

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_id) local: vec3<u32>) {
    if (DORMANT_BUBBLES) {
        if (group.x == 0u && local.x == 0u) { sleep_without_bubbles(); }
    }
    let first = group.x + VENTS * local.x;
    let number = made[group.x];
    var sum = vec2<f32>(0.0);
    var best = -1.0;
    var drawer = 0u;
    for (var i = first; i < COUNT; i += VENTS * THREADS) {
        let identity = tags[i].y;
        let gone = unpack_account(ledger[identity]).steam - vented[identity];
        sum += gone;
        let drawn = gone.x * lot(identity, number);
        if (drawn > best) {
            best = drawn;
            drawer = i;
        }
    }
    if (BUBBLES) {
        for (var slot = first; slot < SLOTS; slot += VENTS * THREADS) {
            let gone = bubbles[slot].gone - bubbles[slot].vented;
            sum += gone;
            let drawn = gone.x * lot(slot, number);
            if (drawn > best) {
                best = drawn;
                drawer = COUNT + slot;
            }
        }
    }
    sums[local.x] = sum;
    lots[local.x] = best;
    drawers[local.x] = drawer;
    workgroupBarrier();
    for (var half = THREADS / 2u; half > 0u; half >>= 1u) {
        if (local.x < half) {
            sums[local.x] += sums[local.x + half];
            if (lots[local.x + half] > lots[local.x]) {
                lots[local.x] = lots[local.x + half];
                drawers[local.x] = drawers[local.x + half];
            }
        }
        workgroupBarrier();
    }
    let steam = sums[0] * MASS;
    if (steam.x < LEAST_PUFF) { return; }
    for (var i = first; i < COUNT; i += VENTS * THREADS) {
        let identity = tags[i].y;
        vented[identity] = unpack_account(ledger[identity]).steam;
    }
    if (BUBBLES) {
        for (var slot = first; slot < SLOTS; slot += VENTS * THREADS) {
            // In both sets of records: a place that is empty is not copied from one to the other.
            bubbles[slot].vented = bubbles[slot].gone;
            bubbles[SLOTS + slot].vented = bubbles[slot].gone;
        }
    }
    if (local.x != 0u) { return; }
    var source: vec3<f32>;
    if (drawers[0] < COUNT) { source = position[drawers[0]].xyz; } else { source = bubbles[drawers[0] - COUNT].position; }
    // The liquid's tables count from water at 25 °C, and steam has 1.9 kJ/(kg K) in them.
    let temperature = (steam.y / steam.x - 2.442e6) / 1.9e3 + 25.0;
    var puff: Puff;
    puff.air = FIRST_AIR * steam.x;
    puff.water = steam.x + puff.air * ROOM_HUMIDITY;
    puff.enthalpy = steam.x * (VAPORISATION + VAPOUR_CAPACITY * temperature) + puff.air * ROOM_ENTHALPY;
    puff = condensed(puff);
    puff.position = source + vec3<f32>(0.0, puff.radius, 0.0);
    // Thermals of one place do not follow one another exactly.
    let turn = 2.0 * PI * lot(number, group.x);
    puff.drift = 0.2 * vec2<f32>(cos(turn), sin(turn));
    puffs[(number * VENTS + group.x) % PUFFS] = puff;
    made[group.x] = number + 1u;
}
