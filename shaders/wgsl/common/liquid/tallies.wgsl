// What a look counts: by place what is there and what came there. Of this panel, marks on gloves, sound and incidents are made. It changes
// nothing that a step reads. All sums are of whole numbers, so their order does not matter.
//!include common/glass/ground.wgsl
//!include common/glass/vessel.wgsl

/// What a share of 1 is in a sum; so many that all particles' shares fit a word.
override WHOLE: u32 = 65536u;
/// Height over table or floor up to which liquid lies on it, m.
override LYING: f32 = 0.01;
/// Acid fraction, and temperature in °C, from which on liquid hurts.
override HARMFUL: f32 = 0.05;
override SCALDS: f32 = 55.0;
/// Half of a particle, m: as near to skin it touches.
override TOUCHES: f32 = 0.00125;

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

var<immediate> run: CensusRun;

@group(0) @binding(7) var<storage, read> limbs: array<Limb>;
@group(0) @binding(10) var<storage, read_write> tallies: array<atomic<u32>>;

/// Places whose sums a workgroup makes by itself; the rest, of scenes with many flasks, go one by one.
const NEAR_PLACES = 16u;
var<workgroup> near: array<atomic<u32>, 368>;

/// Whether a workgroup sums up that place.
fn is_near(place: u32) -> bool {
    return FLASKS + SKIN + SKINS <= NEAR_PLACES || place < NEAR_PLACES;
}

fn tally(place: u32, word: u32, amount: u32) {
    let index = place * WORDS + word;
    if (is_near(place)) {
        atomicAdd(&near[index], amount);
    } else {
        atomicAdd(&tallies[index], amount);
    }
}

fn largest(place: u32, word: u32, amount: u32) {
    let index = place * WORDS + word;
    if (is_near(place)) {
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

/// Begins a workgroup's sums.
fn begin_sums(local: u32) {
    let places = min(FLASKS + SKIN + SKINS, NEAR_PLACES);
    for (var n = local; n < places * WORDS; n += 256u) { atomicStore(&near[n], 0u); }
    workgroupBarrier();
}

/// Adds a workgroup's sums to those of all.
fn end_sums(local: u32) {
    let places = min(FLASKS + SKIN + SKINS, NEAR_PLACES);
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
