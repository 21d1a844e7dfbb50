// Where the liquid is, and what went from where to where since the last look: of this panel, marks on gloves, sound and incidents
// are made. It changes nothing that the solver reads. All sums are of whole numbers, so their order does not matter.
//!include common/chemistry/bubble.wgsl
//!include common/chemistry/drops.wgsl
//!include common/chemistry/features.wgsl
//!include common/chemistry/solution.wgsl
//!include common/glass/glass_distance.wgsl
//!include common/glass/ground.wgsl
//!include common/liquid/particle.wgsl

/// What a share of 1 is in a sum; so many that all particles' shares fit a word.
override WHOLE: u32 = 65536u;
/// Height over table or floor up to which liquid lies on it, m.
override LYING: f32 = 0.01;
/// Acid fraction, and temperature in °C, from which on liquid hurts.
override HARMFUL: f32 = 0.05;
override SCALDS: f32 = 55.0;
/// ρ0, kg/m³.
override REST_DENSITY: f32 = 1000.0;
/// Half of a particle, m: as near to skin it touches.
override TOUCHES: f32 = 0.00125;
/// T_B of the paper, °C; the physical chemistry has one for each composition.
override PAPERS_BOILING_POINT: f32 = 100.0;

/// Places: the flasks come first, behind them the air, the table, the floor, and what skin there is.
const IN_AIR = 0u;
const ON_TABLE = 1u;
const ON_FLOOR = 2u;
const SKIN = 3u;
const SKINS = 3u;

/// Words of a place: what is there, what came there from elsewhere, and its bubbles.
const WORDS = 23u;
const HERE = 0u;
const VOLUME_HERE = 1u;
const WARMTH = 2u;
const ACID = 3u;
const CAME = 4u;
const CAME_VOLUME = 5u;
const CAME_SPEED = 6u;
const CAME_X = 7u;
const CAME_Y = 8u;
const CAME_Z = 9u;
const CAME_ACID = 10u;
const BUBBLES_HERE = 11u;
const RADII = 12u;
const BORN = 13u;
const COLLAPSED = 14u;
const COLLAPSED_RADII = 15u;
const BURST = 16u;
const BURST_RADII = 17u;
const CAME_WARMTH = 18u;
/// The largest shares of any particle, not sums.
const HOTTEST = 19u;
const SUPERHEAT = 20u;
const BUBBLES_VOLUME = 21u;
/// Of skin: what came to it that is as good as water.
const RINSED = 22u;

/// Behind the places, by place and flask: what came there from elsewhere and had been in that flask last.
const MOVED_WORDS = 3u;
const MOVED = 0u;
const MOVED_VOLUME = 1u;
/// Volume times acid fraction.
const MOVED_ACID = 2u;

/// Behind these: how many drops came to rest since the last look, and so many of them, in any order; and the same of those on glass, which
/// have a list of their own, so that they take no place from those on skin.
const LANDINGS = 64u;
const LANDINGS_ON_GLASS = 32u;
const LANDING_WORDS = 9u;
/// Onto what, beside the numbers of whose skin; from the last on, the number of the flask is added.
const ONTO_TABLE = 3u;
const ONTO_FLOOR = 4u;
const ONTO_FLASK = 5u;

/// What a share of 1 stands for: °C from the first to the second; particles' volumes; and in `reach` a speed's seconds
/// and a radius.
const WARMTHS = vec2<f32>(-50.0, 350.0);
/// K above the boiling point.
const SUPERHEATS = vec2<f32>(-350.0, 150.0);
const VOLUMES = 8.0;
const SPEEDS = 8.0;
const BUBBLE_RADII = 1.0 / 256.0;

/// Volume of a sphere of radius 1.
const SPHERE = 4.18879;

/// A look.
struct CensusRun {
    /// Middle of the cube in which places are told apart, and half of its edge, m.
    centre: vec3<f32>,
    reach: f32,
    /// Time since the last look, s.
    elapsed: f32,
    /// Parts of skin.
    limbs: u32,
    /// Whether there was none before.
    first: u32,
    /// Substeps of the frame before the look: so many sets of poses are behind that of the frame's start.
    substeps: u32,
}

