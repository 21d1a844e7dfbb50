// Bubbles: a population beside the particles, which the liquid's neighbour search does not know. A bubble of steam is born at a
// particle that is superheated, one of air at one with which a stream plunges into liquid. It takes steam from the particles around
// it, or gives it back to colder ones; it rises, joins others, and bursts at the surface, from which it throws up drops. What it
// takes and gives, and its volume, are added to the particles in whole quanta; they take them over with line 26, and their volume
// with line 1.
//!include common/chemistry/bubble.wgsl
//!include common/chemistry/bubble_exchange.wgsl
//!include common/chemistry/bubble_motion.wgsl
//!include common/chemistry/bubble_surroundings.wgsl
//!include common/chemistry/bubbled.wgsl
//!include common/chemistry/entrainment.wgsl
//!include common/chemistry/features.wgsl
//!include common/chemistry/halves.wgsl
//!include common/chemistry/live_places.wgsl
//!include common/chemistry/plunging.wgsl
//!include common/chemistry/throwing.wgsl
//!include common/chemistry/touching.wgsl
//!include common/chemistry/venting.wgsl
//!include common/glass/boundary.wgsl
//!include common/liquid/cells_around.wgsl
//!include common/liquid/counters.wgsl
//!include common/liquid/particle.wgsl
//!include common/liquid/step.wgsl
//!include common/maths/lot.wgsl

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
/// (acid fraction, enthalpy in J/kg, …, mass over V0·ρ0)
@group(0) @binding(13) var<storage, read> matter: array<vec4<f32>>;
/// By identity, see `sim/forces.wgsl`.
@group(0) @binding(17) var<storage, read> falls: array<vec2<f32>>;
@group(0) @binding(19) var<storage, read> live: array<u32>;
/// By set of records and slot: one more than the place of the other half of a bubble that divides (`sim/live.wgsl`).
@group(0) @binding(56) var<storage, read_write> splits: array<u32>;
/// Share of a particle's neighbourhood that cavities take.
@group(0) @binding(54) var<storage, read> hollow: array<f32>;
@group(0) @binding(55) var<storage, read> bulk: array<vec4<f32>>;

/// Particle spacing d, m.
override SPACING: f32 = 0.0025;

/// Radius of a nucleus, and that below which a bubble is gone, m.
const NUCLEUS: f32 = 3e-4;
const VANISHED: f32 = 1e-4;
/// Share of solid space, a support radius below a particle that plunges, from which on it takes no air down.
const BESIDE_GLASS: f32 = 0.01;
/// Share of liquid around a bubble below which nothing but drops hold it: half of that of one whose middle is at the surface.
const LEAST_FILLED: f32 = 0.25;
/// How deep under the surface the top of a bubble that lay at it may come and still lie there, m: how well the surface is known.
const STAYS: f32 = 1e-3;
/// Half of the step between two numbers by lot.
const LOT_STEP: f32 = 0.5 / 1024.0;
/// Greatest speed with which a cavity leaves glass and other cavities, m/s: one that leaps throws particles.
const MOST_SHIFT: f32 = 0.1;
/// How near to a particle a bubble takes over that particle's flask, over d. Chosen.
const TAKES_FLASK: f32 = 0.5;

var<workgroup> claimed: array<u32, 64>;
var<workgroup> joined: array<vec3<i32>, 64>;

/// Takes steam of the particle with that identity, or gives it.
fn exchange_with(identity: u32, steam: i32, enthalpy: i32) {
    atomicSub(&bubbled[identity * BUBBLED_WORDS + BUBBLED_MASS], steam);
    atomicSub(&bubbled[identity * BUBBLED_WORDS + BUBBLED_ENTHALPY], enthalpy);
}

fn volume_of(bubble: Bubble) -> f32 {
    let steam = steam_volume(bubble.mass, bubble.enthalpy);
    return steam + bubble.air * MASS / steam_density(bubble.air_temperature);
}

/// The pool that a bubble is in, and what rises from it.
fn pool_of(bubble: Bubble) -> Pool {
    if (bubble.membership == NOBODYS) { return Pool(0.0, 1.0, 1.0); }
    let k = bubble.membership - 1u;
    let y = flask_from_stage(poses[step.after + k], bubble.position).y;
    let radius = max(inner_radius(k, clamp(y, flasks[k].floor, flasks[k].rim)), bubble.radius);
    let flow = venting[k].flow;
    return Pool(flow / (BUBBLE_PI * radius * radius), 2.0 * radius, steam_density(temperature_of(bubble)));
}

