// Bubbles of steam: a population beside the particles, which the liquid's neighbour search does not know. A bubble is born at a
// particle that is superheated, takes steam from the particles around it, or gives it back to colder ones; it rises, joins
// others, and bursts at the surface, from which it throws drops up. What it takes and gives, and its volume, are added to the particles in whole quanta; they take
// them over with line 26, and their volume with line 1.
//!include common/chemistry/bubble.wgsl
//!include common/chemistry/bubbled.wgsl
//!include common/chemistry/drops.wgsl
//!include common/chemistry/spray_laws.wgsl
//!include common/glass/boundary.wgsl
//!include common/liquid/cells_around.wgsl
//!include common/liquid/counters.wgsl
//!include common/liquid/lane_nearest.wgsl
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
@group(0) @binding(5) var<storage, read> block_sums: array<u32>;
@group(0) @binding(6) var<storage, read> boils: array<vec4<f32>>;
@group(0) @binding(7) var<storage, read> gas: array<vec4<f32>>;
/// Those before this step, and after it.
@group(0) @binding(8) var<storage, read_write> bubbles: array<Bubble>;
@group(0) @binding(9) var<storage, read_write> bubbled: array<atomic<i32>>;
/// By slot: one more than the particle at which a bubble is to be born.
@group(0) @binding(10) var<storage, read_write> claims: array<u32>;
/// By step and slot: quanta of steam and enthalpy of what joins the bubble.
@group(0) @binding(11) var<storage, read_write> merging: array<atomic<i32>>;
@group(0) @binding(12) var<storage, read_write> counters: Counters;
/// (acid fraction, enthalpy in J/kg, …, mass over V0·ρ0)
@group(0) @binding(13) var<storage, read> matter: array<vec4<f32>>;
@group(0) @binding(14) var<storage, read_write> drops: array<Drops>;
/// By identity: what drops did to a particle.
@group(0) @binding(15) var<storage, read_write> sprayed: array<atomic<i32>>;

/// Particle spacing d, m.
override SPACING: f32 = 0.0025;
/// How far from its surface a bubble exchanges steam, over d: with less it would lie between particles.
const CONTACT: f32 = 1.2;
/// Radius of a nucleus, and that below which a bubble is gone, m.
const NUCLEUS: f32 = 3e-4;
const VANISHED: f32 = 1e-4;
/// Where fewer neighbours than this are above, over a full neighbourhood's, a bubble is at the surface.
const COVERED: f32 = 0.7;
/// Share of solid space around a bubble from which on glass holds it back.
const AT_GLASS: f32 = 0.2;
/// Cells around its own that a bubble reaches at most.
const MOST_CELLS: i32 = 3;

var<workgroup> claimed: array<u32, 64>;
var<workgroup> joined: array<vec2<i32>, 64>;

/// How much a particle at a share q of the reach counts, by its square; FULL is its integral over reach³.
const FULL: f32 = 0.957442;
fn share_at(square: f32) -> f32 {
    let left = max(1.0 - square, 0.0);
    return left * left;
}

/// How much of a bubble's exchange a particle at that square of a distance has: those that touch it, or nearly.
fn contact_at(square: f32, radius: f32) -> f32 {
    let reach = radius + CONTACT * SPACING;
    return share_at(square / (reach * reach));
}

/// The larger of two bubbles has the larger key.
fn key_of(bubble: Bubble, slot: u32) -> u32 {
    return (u32(min(bubble.radius * 1e6, 32767.0)) << 16u) | slot;
}

/// Whether a bubble touches that of another record.
fn touches(bubble: Bubble, record: u32) -> bool {
    let other = bubbles[record];
    if (other.mass <= 0.0 || other.membership != bubble.membership) { return false; }
    return distance(other.position, bubble.position) <= bubble.radius + other.radius;
}

/// What is around a bubble, over the sum of the weights but for the weights and `cover`.
struct Surrounding {
    weight: f32,
    squares: f32,
    /// Of what exchanges steam with it, which is nearer.
    contact: f32,
    cover: f32,
    velocity: vec3<f32>,
    /// Gas of the other bubbles over liquid.
    gas: f32,
    acid: f32,
    temperature: f32,
    superheat: f32,
    subcooling: f32,
    /// Share of the superheat that drives growth, and of what subcooling collapse.
    growing: f32,
    shrinking: f32,
    nearest: Nearest,
    /// The same of any membership.
    nearest_of_all: Nearest,
    /// Key of the largest larger bubble that it touches; 0 for none.
    larger: u32,
}

