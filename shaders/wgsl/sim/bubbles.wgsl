// Bubbles: a population beside the particles, which the liquid's neighbour search does not know. A bubble of steam is born at a
// particle that is superheated, one of air at one with which a stream plunges into liquid. It takes steam from the particles around
// it, or gives it back to colder ones; it rises, joins others, and bursts at the surface, from which it throws up drops. What it
// takes and gives, and its volume, are added to the particles in whole quanta; they take them over with line 26, and their volume
// with line 1.
//!include common/chemistry/bubble.wgsl
//!include common/chemistry/bubble_surroundings.wgsl
//!include common/chemistry/bubbled.wgsl
//!include common/chemistry/features.wgsl
//!include common/chemistry/live_places.wgsl
//!include common/chemistry/plunging.wgsl
//!include common/chemistry/quanta_sum.wgsl
//!include common/chemistry/throwing.wgsl
//!include common/glass/boundary.wgsl
//!include common/liquid/cells_around.wgsl
//!include common/liquid/counters.wgsl
//!include common/liquid/particle.wgsl
//!include common/liquid/step.wgsl
//!include common/maths/lot.wgsl

/// How long a bubble stays at the surface, s.
override FOAM_TIME: f32 = 0.1;
/// Direction of gravity.
override GRAVITY_X: f32 = 0.0;
override GRAVITY_Y: f32 = -9.81;
override GRAVITY_Z: f32 = 0.0;

@group(0) @binding(0) var<storage, read> position: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> velocity: array<vec4<f32>>;
/// (membership, identity)
@group(0) @binding(2) var<storage, read> tags: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read> heat: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read> cell_starts: array<u32>;
@group(0) @binding(6) var<storage, read> boils: array<vec4<f32>>;
@group(0) @binding(7) var<storage, read> gas: array<vec4<f32>>;
/// Those before this step, and after it.
@group(0) @binding(8) var<storage, read_write> bubbles: array<Bubble>;
@group(0) @binding(9) var<storage, read_write> bubbled: array<atomic<i32>>;
/// By slot: one more than the particle at which a bubble is to be born, and whether it is of air.
@group(0) @binding(10) var<storage, read_write> claims: array<u32>;
/// By step and slot: quanta of steam, enthalpy and air of what joins the bubble.
@group(0) @binding(11) var<storage, read_write> merging: array<atomic<i32>>;
@group(0) @binding(12) var<storage, read_write> counters: Counters;
/// By identity, see `sim/forces.wgsl`.
@group(0) @binding(17) var<storage, read> falls: array<vec2<f32>>;
@group(0) @binding(19) var<storage, read> live: array<u32>;

/// Particle spacing d, m.
override SPACING: f32 = 0.0025;

/// Radius of a nucleus, and that below which a bubble is gone, m.
const NUCLEUS: f32 = 3e-4;
const VANISHED: f32 = 1e-4;
/// Where fewer neighbours than this are above, over a full neighbourhood's, a bubble is at the surface.
const COVERED: f32 = 0.7;
/// Share of solid space around a bubble from which on glass holds it back.
const AT_GLASS: f32 = 0.2;
/// Share of solid space, a support radius below a particle that plunges, from which on it takes no air down.
const BESIDE_GLASS: f32 = 0.01;
/// Most steam that all bubbles around a particle exchange with it in a step, V0·ρ0, and over what its superheat makes. How many bubbles
/// there are is known of the step before; since then they may be more by what a radius grows, and a word of quanta holds 8 times that.
const MOST_EXCHANGED: f32 = 0.03;
const MOST_OF_SUPERHEAT: f32 = 0.5;
/// Most gas that a bubble gives a particle, V0: many times what it can hold, and a word of quanta holds it of 256 bubbles.
const MOST_GIVEN: f32 = 8.0;
/// Cells around its own that a bubble reaches at most.
const MOST_CELLS: i32 = 3;

var<workgroup> claimed: array<u32, 64>;
var<workgroup> joined: array<vec3<i32>, 64>;

