// Drops that bubbles threw up fly, fall back into liquid, or come to rest on glass, table or floor.
//!include common/chemistry/drops.wgsl
//!include common/chemistry/live_places.wgsl
//!include common/chemistry/spray_laws.wgsl
//!include common/glass/glass_distance.wgsl
//!include common/glass/ground.wgsl
//!include common/liquid/cells_around.wgsl
//!include common/liquid/list_reach.wgsl
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
@group(0) @binding(14) var<storage, read_write> drops: array<Drops>;
/// By identity: what drops did to a particle.
@group(0) @binding(15) var<storage, read_write> sprayed: array<atomic<i32>>;
/// By flask: quanta of drops that came to rest outside of it, having come from its liquid.
@group(0) @binding(16) var<storage, read_write> spray_left: array<atomic<u32>>;
@group(0) @binding(17) var<storage, read> live: array<u32>;

/// How near to a particle drops are in its liquid, over d, and how far they spread in it.
const JOINS: f32 = 0.75;
const SPREADS: f32 = 1.5;
/// Longest way of drops between two looks at what is solid and liquid, m: less than glass is thick. And most looks.
const STRIDE: f32 = 1.5e-3;
const MOST_LOOKS: f32 = 32.0;

fn stride() -> f32 {
    return min(STRIDE, JOINS * SPACING);
}

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

/// How deep under flask k's rim drops may be that have just come in at `x`, m: a stride, and what the flask rises in a step.
fn entrance(k: u32, x: vec3<f32>) -> f32 {
    let before = flask_from_stage(poses[step.before + k], x).y;
    let after = flask_from_stage(poses[step.after + k], x).y;
    return 2.0 * stride() + max(before - after, 0.0) * (step.bubble_time / step.time);
}

/// Into a flask and out of it there is only one way, over its rim; else glass that moves would pass through them.
fn place_after(within: u32, x: vec3<f32>) -> Place {
    if (within != NOBODYS) {
        if (is_inside(within - 1u, flask_from_stage(poses[step.after + within - 1u], x))) { return Place(within, is_solid(x)); }
    }
    let now = flask_around(x);
    if (now == within) { return Place(now, is_solid(x)); }
    let k = select(now, within, within != NOBODYS) - 1u;
    let over_rim = flask_from_stage(poses[step.after + k], x).y >= flasks[k].rim - entrance(k, x);
    return Place(now, !over_rim || is_solid(x));
}

/// The particle nearest to `x` within `reach`; COUNT for none.
fn nearest_to(x: vec3<f32>, reach: f32) -> u32 {
    var best = reach * reach;
    var found = COUNT;
    // As far may particles have moved since they were put into cells.
    let around = vec3<f32>(reach + LIST_REACH);
    let low = cell_of(x - around);
    let side = vec3<u32>(cell_of(x + around) - low + 1);
    for (var n = 0u; n < side.x * side.y * side.z; n++) {
        let run = run_of(low + vec3<i32>(vec3<u32>(n % side.x, n / side.x % side.y, n / (side.x * side.y))));
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

/// Gives drops to the liquid around them, to particles of the membership of particle `near`, the rest of the quanta to that.
fn join(flight: Drops, near: u32) {
    let reach = SPREADS * SPACING;
    var weight = 0.0;
    let cell = cell_of(flight.position);
    for (var n = 0u; n < count_around(1); n++) {
        let run = cell_around(cell, 1, n);
        for (var j = run.first; j < run.end; j++) {
            if (tags[j].x == tags[near].x) { weight += weight_at(position[j].xyz - flight.position, reach); }
        }
    }
    var left = vec3<i32>(
        quanta_of_drops(flight.mass, SPRAYED_QUANTUM), quanta_of_drops(flight.acid, SPRAYED_QUANTUM),
        quanta_of_drops(flight.enthalpy, SPRAYED_ENTHALPY_QUANTUM));
    let all = vec3<f32>(left);
    for (var n = 0u; n < count_around(1); n++) {
        let run = cell_around(cell, 1, n);
        for (var j = run.first; j < run.end; j++) {
            if (tags[j].x != tags[near].x || j == near) { continue; }
            let share = weight_at(position[j].xyz - flight.position, reach) / weight;
            if (share > 0.0) {
                let given = vec3<i32>(all * share);
                give(j, given);
                left -= given;
            }
        }
    }
    give(near, left);
}

fn weight_at(offset: vec3<f32>, reach: f32) -> f32 {
    let near = max(1.0 - dot(offset, offset) / (reach * reach), 0.0);
    return near * near;
}

fn give(j: u32, quanta: vec3<i32>) {
    let words = tags[j].y * SPRAYED_WORDS;
    atomicAdd(&sprayed[words], quanta.x);
    atomicAdd(&sprayed[words + 1u], quanta.y);
    atomicAdd(&sprayed[words + 2u], quanta.z);
}

/// The particle that drops are in and have not just left; COUNT for none.
fn met(flight: Drops) -> u32 {
    let j = nearest_to(flight.position, JOINS * SPACING);
    if (j < COUNT) {
        if (dot(flight.velocity - velocity[j].xyz, position[j].xyz - flight.position) <= 0.0) { return COUNT; }
    }
    return j;
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
    let n = id.x / 2u;
    if (n >= live[count_of_live()]) { return; }
    let place = 2u * live[n] + id.x % 2u;
    var flight = drops[place];
    if (flight.mass <= 0.0) { return; }
    let gravity = vec3<f32>(GRAVITY_X, GRAVITY_Y, GRAVITY_Z);
    let looks = clamp(ceil(length(flight.velocity) * step.bubble_time / stride()), 1.0, MOST_LOOKS);
    let time = step.bubble_time / looks;
    var within = flight.memberships >> 16u;
    var rests = false;
    var near = COUNT;
    for (var look = 0.0; look < looks && !rests && near == COUNT; look += 1.0) {
        flight.velocity = flown(flight.velocity, gravity, flight.radius, flight.density, time);
        let next = flight.position + flight.velocity * time;
        let after = place_after(within, next);
        rests = after.solid;
        if (!rests) {
            flight.position = next;
            within = after.within;
            near = met(flight);
        }
    }
    flight.memberships = (flight.memberships & 0xffffu) | (within << 16u);
    if (rests) {
        flight.fallen += vec3<f32>(flight.mass, flight.acid, flight.enthalpy);
        count_left(flight.mass, flight.memberships, within);
        flight.mass = 0.0;
    } else if (near < COUNT) {
        join(flight, near);
        count_left(flight.mass, flight.memberships, tags[near].x);
        flight.mass = 0.0;
    }
    drops[place] = flight;
}