/// A part of skin: the hull of two spheres, m, and whose it is (0 left hand, 1 right hand, 2 face).
struct Limb {
    a: vec3<f32>,
    radius_a: f32,
    b: vec3<f32>,
    radius_b: f32,
    whose: u32,
}

/// What a bubble was at the last look.
struct BubbleBefore {
    /// The largest since it was born, m; 0 for none.
    peak: f32,
    /// Steam and air that had left from its place.
    gone: f32,
    /// Whether it was about to join a larger one.
    touching: f32,
    membership: u32,
    /// What of the drops in its place had come to rest since the start, of its jet and of its film, V0·ρ0.
    fallen: vec2<f32>,
}

var<immediate> run: CensusRun;

@group(0) @binding(0) var<storage, read> position: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> velocity: array<vec4<f32>>;
/// (membership, identity)
@group(0) @binding(2) var<storage, read> tags: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read> heat: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read> bulk: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read> bubbles: array<Bubble>;
@group(0) @binding(6) var<storage, read> drops: array<Drops>;
@group(0) @binding(7) var<storage, read> limbs: array<Limb>;
/// By identity: the place; from bit 13 on whom it has rinsed, from bit 16 on whom it has touched, and whether it has lain since it was in a flask; from bit 21 on
/// the number of the flask in which it was last, from 1 on.
@group(0) @binding(8) var<storage, read_write> places_before: array<u32>;
@group(0) @binding(9) var<storage, read_write> bubbles_before: array<BubbleBefore>;
@group(0) @binding(10) var<storage, read_write> tallies: array<atomic<u32>>;

/// Looks on a way as long as `reach`, so that no finger is between two; and most of them, which are enough for 6 cm.
const LOOKS = 500.0;
const MOST_LOOKS = 8.0;

/// Whether the user's hands can be rinsed.
override RINSING: bool = false;

const PLACE: u32 = 0x1fffu;
const WETTED: u32 = 13u;
const TOUCHED: u32 = 16u;
const LAIN: u32 = 19u;
const ORIGIN: u32 = 21u;
const MOST_ORIGINS: u32 = 2047u;
/// Places whose sums a workgroup makes by itself; the rest, of scenes with many flasks, go one by one.
const NEAR_PLACES = 16u;
var<workgroup> near: array<atomic<u32>, 368>;

fn tally(place: u32, word: u32, amount: u32) {
    let index = place * WORDS + word;
    if (place < NEAR_PLACES) {
        atomicAdd(&near[index], amount);
    } else {
        atomicAdd(&tallies[index], amount);
    }
}

fn largest(place: u32, word: u32, amount: u32) {
    let index = place * WORDS + word;
    if (place < NEAR_PLACES) {
        atomicMax(&near[index], amount);
    } else {
        atomicMax(&tallies[index], amount);
    }
}

/// What was in flask `origin` (from 1 on) last came to a place.
fn moved(place: u32, origin: u32, volume: f32, acid: f32) {
    if (origin == 0u || origin > FLASKS) { return; }
    let index = (FLASKS + SKIN + SKINS) * WORDS + (place * FLASKS + origin - 1u) * MOVED_WORDS;
    atomicAdd(&tallies[index + MOVED], 1u);
    atomicAdd(&tallies[index + MOVED_VOLUME], share(volume, 0.0, VOLUMES));
    atomicAdd(&tallies[index + MOVED_ACID], share(volume * acid, 0.0, VOLUMES));
}

/// A drop came to rest at the end of a way: onto what (0 to 2: whose skin), its volume over V0 and its acid fraction. On a flask, the place is in
/// the flask's frame. Those that find no place in their list are only not drawn.
fn landed(onto: u32, x: vec3<f32>, way: vec3<f32>, volume: f32, acid: f32) {
    let places = FLASKS + SKIN + SKINS;
    var base = places * WORDS + places * FLASKS * MOVED_WORDS;
    var most = LANDINGS;
    if (onto >= ONTO_FLASK) {
        base += 1u + LANDINGS * LANDING_WORDS;
        most = LANDINGS_ON_GLASS;
    }
    let n = atomicAdd(&tallies[base], 1u);
    if (n >= most) { return; }
    let at = base + 1u + n * LANDING_WORDS;
    atomicStore(&tallies[at], onto);
    for (var k = 0u; k < 3u; k++) {
        atomicStore(&tallies[at + 1u + k], bitcast<u32>(x[k]));
        atomicStore(&tallies[at + 4u + k], bitcast<u32>(way[k]));
    }
    atomicStore(&tallies[at + 7u], bitcast<u32>(volume));
    atomicStore(&tallies[at + 8u], bitcast<u32>(acid));
}