/// What a bubble would exchange in a step if no other did: steam that it takes per kelvin of superheat, and that it
/// gives per kelvin of subcooling, V0·ρ0/(s K).
struct Conductance {
    taken: f32,
    given: f32,
    /// Whether it collapses altogether.
    vanishes: bool,
}

fn conductance_of(bubble: Bubble, s: Surrounding, around: Around, time: f32) -> Conductance {
    let density = steam_density(temperature_of(bubble));
    let relative = length(bubble.velocity - s.velocity);
    let unit = 4.0 / 3.0 * BUBBLE_PI * density / MASS;
    let cube = bubble.radius * bubble.radius * bubble.radius;
    var c: Conductance;
    if (s.superheat > 0.0) {
        // More than 20 K of superheat would bring it further: in a step it reaches the next particles.
        let r = min(grown(bubble.radius, s.superheat, s.growing, relative, density, around, time), bubble.radius + SPACING);
        c.taken = unit * (r * r * r - cube) / (time * s.superheat);
    }
    if (s.subcooling > 0.0) {
        let r = collapsed(bubble.radius, s.subcooling, s.shrinking, relative, density, around, time);
        c.given = unit * (cube - r * r * r) / (time * s.subcooling);
        c.vanishes = r < VANISHED && s.subcooling > s.superheat;
        // Of a bubble of air the last steam condenses whole: its few quanta would have no temperature.
        if (bubble.air > 0.0) { c.vanishes = bubble.mass > 0.0 && c.given * time * s.subcooling >= bubble.mass; }
        if (c.vanishes) { c.given = bubble.mass / (time * s.subcooling); }
        // No more than there is.
        c.given = min(c.given, bubble.mass / (time * s.subcooling));
    }
    return c;
}

/// Steam and enthalpy that a bubble gained, over V0·ρ0 and J per V0·ρ0.
struct Gained {
    mass: f32,
    enthalpy: f32,
}

/// Exchanges steam with the particles around and gives them its volume; all lanes must ask.
fn scatter(bubble: Bubble, s: Surrounding, c: Conductance, reach: f32, cells: i32, lane: u32, time: f32) -> Gained {
    var mass: QuantaSum;
    var enthalpy: QuantaSum;
    let cell = cell_of(bubble.position);
    let count = select(0u, count_around(cells), is_there(bubble) && s.weight > 0.0);
    let own_specific = bubble.enthalpy / max(bubble.mass, 1e-20);
    let stirring = 2.0 * bubble.radius * length(bubble.velocity - s.velocity);
    let gas_share = bubble_volume(bubble.radius) / (VOLUME * max(s.weight, 1e-12));
    for (var n = lane; n < count; n += LANES) {
        let run = cell_around(cell, cells, n);
        for (var j = run.first; j < run.end; j++) {
            let offset = position[j].xyz - bubble.position;
            let square = dot(offset, offset);
            let tag = tags[j];
            if (square >= reach * reach || tag.x != bubble.membership) { continue; }
            let weight = share_at(square / (reach * reach));
            let boil = boils[j];
            let share = contact_at(square, bubble.radius) / max(s.contact, 1e-12);
            let words = tag.y * BUBBLED_WORDS;
            let given = min(weight * gas_share, MOST_GIVEN);
            atomicAdd(&bubbled[words + BUBBLED_GAS], quanta(given, GAS_QUANTUM));
            atomicAdd(&bubbled[words + BUBBLED_STIRRING], quanta(given * stirring, STIRRING_QUANTUM));
            let conductance = share * select(c.given, c.taken, boil.x > 0.0);
            if (conductance <= 0.0) { continue; }
            atomicAdd(&bubbled[words + BUBBLED_CONDUCTANCE], quanta(conductance, CONDUCTANCE_QUANTUM));
            // All bubbles around a particle draw on what its superheat can make.
            let all = max(gas[tag.y].z, conductance);
            let rate = all / max(boil.y, 1e-12) * time;
            var limit = 1.0;
            if (rate > 1e-4) { limit = (1.0 - exp(-rate)) / rate; }
            let most = min(MOST_EXCHANGED, MOST_OF_SUPERHEAT * boil.y * abs(boil.x));
            limit = min(limit, most / max(all * abs(boil.x) * time, 1e-12));
            if (c.vanishes) { limit = 1.0; }
            let taken = conductance * boil.x * time * limit;
            // Steam comes with the boiling point that the liquid around the bubble has.
            let specific = select(own_specific, steam_enthalpy(heat[j].x - boil.x), boil.x > 0.0);
            let steam = quanta(taken, MASS_QUANTUM);
            let heat_of_steam = quanta(f32(steam) * MASS_QUANTUM * specific, ENTHALPY_QUANTUM);
            atomicSub(&bubbled[words + BUBBLED_MASS], steam);
            atomicSub(&bubbled[words + BUBBLED_ENTHALPY], heat_of_steam);
            mass = added(mass, steam);
            enthalpy = added(enthalpy, heat_of_steam);
        }
    }
    return Gained(lane_sum_of_quanta(mass, MASS_QUANTUM), lane_sum_of_quanta(enthalpy, ENTHALPY_QUANTUM));
}