/// Of `bubble` in `slot` within `reach`, in cells `cells` around its own; others are those from `first` on. All lanes must ask.
fn gather(bubble: Bubble, slot: u32, first: u32, reach: f32, cells: i32, lane: u32, up: vec3<f32>) -> Surrounding {
    var s: Surrounding;
    s.nearest = Nearest(1e9, 0u);
    s.nearest_of_all = Nearest(1e9, 0u);
    let key = key_of(bubble, slot);
    let cell = cell_of(bubble.position);
    let count = select(0u, count_around(cells), bubble.mass > 0.0);
    for (var n = lane; n < count; n += LANES) {
        let run = cell_around(cell, cells, n);
        for (var j = run.first; j < run.end; j++) {
            let offset = position[j].xyz - bubble.position;
            let square = dot(offset, offset);
            if (square >= reach * reach || tags[j].x == REMOVED) { continue; }
            s.nearest_of_all = nearer(s.nearest_of_all, Nearest(sqrt(square), j));
            if (tags[j].x != bubble.membership) { continue; }
            let owner = u32(atomicLoad(&bubbled[tags[j].y * BUBBLED_WORDS + BUBBLED_OWNER]));
            if (owner > max(key, s.larger) && (owner & 0xffffu) != slot) {
                if (touches(bubble, first + (owner & 0xffffu))) { s.larger = owner; }
            }
            let weight = share_at(square / (reach * reach));
            let distance = sqrt(max(square, 1e-12 * SUPPORT * SUPPORT));
            let boil = boils[j];
            let contact = contact_at(square, bubble.radius);
            let excess = contact * max(boil.x, 0.0);
            let lack = contact * max(-boil.x, 0.0);
            s.weight += weight;
            s.squares += weight * weight;
            s.contact += contact;
            s.cover += max(dot(offset, up) / distance, 0.0) * weight * (1.0 + gas[tags[j].y].x);
            s.velocity += weight * velocity[j].xyz;
            s.gas += weight * gas[tags[j].y].x;
            s.temperature += weight * heat[j].x;
            s.acid += weight * heat[j].y;
            s.superheat += excess;
            s.subcooling += lack;
            s.growing += excess * boil.z;
            s.shrinking += lack * boil.z;
            s.nearest = nearer(s.nearest, Nearest(distance, j));
        }
    }
    s.weight = lane_sum(s.weight);
    s.cover = lane_sum(s.cover) * 4.0 * VOLUME / (FULL * reach * reach * reach);
    s.velocity = lane_sum3(s.velocity);
    let thermal = lane_sum3(vec3<f32>(s.temperature, s.acid, s.contact));
    s.contact = thermal.z;
    let excess = lane_sum3(vec3<f32>(s.superheat, s.growing, s.gas));
    let lack = lane_sum3(vec3<f32>(s.subcooling, s.shrinking, s.squares));
    let per_weight = 1.0 / max(s.weight, 1e-12);
    // Its own gas is the same share of each weight.
    let per_square = 1.0 / max(s.weight * s.weight, 1e-12);
    let own = bubble_volume(bubble.radius) / VOLUME * lack.z * per_square;
    s.gas = max(excess.z * per_weight - own, 0.0);
    s.nearest = lane_nearest(s.nearest);
    s.nearest_of_all = lane_nearest(s.nearest_of_all);
    s.larger = lane_max(s.larger);
    s.velocity *= per_weight;
    s.temperature = thermal.x * per_weight;
    s.acid = thermal.y * per_weight;
    s.superheat = excess.x / max(s.contact, 1e-12);
    s.subcooling = lack.x / max(s.contact, 1e-12);
    s.growing = excess.y / max(excess.x, 1e-12);
    s.shrinking = lack.y / max(lack.x, 1e-12);
    return s;
}

/// What a bubble would exchange in a step if no other did: steam that it takes per kelvin of superheat, and that it
/// gives per kelvin of subcooling, V0·ρ0/(s K).
struct Conductance {
    taken: f32,
    given: f32,
    /// Whether it collapses altogether.
    vanishes: bool,
}