/// A value's share of the way from `low` to `high`.
fn share(value: f32, low: f32, high: f32) -> u32 {
    return u32(round(clamp((value - low) / (high - low), 0.0, 1.0) * f32(WHOLE)));
}

/// What came to a place, and how.
fn came(place: u32, x: vec3<f32>, v: vec3<f32>, volume: f32, acid: f32, celsius: f32) {
    tally(place, CAME, 1u);
    tally(place, CAME_VOLUME, share(volume, 0.0, VOLUMES));
    tally(place, CAME_SPEED, share(length(v), 0.0, SPEEDS * run.reach));
    let low = run.centre - run.reach;
    let high = run.centre + run.reach;
    tally(place, CAME_X, share(x.x, low.x, high.x));
    tally(place, CAME_Y, share(x.y, low.y, high.y));
    tally(place, CAME_Z, share(x.z, low.z, high.z));
    tally(place, CAME_ACID, share(acid, 0.0, 1.0));
    tally(place, CAME_WARMTH, share(celsius, WARMTHS.x, WARMTHS.y));
}

fn place_of(membership: u32, x: vec3<f32>) -> u32 {
    if (membership > NOBODYS && membership <= FLASKS) { return membership - 1u; }
    if (TABLE) {
        if (beyond_table(x) <= 0.0 && x.y >= TABLE_TOP - LYING && x.y < TABLE_TOP + LYING) { return FLASKS + ON_TABLE; }
    }
    return FLASKS + select(IN_AIR, ON_FLOOR, x.y < FLOOR + LYING);
}

/// Bits of those whose skin is at `x`.
fn touched_at(x: vec3<f32>) -> u32 {
    var touched = 0u;
    for (var n = 0u; n < run.limbs; n++) {
        let limb = limbs[n];
        let along = limb.b - limb.a;
        let at = saturate(dot(x - limb.a, along) / max(dot(along, along), 1e-20));
        let apart = distance(x, limb.a + at * along);
        if (apart < mix(limb.radius_a, limb.radius_b, at) + TOUCHES) { touched |= 1u << limb.whose; }
    }
    return touched;
}

/// The same on the way since the last look, where the particle was in no flask then: what falls on a hand is through it in less than a
/// frame.
fn touched_on_way(x: vec3<f32>, v: vec3<f32>, was_free: bool) -> u32 {
    if (run.limbs == 0u || !was_free) { return 0u; }
    let way = v * run.elapsed;
    let looks = clamp(ceil(length(way) * LOOKS / run.reach), 1.0, MOST_LOOKS);
    var touched = 0u;
    for (var look = 1.0; look < looks; look += 1.0) { touched |= touched_at(x - look / looks * way); }
    return touched;
}

/// °C.
fn boiling_point(acid: f32) -> f32 {
    if (PHYSICAL) { return row_at(acid).value.boiling_point; }
    return PAPERS_BOILING_POINT;
}