/// Takes steam of the particle with that identity, or gives it.
fn exchange_with(identity: u32, steam: i32, enthalpy: i32) {
    atomicSub(&bubbled[identity * BUBBLED_WORDS + BUBBLED_MASS], steam);
    atomicSub(&bubbled[identity * BUBBLED_WORDS + BUBBLED_ENTHALPY], enthalpy);
}

/// T of what a bubble holds, °C: the few quanta of steam that a bubble of air may have would have none by themselves.
fn temperature_of(bubble: Bubble) -> f32 {
    if (bubble.mass <= 0.0) { return bubble.air_temperature; }
    let steam = steam_temperature(bubble.enthalpy / bubble.mass);
    return (bubble.mass * steam + bubble.air * bubble.air_temperature) / (bubble.mass + bubble.air);
}

fn volume_of(bubble: Bubble) -> f32 {
    let steam = steam_volume(bubble.mass, bubble.enthalpy);
    return steam + bubble.air * MASS / steam_density(bubble.air_temperature);
}

/// Air that particle i took down, in one bubble.
fn taken_along(before: Bubble, i: u32) -> Bubble {
    var bubble = before;
    let fall = falls[tags[i].y];
    let volume = max(taken_down(-fall.x, fall.y) * VOLUME, bubble_volume(radius_of_air(tags[i].y, fall.x)));
    bubble.air_temperature = heat[i].x;
    bubble.air = volume * steam_density(heat[i].x) / MASS;
    return bubble;
}

/// A nucleus at particle i.
fn born(before: Bubble, i: u32, of_air: bool) -> Bubble {
    var bubble = before;
    bubble.position = position[i].xyz;
    bubble.velocity = velocity[i].xyz;
    bubble.membership = tags[i].x;
    bubble.surfaced = 0.0;
    bubble.touching = 0.0;
    if (of_air) { return taken_along(bubble, i); }
    let temperature = heat[i].x;
    let volume = 4.0 / 3.0 * BUBBLE_PI * NUCLEUS * NUCLEUS * NUCLEUS;
    let steam = quanta(volume * steam_density(temperature) / MASS, MASS_QUANTUM);
    bubble.mass = f32(steam) * MASS_QUANTUM;
    let enthalpy = quanta(bubble.mass * steam_enthalpy(temperature), ENTHALPY_QUANTUM);
    bubble.enthalpy = f32(enthalpy) * ENTHALPY_QUANTUM;
    return bubble;
}

/// A place whose bubble is gone.
fn emptied(before: Bubble) -> Bubble {
    var bubble = before;
    bubble.mass = 0.0;
    bubble.enthalpy = 0.0;
    bubble.air = 0.0;
    return bubble;
}

