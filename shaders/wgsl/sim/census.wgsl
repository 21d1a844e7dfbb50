// Where the liquid is, and what went from where to where since the last look.
//!include common/chemistry/features.wgsl
//!include common/chemistry/slots.wgsl
//!include common/chemistry/solution.wgsl
//!include common/liquid/particle.wgsl
//!include common/liquid/tallies.wgsl

/// T_B of the paper, °C; the physical chemistry has one for each composition.
override PAPERS_BOILING_POINT: f32 = 100.0;
/// Whether the user's hands can be rinsed.
override RINSING: bool = false;

@group(0) @binding(0) var<storage, read> position: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> velocity: array<vec4<f32>>;
/// (membership, identity)
@group(0) @binding(2) var<storage, read> tags: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read> heat: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read> bulk: array<vec4<f32>>;
/// Behind the places see `LOOK_GROUPS`.
@group(0) @binding(5) var<storage, read_write> claims: array<u32>;
/// By identity: the place; from bit 13 on whom it has rinsed, from bit 16 on whom it has touched, and whether it has lain since it was in a flask; from bit 21 on
/// the number of the flask in which it was last, from 1 on.
@group(0) @binding(8) var<storage, read_write> places_before: array<u32>;

/// Looks on a way as long as `reach`, so that no finger is between two; and most of them, which are enough for 6 cm.
const LOOKS = 500.0;
const MOST_LOOKS = 8.0;

const PLACE: u32 = 0x1fffu;
const WETTED: u32 = 13u;
const TOUCHED: u32 = 16u;
const LAIN: u32 = 19u;
const ORIGIN: u32 = 21u;
const MOST_ORIGINS: u32 = 2047u;

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

@compute @workgroup_size(256)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    begin_sums(local);
    if (id.x < COUNT) { count_particle(id.x); }
    end_sums(local);
    if (BUBBLES) {
        // The last bubbles and drops were looked at before this pass.
        if (id.x == 0u && claims[SLOTS + LIVE_GROUPS] == 0u) { claims[SLOTS + LOOK_GROUPS] = 0u; }
    }
}