/// A number in (0, 1) by lot, another for each `what`.
fn lot_of(bubble: Bubble, slot: u32, what: u32) -> f32 {
    return lot(bitcast<u32>(bubble.position.x) + what, slot) + LOT_STEP;
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
    bubble.position_before = bubble.position;
    bubble.velocity = velocity[i].xyz;
    // One that bursts in its first step would keep that of the bubble that this set of records had here before.
    bubble.flow = bubble.velocity;
    bubble.membership = tags[i].x;
    bubble.surfaced = 0.0;
    bubble.touching = 0.0;
    bubble.cavity = 0.0;
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
    bubble.radius = 0.0;
    bubble.divides = 0.0;
    return bubble;
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
    let half = half_of(slot, first);
    if (lane == 0u) { splits[other_first + slot] = 0u; }
    bubble.radius_before = bubble.radius;
    bubble.position_before = bubble.position;
    if (is_born) { bubble = born(bubble, claim - 1u, of_air); }
    if (half.parent != NO_PARENT) { bubble = divided(bubble, bubbles[first + half.parent], half.side); }
    bubble.radius = select(0.0, radius_of_volume(volume_of(bubble)), is_there(bubble));
    if (half.parent != NO_PARENT) { bubble.radius_before = bubbles[first + half.parent].radius; }
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
    let cells = clamp(i32(ceil((reach_beyond() + bubble.radius) / CELL)), 1, CAVITY_CELLS);
    let reach = min(reach_beyond() + bubble.radius, f32(cells) * SUPPORT);

    let s = gather(bubble, slot, first, reach, cells, lane, up);
    if (s.weight > 0.0) { bubble.air_temperature = s.temperature; }
    bubble.cavity = cavity_of(bubble, s);
    let around = around_of(s.acid, s.temperature);
    // Only lane 0 has a map's wall; what glass takes holds no liquid.
    let held_by_drops = lane == 0u && s.filled < LEAST_FILLED * max(1.0 - wall_volume(wall), LEAST_BESIDE_GLASS);
    let is_open = lane_max(u32(held_by_drops)) > 0u && any(up != vec3<f32>(0.0));
    let bursts = is_open || bubble.surfaced > life_of_film(bubble.radius, around);
    if (SPRAY) {
        var jet: Burst;
        var film: Burst;
        if (bursts && s.contact > 0.0) {
            let pool = pool_of(bubble);
            if (churns(pool, around)) {
                jet = entrained(volume_of(bubble), pool, around, lot_of(bubble, slot, 2u), lot_of(bubble, slot, 3u));
            } else {
                jet = jet_of(bubble.radius, around, s.crowd, lot_of(bubble, slot, 2u));
                film = film_of(bubble.radius, bubble.surfaced, around);
            }
        }
        spray(bubble, slot, OF_JET, jet, s, around, reach, cells, lane, up);
        spray(bubble, slot, OF_FILM, film, s, around, reach, cells, lane, up);
    }
    var c: Conductance;
    if (!bursts) { c = conductance_of(bubble, s, around, time); }
    let deepest = bubble.radius + select(0.0, STAYS, bubble.surfaced > 0.0);
    let covered = mix(cover_under(min(deepest / reach, 1.0)), CAVITY_COVERED, bubble.cavity);
    let uncovered = lane == 0u && cover_of(s.cover, wall, up) < covered;
    let at_surface = lane_max(u32(uncovered)) > 0u;
    let motion = motion_of(bubble, s, around, gravity, is_born, at_surface, time);
    drag_along(bubble, motion, reach, cells, lane);
    let gained = scatter(bubble, s, c, reach, cells, lane, time);
    let touching = touching_of(bubble, around, slot, first, lane);
    if (gained.is_cut || touching.is_cut) { atomicAdd(&counters.bubbles_cut, 1u); }
    // A bubble that divides in this step joins none.
    let larger = select(select(s.larger, touching.larger, cavity_share(bubble.radius) > 0.0), 0u, half.parent != NO_PARENT);
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
            bubbles[other_first + slot] = emptied(bubble);
            return;
        }
    }

    // What new ones push under for a moment is no younger for it.
    bubble.surfaced = max(bubble.surfaced + select(-time, time, at_surface), 0.0);
    if (alone || bursts) {
        if (bubble.membership != NOBODYS) { vent_gas(bubble.membership - 1u, volume_of(bubble)); }
        bubble.gone += vec2<f32>(bubble.mass, bubble.enthalpy);
        bubble.air_gone += bubble.air;
        bubble = emptied(bubble);
        bubbles[other_first + slot] = bubble;
        return;
    }

    bubble.flow = s.velocity;
    bubble.velocity = beside_glass(s.velocity + motion.relative, wall);
    bubble.position += bubble.velocity * time;
    bubble.radius = radius_of_volume(volume_of(bubble));
    let shift = touching.way + clear_of_glass(bubble) - bubble.position;
    bubble.position += shift * min(MOST_SHIFT * time / max(length(shift), 1e-9), 1.0);
    bubble.divides = select(0.0, 1.0, bubble.radius > widest_at(bubble));

    let other_slot = larger & 0xffffu;
    let other = bubbles[first + other_slot];
    let joins_other = larger > 0u && can_join(bubble, other, around);
    bubble.touching = select(0.0, bubble.touching + time, joins_other);
    if (joins_other) {
        // Each would follow the liquid that it moves itself, away from the other.
        bubble.velocity = other.velocity;
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
    if (s.nearest_of_all.distance < TAKES_FLASK * SPACING) { bubble.membership = tags[s.nearest_of_all.particle].x; }
    if (is_there(bubble)) {
        atomicMax(&bubbled[nearest * BUBBLED_WORDS + BUBBLED_NEXT], i32(key_of(bubble, slot)));
    }
    bubbles[other_first + slot] = bubble;
}
