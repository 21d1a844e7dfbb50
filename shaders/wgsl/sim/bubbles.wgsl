// Bubbles: a population beside the particles, which the liquid's neighbour search does not know. A bubble of steam is born at a
// particle that is superheated, one of air at one with which a stream plunges into liquid. It takes steam from the particles around
// it, or gives it back to colder ones; it rises, joins others, and bursts at the surface, from which it throws up drops. What it
// takes and gives, and its volume, are added to the particles in whole quanta; they take them over with line 26, and their volume
// with line 1.
//!include common/chemistry/bubble.wgsl
//!include common/chemistry/bubble_surroundings.wgsl
//!include common/chemistry/bubbled.wgsl
//!include common/chemistry/dividing.wgsl
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
/// Where fewer neighbours than this are above, over a full neighbourhood's, a bubble is at the surface.
const COVERED: f32 = 0.7;
/// The same of a cavity: with more, those inside of a swarm would count as at its surface.
const CAVITY_COVERED: f32 = 0.35;
/// Share of solid space around a bubble from which on glass holds it back.
const AT_GLASS: f32 = 0.2;
/// Share of solid space, a support radius below a particle that plunges, from which on it takes no air down.
const BESIDE_GLASS: f32 = 0.01;
/// Most steam that all bubbles around a particle exchange with it in a step, V0·ρ0, and over what its superheat makes. How many bubbles
/// there are is known of the step before; since then they may be more by what a radius grows, and a word of quanta holds 33 times that.
const MOST_EXCHANGED: f32 = 0.03;
const MOST_OF_SUPERHEAT: f32 = 0.5;
/// Most gas that a bubble gives a particle, V0: many times what it can hold, and a word of quanta holds it of 256 bubbles.
const MOST_GIVEN: f32 = 8.0;
/// How fast the share of a bubble that is a cavity follows the crowd, in a step.
const FOLLOWS: f32 = 0.3;
/// Most of it in a step: until the next one, particles hold what has become a cavity too.
const MOST_FOLLOWED: f32 = 0.2;
/// Share of the overlap of two cavities that they leave in a step.
const PARTED: f32 = 0.5;
/// Most of such ways in a step, over h: a cavity that leaps crushes particles.
const MOST_SHIFT: f32 = 0.2;
/// Quantum of that way, m.
const WAY_QUANTUM: f32 = 1e-8;
/// Share of a vessel's width that a bubble has at most.
const WIDEST_BUBBLE: f32 = 0.5;
/// How far from its place each half of a bubble that divides is at the step's end, over its radius.
const PARTS_BY: f32 = 0.7;
/// Radius over h beyond which a bubble divides anywhere: `CAVITY_CELLS` have no room for what is around it.
const MOST_RADIUS: f32 = 7.0;
/// Most acceleration of the liquid around a bubble that its velocity is changed by, over gravity's: more is noise. Without weight
/// there is none.
const MOST_ACCELERATION: f32 = 1.0;

/// Step of the differences by which the way from glass is found, m.
const GAP_STEP: f32 = 2e-4;

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
    let held = (1.0 - bubble.cavity) * bubble_volume(bubble.radius);
    let gas_share = held / (VOLUME * max(s.weight, 1e-12));
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
    bubble.position_before = bubble.position;
    bubble.velocity = velocity[i].xyz;
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

/// Velocity without what would carry it into glass.
fn beside_glass(v: vec3<f32>, wall: vec4<f32>) -> vec3<f32> {
    let slope = wall_gradient(wall);
    let steepness = length(slope);
    if (wall_volume(wall) < AT_GLASS || steepness <= 0.0) { return v; }
    let into = slope / steepness;
    return v - into * max(dot(v, into), 0.0);
}

/// A bubble's velocity relative to the liquid, m/s, and the force by which, as far as it is a cavity, it drags the liquid along,
/// V0·ρ0·m/s²: where particles hold its gas, they are lighter by it.
struct Motion {
    relative: vec3<f32>,
    drag: vec3<f32>,
}

fn motion_of(bubble: Bubble, s: Surrounding, around: Around, gravity: vec3<f32>, is_born: bool, at_surface: bool, time: f32) -> Motion {
    if (at_surface) { return Motion(vec3<f32>(0.0), vec3<f32>(0.0)); }
    let before = bubble.velocity - select(bubble.flow, s.velocity, is_born);
    var gained = select((s.velocity - bubble.flow) / time, vec3<f32>(0.0), is_born);
    gained *= min(MOST_ACCELERATION * GRAVITY / max(length(gained), 1e-6), 1.0);
    let rate = drag_rate(before, bubble.radius, around);
    let relative = risen(before, gained - gravity, rate, time);
    let displaced = bubble.cavity * bubble_volume(bubble.radius) * around.density / MASS;
    return Motion(relative, 0.5 * displaced * rate * relative);
}