/// Velocity without what would carry it into glass.
fn beside_glass(v: vec3<f32>, wall: vec4<f32>) -> vec3<f32> {
    let slope = wall_gradient(wall);
    let steepness = length(slope);
    if (wall_volume(wall) < AT_GLASS || steepness <= 0.0) { return v; }
    let into = slope / steepness;
    return v - into * max(dot(v, into), 0.0);
}

/// What covers a bubble, with what glass hides beside it and what is of glass above it.
fn cover_of(cover: f32, wall: vec4<f32>, up: vec3<f32>) -> f32 {
    // Without weight there is no surface above.
    if (all(up == vec3<f32>(0.0))) { return 1.0; }
    let slope = wall_gradient(wall);
    let above = max(dot(slope, up), 0.0) / max(length(slope), 1e-9);
    return cover / max(1.0 - wall_volume(wall), 0.3) + 2.0 * wall_volume(wall) * above;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let is_idle = id.x / LANES >= live[count_of_live()];
    let slot = live[select(id.x / LANES, 0u, is_idle)];
    let lane = id.x % LANES;
    let of_group = local / LANES;
    let first = step.before_bubbles;
    let other_first = SLOTS - first;
    if (lane == 0u && !is_idle) {
        claimed[of_group] = claims[slot];
        let words = 3u * (first + slot);
        for (var k = 0u; k < 3u; k++) {
            joined[of_group][k] = atomicLoad(&merging[words + k]);
            atomicStore(&merging[words + k], 0);
        }
        claims[slot] = 0u;
    }
    workgroupBarrier();
    if (is_idle) { return; }
    let claim = claimed[of_group] & ~CLAIM_OF_AIR;
    let of_air = (claimed[of_group] & CLAIM_OF_AIR) != 0u;
    let joins = joined[of_group];
    let time = step.bubble_time;
    let gravity = vec3<f32>(GRAVITY_X, GRAVITY_Y, GRAVITY_Z);
    let up = -gravity / max(length(gravity), 1e-9);

    var bubble = bubbles[first + slot];
    bubble.mass += f32(joins.x) * JOINED_MASS_QUANTUM;
    bubble.enthalpy += f32(joins.y) * JOINED_ENTHALPY_QUANTUM;
    bubble.air += f32(joins.z) * JOINED_MASS_QUANTUM;
    let is_born = !is_there(bubble) && claim > 0u;
    if (is_born) { bubble = born(bubble, claim - 1u, of_air); }
    bubble.radius = radius_of_volume(volume_of(bubble));
    // All lanes of a place return alike.
    if (!is_there(bubble)) {
        if (lane == 0u) { bubbles[other_first + slot] = bubble; }
        return;
    }
    // A stream that is stopped by glass, under a film or none, closes no air in: it needs depth.
    let takes_air = is_born && of_air;
    let ahead = select(vec3<f32>(0.0), -SUPPORT * up, takes_air);
    let wall = boundary_volume(bubble.membership, bubble.position + ahead, step.after, lane);
    // Of a map's wall only lane 0 has the volume, and all lanes must decide alike.
    let stopped = lane_max(u32(takes_air && wall_volume(wall) > BESIDE_GLASS)) > 0u;
    if (stopped) {
        if (lane == 0u) { bubbles[other_first + slot] = emptied(bubble); }
        return;
    }
    let cells = clamp(i32(ceil((SUPPORT + bubble.radius) / CELL)), 1, MOST_CELLS);
    let reach = min(SUPPORT + bubble.radius, f32(cells) * SUPPORT);

    let s = gather(bubble, slot, first, reach, cells, lane, up);
    if (s.weight > 0.0) { bubble.air_temperature = s.temperature; }
    let around = around_of(s.acid, s.temperature);
    let bursts = bubble.surfaced > FOAM_TIME;
    if (SPRAY) {
        var jet: Burst;
        var film: Burst;
        if (bursts && s.contact > 0.0) {
            jet = jet_of(bubble.radius, around);
            film = film_of(bubble.radius, around);
        }
        spray(bubble, slot, OF_JET, jet, s, around, reach, cells, lane, up);
        spray(bubble, slot, OF_FILM, film, s, around, reach, cells, lane, up);
    }
    var c: Conductance;
    if (!bursts) { c = conductance_of(bubble, s, around, time); }
    let gained = scatter(bubble, s, c, reach, cells, lane, time);
    if (lane != 0u) { return; }
    let nearest = tags[s.nearest.particle].y;
    if (is_born && !of_air) {
        exchange_with(tags[claim - 1u].y, quanta(bubble.mass, MASS_QUANTUM), quanta(bubble.enthalpy, ENTHALPY_QUANTUM));
    } else if (claim > 0u && !is_born) {
        atomicAdd(&counters.bubbles_refused, 1u);
    }
    bubble.mass = max(bubble.mass + gained.mass, 0.0);
    bubble.enthalpy += gained.enthalpy;
    let alone = s.weight <= 0.0;
    if (c.vanishes && !alone && bubble.mass < MOST_AT_ONCE) {
        exchange_with(nearest, -quanta(bubble.mass, MASS_QUANTUM), -quanta(bubble.enthalpy, ENTHALPY_QUANTUM));
        bubble.mass = 0.0;
        bubble.enthalpy = 0.0;
        if (bubble.air <= 0.0) {
            bubbles[other_first + slot] = bubble;
            return;
        }
    }

    let at_surface = cover_of(s.cover, wall, up) < COVERED;
    // What new ones push under for a moment is no younger for it.
    bubble.surfaced = max(bubble.surfaced + select(-time, time, at_surface), 0.0);
    if (alone || bursts) {
        bubble.gone += vec2<f32>(bubble.mass, bubble.enthalpy);
        bubble.air_gone += bubble.air;
        bubble = emptied(bubble);
        bubbles[other_first + slot] = bubble;
        return;
    }

    var relative = risen(bubble.velocity - s.velocity, up, bubble.radius, around, time);
    if (at_surface) { relative = vec3<f32>(0.0); }
    bubble.velocity = beside_glass(s.velocity + relative, wall);
    bubble.position += bubble.velocity * time;

    let other_slot = s.larger & 0xffffu;
    let other = bubbles[first + other_slot];
    let together = bubble.radius * bubble.radius * bubble.radius + other.radius * other.radius * other.radius;
    let stable = stable_radius(around);
    let joins_other = s.larger > 0u && together <= stable * stable * stable;
    bubble.touching = select(0.0, bubble.touching + time, joins_other);
    if (joins_other) {
        if (bubble.touching > drainage_time(bubble.radius, other.radius, around)) {
            let words = 3u * (other_first + other_slot);
            let steam = quanta(bubble.mass, JOINED_MASS_QUANTUM);
            let enthalpy = quanta(bubble.enthalpy, JOINED_ENTHALPY_QUANTUM);
            atomicAdd(&merging[words], steam);
            atomicAdd(&merging[words + 1u], enthalpy);
            let air = quanta(bubble.air, JOINED_MASS_QUANTUM);
            atomicAdd(&merging[words + 2u], air);
            bubble.air_gone += bubble.air - f32(air) * JOINED_MASS_QUANTUM;
            // What the coarser quanta leave is a particle's.
            let mass_left = bubble.mass - f32(steam) * JOINED_MASS_QUANTUM;
            let enthalpy_left = bubble.enthalpy - f32(enthalpy) * JOINED_ENTHALPY_QUANTUM;
            exchange_with(nearest, -quanta(mass_left, MASS_QUANTUM), -quanta(enthalpy_left, ENTHALPY_QUANTUM));
            bubble = emptied(bubble);
        }
    }
    // Liquid that is poured changes its flask, and what is in it with it.
    if (s.nearest_of_all.distance < 0.5 * SPACING) { bubble.membership = tags[s.nearest_of_all.particle].x; }
    if (is_there(bubble)) {
        atomicMax(&bubbled[nearest * BUBBLED_WORDS + BUBBLED_NEXT], i32(key_of(bubble, slot)));
    }
    bubbles[other_first + slot] = bubble;
}