fn count_particle(i: u32) {
    let tag = tags[i];
    if (tag.x == REMOVED) { return; }
    let x = position[i].xyz;
    let v = velocity[i].xyz;
    var volume = 1.0;
    var celsius = 0.0;
    var acid = 0.0;
    if (PHYSICAL) { volume = bulk[i].x; }
    if (HEAT) {
        celsius = heat[i].x;
        acid = heat[i].y;
    }
    let place = place_of(tag.x, x);
    tally(place, HERE, 1u);
    tally(place, VOLUME_HERE, share(volume, 0.0, VOLUMES));
    tally(place, WARMTH, share(celsius, WARMTHS.x, WARMTHS.y));
    tally(place, ACID, share(acid, 0.0, 1.0));
    if (HEAT) {
        largest(place, HOTTEST, share(celsius, WARMTHS.x, WARMTHS.y));
        largest(place, SUPERHEAT, share(celsius - boiling_point(acid), SUPERHEATS.x, SUPERHEATS.y));
    }
    let before = select(places_before[tag.y], 0u, run.first != 0u);
    var wetted = (before >> WETTED) & 7u;
    var touched = (before >> TOUCHED) & 7u;
    var lain = (before >> LAIN) & 1u;
    var origin = before >> ORIGIN;
    if (run.first == 0u && (before & PLACE) != place) {
        came(place, x, v, volume, acid, celsius);
        // What bounces on a table, or runs off it, comes to lie once.
        let lies = place > FLASKS + IN_AIR;
        if (!lies || lain == 0u) { moved(place, origin, volume, acid); }
        lain |= u32(lies);
    }
    if (place < FLASKS) {
        origin = min(place + 1u, MOST_ORIGINS);
        lain = 0u;
        touched = 0u;
        wetted = 0u;
    }
    if (tag.x == NOBODYS && (acid >= HARMFUL || (HEAT && celsius >= SCALDS))) {
        let now = touched_at(x);
        let way = touched_on_way(x, v, run.first == 0u && (before & PLACE) >= FLASKS);
        for (var whose = 0u; whose < SKINS; whose++) {
            let bit = 1u << whose;
            let part = FLASKS + SKIN + whose;
            if ((now & bit) != 0u) { tally(part, HERE, 1u); }
            if (((now | way) & bit & ~touched) != 0u) {
                came(part, x, v, volume, acid, celsius);
                moved(part, origin, volume, acid);
            }
        }
        touched |= now | way;
    } else if (RINSING && tag.x == NOBODYS) {
        let was_free = run.first == 0u && (before & PLACE) >= FLASKS;
        let reached = touched_at(x) | touched_on_way(x, v, was_free);
        for (var whose = 0u; whose < SKINS; whose++) {
            if ((reached & ~wetted & (1u << whose)) != 0u) { tally(FLASKS + SKIN + whose, RINSED, share(volume, 0.0, VOLUMES)); }
        }
        wetted |= reached;
    }
    places_before[tag.y] = place | wetted << WETTED | touched << TOUCHED | lain << LAIN | origin << ORIGIN;
}

/// Where drops lie on the outside of glass.
struct OnGlass {
    /// FLASKS for none.
    flask: u32,
    /// In that flask's frame, on the glass.
    place: vec3<f32>,
    /// How far from the glass they came to rest, m; LYING for none.
    apart: f32,
}

/// The outside of glass nearest to where drops came to rest in the last frame, as far off as the tables reach. All poses of the frame are
/// looked at, because the drops stayed where they were in the stage and the glass has moved on since.
fn on_glass(x: vec3<f32>) -> OnGlass {
    var nearest = OnGlass(FLASKS, x, SUPPORT);
    for (var n = 0u; n <= run.substeps; n++) {
        for (var k = 0u; k < FLASKS; k++) {
            let p = flask_from_stage(poses[n * FLASKS + k], x);
            let gap = glass(k, p);
            if (gap.distance >= 0.0 && gap.distance < nearest.apart && !is_inside(k, p)) {
                nearest = OnGlass(k, p - gap.distance * gap.normal, gap.distance);
            }
        }
    }
    if (nearest.flask == FLASKS) { nearest.apart = LYING; }
    return nearest;
}

/// What of a record's drops came to rest since the start, of which `before` was known at the last look. What came to lie on table or floor,
/// or on the outside of glass, since then is listed where it lies; on the inside, where it runs down into the liquid, it is not.
fn fallen_of(n: u32, before: f32) -> f32 {
    let flight = drops[n];
    let mass = flight.fallen.x - before;
    // Where new drops fly already, the place is theirs.
    if (run.first != 0u || mass <= 0.0 || flight.mass > 0.0) { return flight.fallen.x; }
    if ((flight.memberships >> 16u) != NOBODYS || flight.density <= 0.0) { return flight.fallen.x; }
    var x = flight.position;
    let on = on_glass(x);
    let over_floor = x.y - FLOOR;
    let over_table = x.y - TABLE_TOP;
    var onto = ONTO_FLASK + on.flask;
    if (over_floor < on.apart) {
        onto = ONTO_FLOOR;
        x.y = FLOOR;
    } else if (TABLE && place_of(NOBODYS, x) == FLASKS + ON_TABLE && over_table < on.apart) {
        onto = ONTO_TABLE;
        x.y = TABLE_TOP;
    } else if (on.flask < FLASKS) {
        x = on.place;
    } else {
        return flight.fallen.x;
    }
    // The record keeps the acid of the drops that fell last.
    landed(onto, x, vec3<f32>(0.0), mass * REST_DENSITY / flight.density, saturate(flight.acid / mass));
    return flight.fallen.x;
}