/// Drags the liquid behind a cavity along, where its wake is: beside and before it, it would move what `gather` finds its velocity by.
fn drag_along(bubble: Bubble, motion: Motion, reach: f32, cells: i32, lane: u32) {
    let speed = length(motion.relative);
    if (speed <= 0.0 || bubble.cavity <= 0.0) { return; }
    let wake = bubble.position - motion.relative * (reach / speed);
    let force = motion.drag * (VOLUME / (FULL * reach * reach * reach));
    let cell = cell_of(wake);
    for (var n = lane; n < count_around(cells); n += LANES) {
        let run = cell_around(cell, cells, n);
        for (var j = run.first; j < run.end; j++) {
            let offset = position[j].xyz - wake;
            let weight = share_at(dot(offset, offset) / (reach * reach));
            if (weight <= 0.0 || tags[j].x != bubble.membership) { continue; }
            let acceleration = force * (weight * unpack_bulk(bulk[j]).lightness);
            let word = tags[j].y * BUBBLED_WORDS + BUBBLED_LIFT;
            for (var axis = 0u; axis < 3u; axis++) { atomicAdd(&bubbled[word + axis], quanta(acceleration[axis], LIFT_QUANTUM)); }
        }
    }
}

/// Which bubble's other half comes to a place, or goes from it: itself then.
struct Half {
    parent: u32,
    side: f32,
}

fn half_of(slot: u32, first: u32) -> Half {
    if (splits[first + slot] > 0u) { return Half(slot, 1.0); }
    let parent = parent_of(slot, first);
    if (parent == NO_PARENT || splits[first + parent] != slot + 1u) { return Half(NO_PARENT, 0.0); }
    return Half(parent, -1.0);
}

/// A half of `whole`, as it was before this step: the one that stays, with what joins it, or the one that goes.
fn divided(before: Bubble, whole: Bubble, side: f32) -> Bubble {
    var bubble = before;
    if (side < 0.0) {
        bubble = whole;
        bubble.gone = before.gone;
        bubble.vented = before.vented;
        bubble.air_gone = before.air_gone;
    }
    bubble.mass -= 0.5 * whole.mass;
    bubble.enthalpy -= 0.5 * whole.enthalpy;
    bubble.air -= 0.5 * whole.air;
    let gravity = vec3<f32>(GRAVITY_X, GRAVITY_Y, GRAVITY_Z);
    let weight = length(gravity);
    let up = select(vec3<f32>(0.0, 1.0, 0.0), -gravity / max(weight, 1e-9), weight > 1e-6);
    let across = sideways(up, bitcast<u32>(whole.position.x), bitcast<u32>(whole.radius));
    // Both begin the step as the whole: where cavities overlap there is one.
    bubble.position_before = whole.position;
    bubble.position = whole.position + side * PARTS_BY * whole.radius * across;
    return bubble;
}

/// Share of a bubble that is a cavity: as it is wider than particles resolve, and what of it they cannot hold.
fn cavity_of(bubble: Bubble, s: Surrounding) -> f32 {
    let crowd = FOLLOWS * (s.crowded - 1.0) * (1.0 - bubble.cavity + 0.05);
    return clamp(bubble.cavity + clamp(crowd, -MOST_FOLLOWED, MOST_FOLLOWED), cavity_share(bubble.radius), 1.0);
}

/// Sum of the cubes of two bubbles' radii, m³.
fn together(a: Bubble, b: Bubble) -> f32 {
    return a.radius * a.radius * a.radius + b.radius * b.radius * b.radius;
}

/// Whether what two bubbles become is narrow enough to last, and for their vessel.
fn can_join(a: Bubble, b: Bubble, around: Around) -> bool {
    let stable = min(stable_radius(around), widest_at(a));
    return together(a, b) <= stable * stable * stable;
}

/// Bubbles that touch a cavity.
struct Touching {
    /// Key of the largest larger one that it can join; 0 for none.
    larger: u32,
    /// Way in which it leaves those that it overlaps and, as both are too wide, will not join, m.
    way: vec3<f32>,
}

