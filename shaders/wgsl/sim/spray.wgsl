// Drops that bubbles threw up fly, fall back into liquid, or come to rest on glass, table or floor.
//!include common/chemistry/drops.wgsl
//!include common/chemistry/spray_laws.wgsl
//!include common/glass/glass_distance.wgsl
//!include common/glass/ground.wgsl
//!include common/liquid/cells_around.wgsl
//!include common/liquid/particle.wgsl
//!include common/liquid/step.wgsl

/// Direction of gravity.
override GRAVITY_X: f32 = 0.0;
override GRAVITY_Y: f32 = -9.81;
override GRAVITY_Z: f32 = 0.0;
/// Particle spacing d, m.
override SPACING: f32 = 0.0025;

@group(0) @binding(0) var<storage, read> position: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> velocity: array<vec4<f32>>;
/// (membership, identity)
@group(0) @binding(2) var<storage, read> tags: array<vec2<u32>>;
@group(0) @binding(4) var<storage, read> cell_starts: array<u32>;
@group(0) @binding(5) var<storage, read> block_sums: array<u32>;
@group(0) @binding(14) var<storage, read_write> drops: array<Drops>;
/// By identity: what drops did to a particle.
@group(0) @binding(15) var<storage, read_write> sprayed: array<atomic<i32>>;
/// By flask: quanta of drops that came to rest outside of it, having come from its liquid.
@group(0) @binding(16) var<storage, read_write> spray_left: array<atomic<u32>>;

/// Longest way of drops between two looks at what is solid, m, and most looks.
const STRIDE: f32 = 1e-3;
const MOST_LOOKS: f32 = 64.0;
/// How near to a particle drops are in its liquid, over d.
const JOINS: f32 = 0.75;

/// The flask whose inside is at `x`, as membership; nobody's in none.
fn flask_around(x: vec3<f32>) -> u32 {
    for (var k = 0u; k < FLASKS; k++) {
        if (is_inside(k, flask_from_stage(poses[step.after + k], x))) { return k + 1u; }
    }
    return NOBODYS;
}

/// Whether table, floor or a flask's glass is at `x`.
fn is_solid(x: vec3<f32>) -> bool {
    if (x.y < FLOOR) { return true; }
    if (TABLE) {
        if (x.y > TABLE_UNDER && x.y < TABLE_TOP && beyond_table(x) < 0.0) { return true; }
    }
    for (var k = 0u; k < FLASKS; k++) {
        if (glass(k, flask_from_stage(poses[step.after + k], x)).distance < 0.0) { return true; }
    }
    return false;
}

/// Where drops are after a stride: in which flask, or against what is solid.
struct Place {
    within: u32,
    solid: bool,
}

/// Into a flask and out of it there is only one way, over its rim; else glass that moves would pass through them.
fn place_after(within: u32, x: vec3<f32>) -> Place {
    if (within != NOBODYS) {
        if (is_inside(within - 1u, flask_from_stage(poses[step.after + within - 1u], x))) { return Place(within, is_solid(x)); }
    }
    let now = flask_around(x);
    if (now == within) { return Place(now, is_solid(x)); }
    let k = select(now, within, within != NOBODYS) - 1u;
    let over_rim = flask_from_stage(poses[step.after + k], x).y >= flasks[k].rim - 2.0 * STRIDE;
    return Place(now, !over_rim || is_solid(x));
}

/// The particle nearest to `x` within `reach`; COUNT for none.
fn nearest_to(x: vec3<f32>, reach: f32) -> u32 {
    var best = reach * reach;
    var found = COUNT;
    let cell = cell_of(x);
    for (var n = 0u; n < count_around(1); n++) {
        let run = cell_around(cell, 1, n);
        for (var j = run.first; j < run.end; j++) {
            let offset = position[j].xyz - x;
            let square = dot(offset, offset);
            if (tags[j].x == REMOVED) { continue; }
            if (square < best || (square == best && j < found)) {
                best = square;
                found = j;
            }
        }
    }
    return found;
}

/// Counts drops that came to rest in `where_now` and not in the flask they came from.
fn count_left(mass: f32, memberships: u32, where_now: u32) {
    let source = memberships & 0xffffu;
    if (source != NOBODYS && source != where_now) {
        atomicAdd(&spray_left[source - 1u], u32(quanta_of_drops(mass, LEFT_QUANTUM)));
    }
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let place = id.x;
    var flight = drops[place];
    if (flight.mass <= 0.0) { return; }
    let gravity = vec3<f32>(GRAVITY_X, GRAVITY_Y, GRAVITY_Z);
    let way = length(flight.velocity) * step.bubble_time;
    let looks = clamp(ceil(way / STRIDE), 1.0, MOST_LOOKS);
    let time = step.bubble_time / looks;
    var within = flight.memberships >> 16u;
    var rests = false;
    for (var n = 0.0; n < looks && !rests; n += 1.0) {
        flight.velocity = flown(flight.velocity, gravity, flight.radius, flight.density, time);
        let next = flight.position + flight.velocity * time;
        let after = place_after(within, next);
        rests = after.solid;
        if (!rests) {
            flight.position = next;
            within = after.within;
        }
    }
    flight.memberships = (flight.memberships & 0xffffu) | (within << 16u);
    if (rests) {
        flight.fallen += vec3<f32>(flight.mass, flight.acid, flight.enthalpy);
        count_left(flight.mass, flight.memberships, within);
        flight.mass = 0.0;
    } else {
        let j = nearest_to(flight.position, JOINS * SPACING);
        if (j < COUNT) {
            let towards = dot(flight.velocity - velocity[j].xyz, position[j].xyz - flight.position);
            if (towards > 0.0) {
                let words = tags[j].y * SPRAYED_WORDS;
                atomicAdd(&sprayed[words], quanta_of_drops(flight.mass, SPRAYED_QUANTUM));
                atomicAdd(&sprayed[words + 1u], quanta_of_drops(flight.acid, SPRAYED_QUANTUM));
                atomicAdd(&sprayed[words + 2u], quanta_of_drops(flight.enthalpy, SPRAYED_ENTHALPY_QUANTUM));
                count_left(flight.mass, flight.memberships, tags[j].x);
                flight.mass = 0.0;
            }
        }
    }
    drops[place] = flight;
}