fn count_bubble(slot: u32) {
    let bubble = bubbles[slot];
    let before = bubbles_before[slot];
    let here = is_there(bubble);
    let gone = bubble.gone.x + bubble.air_gone;
    let was = run.first == 0u && before.peak > 0.0;
    let same = was && here && bubble.membership == before.membership && gone == before.gone;
    let peak = select(0.0, max(bubble.radius, select(0.0, before.peak, same)), here);
    var fallen = vec2<f32>(0.0);
    if (SPRAY) { fallen = vec2<f32>(fallen_of(2u * slot, before.fallen.x), fallen_of(2u * slot + 1u, before.fallen.y)); }
    bubbles_before[slot] = BubbleBefore(peak, gone, bubble.touching, bubble.membership, fallen);
    let most = BUBBLE_RADII * run.reach;
    if (here) {
        let place = min(bubble.membership - 1u, FLASKS);
        tally(place, BUBBLES_HERE, 1u);
        tally(place, RADII, share(bubble.radius, 0.0, most));
        let radius = bubble.radius / (2.0 * TOUCHES);
        tally(place, BUBBLES_VOLUME, share(SPHERE * radius * radius * radius, 0.0, VOLUMES));
        if (run.first == 0u && !same) { tally(place, BORN, 1u); }
    }
    if (was && !same) {
        let place = min(before.membership - 1u, FLASKS);
        if (gone > before.gone) {
            tally(place, BURST, 1u);
            tally(place, BURST_RADII, share(before.peak, 0.0, most));
        } else if (before.touching == 0.0) {
            tally(place, COLLAPSED, 1u);
            tally(place, COLLAPSED_RADII, share(before.peak, 0.0, most));
        }
    }
}

/// Drops that came to skin in this time: they have no identity, so they are told by having been outside.
fn count_drops(n: u32) {
    let flying = drops[n];
    if (flying.mass <= 0.0) { return; }
    let acid = flying.acid / flying.mass;
    let celsius = temperature_with_steam(row_at(acid), flying.enthalpy / flying.mass, 0.0);
    if (acid < HARMFUL && celsius < SCALDS) { return; }
    let now = touched_at(flying.position) & ~touched_at(flying.position - run.elapsed * flying.velocity);
    for (var whose = 0u; whose < SKINS; whose++) {
        if ((now & (1u << whose)) == 0u) { continue; }
        let volume = flying.mass * REST_DENSITY / flying.density;
        came(FLASKS + SKIN + whose, flying.position, flying.velocity, volume, acid, celsius);
        moved(FLASKS + SKIN + whose, flying.memberships & 0xffffu, volume, acid);
        landed(whose, flying.position, run.elapsed * flying.velocity, volume, acid);
    }
}

@compute @workgroup_size(256)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let places = min(FLASKS + SKIN + SKINS, NEAR_PLACES);
    for (var n = local; n < places * WORDS; n += 256u) { atomicStore(&near[n], 0u); }
    workgroupBarrier();
    let i = id.x;
    if (i < COUNT) { count_particle(i); }
    if (BUBBLES && i < SLOTS) { count_bubble(i); }
    if (SPRAY && i < 2u * SLOTS && run.first == 0u && run.limbs > 0u) { count_drops(i); }
    workgroupBarrier();
    for (var n = local; n < places * WORDS; n += 256u) {
        let sum = atomicLoad(&near[n]);
        if (sum == 0u) { continue; }
        if (n % WORDS == HOTTEST || n % WORDS == SUPERHEAT) {
            atomicMax(&tallies[n], sum);
        } else {
            atomicAdd(&tallies[n], sum);
        }
    }
}