/// What touches a cavity, of all bubbles: the particle nearest to another may be out of its reach. All lanes must ask.
fn touching_of(bubble: Bubble, around: Around, slot: u32, first: u32, lane: u32) -> Touching {
    var way = vec3<i32>(0);
    var larger = 0u;
    let key = key_of(bubble, slot);
    let count = select(0u, live[count_of_live()], cavity_share(bubble.radius) > 0.0);
    for (var n = lane; n < count; n += LANES) {
        let other = bubbles[first + live[n]];
        let offset = bubble.position - other.position;
        let distance = length(offset);
        let overlap = bubble.radius + other.radius - distance;
        if (live[n] == slot || !is_there(other) || other.divides > 0.0 || other.membership != bubble.membership || overlap <= 0.0) { continue; }
        if (can_join(bubble, other, around)) {
            let others = key_of(other, live[n]);
            if (others > key) { larger = max(larger, others); }
        } else if (other.cavity > 0.0) {
            let own = other.radius * other.radius * other.radius / together(bubble, other);
            way += vec3<i32>(round(offset * (PARTED * overlap * own / max(distance, 1e-5) / WAY_QUANTUM)));
        }
    }
    let sum = vec3<i32>(lane_sum_of_integers(way.x), lane_sum_of_integers(way.y), lane_sum_of_integers(way.z));
    return Touching(lane_max(larger), vec3<f32>(sum) * WAY_QUANTUM);
}

/// Greatest radius of a bubble where one is, m: half of its vessel's.
fn widest_at(bubble: Bubble) -> f32 {
    if (FLASKS == 0u || bubble.membership == NOBODYS) { return MOST_RADIUS * SUPPORT; }
    let k = bubble.membership - 1u;
    let y = flask_from_stage(poses[step.after + k], bubble.position).y;
    let lowest = min(flasks[k].floor + bubble.radius, flasks[k].rim);
    return min(WIDEST_BUBBLE * inner_radius(k, clamp(y, lowest, flasks[k].rim)), MOST_RADIUS * SUPPORT);
}

/// Where a cavity lies beside glass and not in it.
fn clear_of_glass(bubble: Bubble) -> vec3<f32> {
    let wanted = bubble.cavity * bubble.radius;
    if (SOLIDS || FLASKS == 0u || wanted <= 0.0 || bubble.membership == NOBODYS) { return bubble.position; }
    let k = bubble.membership - 1u;
    let pose = poses[step.after + k];
    let p = flask_from_stage(pose, bubble.position);
    let r = length(p.xz);
    let first = flasks[k].inside_first;
    let gap = sample_map(k, first, r, p.y).distance;
    if (gap >= wanted) { return bubble.position; }
    let further = vec2<f32>(sample_map(k, first, r + GAP_STEP, p.y).distance, sample_map(k, first, r, p.y + GAP_STEP).distance);
    let slope = (further - gap) / GAP_STEP;
    let to = (wanted - gap) / max(dot(slope, slope), 0.1) * slope;
    let out = p.xz / max(r, 1e-9);
    return stage_from_flask(pose, p + vec3<f32>(out.x * to.x, to.y, out.y * to.x));
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
    let cells = clamp(i32(ceil((SUPPORT + bubble.radius) / CELL)), 1, CAVITY_CELLS);
    let reach = min(SUPPORT + bubble.radius, f32(cells) * SUPPORT);

    let s = gather(bubble, slot, first, reach, cells, lane, up);
    if (s.weight > 0.0) { bubble.air_temperature = s.temperature; }
    bubble.cavity = cavity_of(bubble, s);
    let around = around_of(s.acid, s.temperature);
    // Surface tension holds no wider cap.
    let bursts = bubble.surfaced > select(FOAM_TIME, 0.0, bubble.radius > stable_radius(around));
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
    // Only lane 0 has a map's wall.
    let uncovered = lane == 0u && cover_of(s.cover, wall, up) < mix(COVERED, CAVITY_COVERED, bubble.cavity);
    let at_surface = lane_max(u32(uncovered)) > 0u;
    let motion = motion_of(bubble, s, around, gravity, is_born, at_surface, time);
    drag_along(bubble, motion, reach, cells, lane);
    let gained = scatter(bubble, s, c, reach, cells, lane, time);
    let touching = touching_of(bubble, around, slot, first, lane);
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
    bubble.position += shift * min(MOST_SHIFT * SUPPORT / max(length(shift), 1e-9), 1.0);
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
    if (s.nearest_of_all.distance < 0.5 * SPACING) { bubble.membership = tags[s.nearest_of_all.particle].x; }
    if (is_there(bubble)) {
        atomicMax(&bubbled[nearest * BUBBLED_WORDS + BUBBLED_NEXT], i32(key_of(bubble, slot)));
    }
    bubbles[other_first + slot] = bubble;
}