fn conductance_of(bubble: Bubble, s: Surrounding, around: Around, time: f32) -> Conductance {
    let density = steam_density(steam_temperature(bubble.enthalpy / max(bubble.mass, 1e-20)));
    let relative = length(bubble.velocity - s.velocity);
    let unit = 4.0 / 3.0 * BUBBLE_PI * density / MASS;
    let cube = bubble.radius * bubble.radius * bubble.radius;
    var c: Conductance;
    if (s.superheat > 0.0) {
        let r = grown(bubble.radius, s.superheat, s.growing, relative, density, around, time);
        c.taken = unit * (r * r * r - cube) / (time * s.superheat);
    }
    if (s.subcooling > 0.0) {
        let r = collapsed(bubble.radius, s.subcooling, s.shrinking, relative, density, around, time);
        c.given = unit * (cube - r * r * r) / (time * s.subcooling);
        c.vanishes = r < VANISHED && s.subcooling > s.superheat;
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

/// A sum of quanta, which together may be more than a word holds.
struct QuantaSum {
    high: i32,
    low: i32,
}

const LOW_BITS: u32 = 12u;

fn added(sum: QuantaSum, count: i32) -> QuantaSum {
    return QuantaSum(sum.high + (count >> LOW_BITS), sum.low + (count & 4095));
}

fn lane_sum_of_quanta(sum: QuantaSum, quantum: f32) -> f32 {
    let high = f32(lane_sum_of_integers(sum.high)) * 4096.0;
    return (high + f32(lane_sum_of_integers(sum.low))) * quantum;
}

/// Exchanges steam with the particles around and gives them its volume; all lanes must ask.
fn scatter(bubble: Bubble, s: Surrounding, c: Conductance, reach: f32, cells: i32, lane: u32, time: f32) -> Gained {
    var mass: QuantaSum;
    var enthalpy: QuantaSum;
    let cell = cell_of(bubble.position);
    let count = select(0u, count_around(cells), bubble.mass > 0.0 && s.weight > 0.0);
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
            let given = weight * gas_share;
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

/// Liquid that goes into drops, V0·ρ0, its acid, and its enthalpy, J per V0·ρ0.
struct Liquid {
    mass: f32,
    acid: f32,
    enthalpy: f32,
}

/// Most of a particle that touches a bubble which goes into its drops.
const MOST_THROWN: f32 = 0.05;

/// Takes liquid of `mass` (V0·ρ0) from the particles that touch a bubble; all lanes must ask, those of others with 0.
fn take_liquid(bubble: Bubble, s: Surrounding, mass: f32, reach: f32, cells: i32, lane: u32) -> Liquid {
    var sums = array<QuantaSum, 3>();
    let cell = cell_of(bubble.position);
    let count = select(0u, count_around(cells), mass > 0.0);
    for (var n = lane; n < count; n += LANES) {
        let run = cell_around(cell, cells, n);
        for (var j = run.first; j < run.end; j++) {
            let offset = position[j].xyz - bubble.position;
            let square = dot(offset, offset);
            let share = contact_at(square, bubble.radius) / max(s.contact, 1e-12);
            let tag = tags[j];
            if (square >= reach * reach || share <= 0.0 || tag.x != bubble.membership) { continue; }
            let content = matter[j];
            let taken = quanta_of_drops(min(share * mass, MOST_THROWN * content.w), SPRAYED_QUANTUM);
            let liquid = f32(taken) * SPRAYED_QUANTUM * content.xy;
            let acid = quanta_of_drops(liquid.x, SPRAYED_QUANTUM);
            let enthalpy = quanta_of_drops(liquid.y, SPRAYED_ENTHALPY_QUANTUM);
            let words = tag.y * SPRAYED_WORDS;
            atomicSub(&sprayed[words], taken);
            atomicSub(&sprayed[words + 1u], acid);
            atomicSub(&sprayed[words + 2u], enthalpy);
            sums[0] = added(sums[0], taken);
            sums[1] = added(sums[1], acid);
            sums[2] = added(sums[2], enthalpy);
        }
    }
    return Liquid(
        lane_sum_of_quanta(sums[0], SPRAYED_QUANTUM), lane_sum_of_quanta(sums[1], SPRAYED_QUANTUM),
        lane_sum_of_quanta(sums[2], SPRAYED_ENTHALPY_QUANTUM));
}

/// Mass of the drops of a burst, V0·ρ0.
fn mass_of(burst: Burst, around: Around) -> f32 {
    return burst.number * bubble_volume(burst.radius) * around.density / MASS;
}

/// Most that a jet leans away from upwards, and a film's drops from the level: a tangent.
const LEANS: f32 = 0.2;

/// A direction at right angles to `up`, by lot.
fn sideways(up: vec3<f32>, slot: u32, seed: u32) -> vec3<f32> {
    let other = select(vec3<f32>(1.0, 0.0, 0.0), vec3<f32>(0.0, 0.0, 1.0), abs(up.x) > 0.9);
    let a = normalize(cross(up, other));
    let turn = 2.0 * BUBBLE_PI * lot(slot, seed);
    return cos(turn) * a + sin(turn) * cross(a, up);
}

/// Puts drops into a record of a bubble's place, which is free.
fn throw_up(place: u32, bubble: Bubble, s: Surrounding, burst: Burst, liquid: Liquid, density: f32, direction: vec3<f32>, up: vec3<f32>) {
    drops[place].position = bubble.position + up * (bubble.radius + SPACING);
    drops[place].mass = liquid.mass;
    drops[place].velocity = s.velocity + direction * burst.speed;
    drops[place].acid = liquid.acid;
    drops[place].enthalpy = liquid.enthalpy;
    drops[place].radius = burst.radius;
    drops[place].density = density;
    drops[place].memberships = bubble.membership | (bubble.membership << 16u);
    drops[place].number = liquid.mass * MASS / (density * bubble_volume(burst.radius));
}

/// Throws up the drops of a bubble that bursts in one of both ways; all lanes must ask.
fn spray(bubble: Bubble, slot: u32, way: u32, burst: Burst, s: Surrounding, around: Around, reach: f32, cells: i32, lane: u32, up: vec3<f32>) {
    let place = 2u * slot + way;
    let free = drops[place].mass <= 0.0;
    let wanted = mass_of(burst, around);
    let liquid = take_liquid(bubble, s, select(0.0, wanted, free), reach, cells, lane);
    if (lane == 0u) {
        if (wanted > 0.0 && !free) { atomicAdd(&counters.spray_refused, 1u); }
        if (liquid.mass > 0.0) {
            let seed = bitcast<u32>(bubble.position.x) + way;
            let side = sideways(up, slot, seed);
            let leans = LEANS * lot(seed, slot);
            let direction = select(side + leans * up, up + leans * side, way == OF_JET);
            throw_up(place, bubble, s, burst, liquid, around.density, normalize(direction), up);
        }
    }
}

/// Takes steam of the particle with that identity, or gives it.
fn exchange_with(identity: u32, steam: i32, enthalpy: i32) {
    atomicSub(&bubbled[identity * BUBBLED_WORDS + BUBBLED_MASS], steam);
    atomicSub(&bubbled[identity * BUBBLED_WORDS + BUBBLED_ENTHALPY], enthalpy);
}

/// A nucleus at particle i.
fn born(before: Bubble, i: u32) -> Bubble {
    var bubble = before;
    bubble.position = position[i].xyz;
    bubble.velocity = velocity[i].xyz;
    bubble.membership = tags[i].x;
    bubble.surfaced = 0.0;
    bubble.touching = 0.0;
    let temperature = heat[i].x;
    let volume = 4.0 / 3.0 * BUBBLE_PI * NUCLEUS * NUCLEUS * NUCLEUS;
    let steam = quanta(volume * steam_density(temperature) / MASS, MASS_QUANTUM);
    bubble.mass = f32(steam) * MASS_QUANTUM;
    let enthalpy = quanta(bubble.mass * steam_enthalpy(temperature), ENTHALPY_QUANTUM);
    bubble.enthalpy = f32(enthalpy) * ENTHALPY_QUANTUM;
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
    let slot = id.x / LANES;
    let lane = id.x % LANES;
    let of_group = local / LANES;
    let first = step.before_bubbles;
    let other_first = SLOTS - first;
    if (lane == 0u) {
        claimed[of_group] = claims[slot];
        let words = 2u * (first + slot);
        joined[of_group] = vec2<i32>(atomicLoad(&merging[words]), atomicLoad(&merging[words + 1u]));
        atomicStore(&merging[words], 0);
        atomicStore(&merging[words + 1u], 0);
        claims[slot] = 0u;
    }
    workgroupBarrier();
    let claim = claimed[of_group];
    let joins = joined[of_group];
    let time = step.bubble_time;
    let gravity = vec3<f32>(GRAVITY_X, GRAVITY_Y, GRAVITY_Z);
    let up = -gravity / max(length(gravity), 1e-9);

    var bubble = bubbles[first + slot];
    bubble.mass += f32(joins.x) * JOINED_MASS_QUANTUM;
    bubble.enthalpy += f32(joins.y) * JOINED_ENTHALPY_QUANTUM;
    let is_born = bubble.mass <= 0.0 && claim > 0u;
    if (is_born) { bubble = born(bubble, claim - 1u); }
    bubble.radius = radius_of_volume(volume_of(bubble.mass, bubble.enthalpy));
    // All lanes of a place return alike.
    if (bubble.mass <= 0.0) {
        if (lane == 0u) { bubbles[other_first + slot] = bubble; }
        return;
    }
    let cells = clamp(i32(ceil((SUPPORT + bubble.radius) / CELL)), 1, MOST_CELLS);
    let reach = min(SUPPORT + bubble.radius, f32(cells) * SUPPORT);

    let s = gather(bubble, slot, first, reach, cells, lane, up);
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
    let wall = boundary_volume(bubble.membership, bubble.position, step.after, lane);
    if (lane != 0u) { return; }
    let nearest = tags[s.nearest.particle].y;
    if (is_born) {
        exchange_with(tags[claim - 1u].y, quanta(bubble.mass, MASS_QUANTUM), quanta(bubble.enthalpy, ENTHALPY_QUANTUM));
    } else if (claim > 0u) {
        atomicAdd(&counters.bubbles_refused, 1u);
    }
    bubble.mass = max(bubble.mass + gained.mass, 0.0);
    bubble.enthalpy += gained.enthalpy;
    let alone = s.weight <= 0.0;
    if (c.vanishes && !alone && bubble.mass < MOST_AT_ONCE) {
        exchange_with(nearest, -quanta(bubble.mass, MASS_QUANTUM), -quanta(bubble.enthalpy, ENTHALPY_QUANTUM));
        bubble.mass = 0.0;
        bubble.enthalpy = 0.0;
        bubbles[other_first + slot] = bubble;
        return;
    }

    let at_surface = cover_of(s.cover, wall, up) < COVERED;
    // What new ones push under for a moment is no younger for it.
    bubble.surfaced = max(bubble.surfaced + select(-time, time, at_surface), 0.0);
    if (alone || bursts) {
        bubble.gone += vec2<f32>(bubble.mass, bubble.enthalpy);
        bubble.mass = 0.0;
        bubble.enthalpy = 0.0;
        bubbles[other_first + slot] = bubble;
        return;
    }

    var relative = risen(bubble.velocity - s.velocity, up, bubble.radius, s.gas / (1.0 + s.gas), around, time);
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
            let words = 2u * (other_first + other_slot);
            let steam = quanta(bubble.mass, JOINED_MASS_QUANTUM);
            let enthalpy = quanta(bubble.enthalpy, JOINED_ENTHALPY_QUANTUM);
            atomicAdd(&merging[words], steam);
            atomicAdd(&merging[words + 1u], enthalpy);
            // What the coarser quanta leave is a particle's.
            let mass_left = bubble.mass - f32(steam) * JOINED_MASS_QUANTUM;
            let enthalpy_left = bubble.enthalpy - f32(enthalpy) * JOINED_ENTHALPY_QUANTUM;
            exchange_with(nearest, -quanta(mass_left, MASS_QUANTUM), -quanta(enthalpy_left, ENTHALPY_QUANTUM));
            bubble.mass = 0.0;
            bubble.enthalpy = 0.0;
        }
    }
    // Liquid that is poured changes its flask, and what is in it with it.
    if (s.nearest_of_all.distance < 0.5 * SPACING) { bubble.membership = tags[s.nearest_of_all.particle].x; }
    if (bubble.mass > 0.0) {
        atomicMax(&bubbled[nearest * BUBBLED_WORDS + BUBBLED_NEXT], i32(key_of(bubble, slot)));
    }
    bubbles[other_first + slot] = bubble;
}
