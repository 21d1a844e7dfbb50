// What became of bubbles and drops since the last look. Dormant while there were none (`LOOK_GROUPS`).
//!include common/chemistry/bubble.wgsl
//!include common/chemistry/drops.wgsl
//!include common/chemistry/slots.wgsl
//!include common/chemistry/solution.wgsl
//!include common/glass/glass_distance.wgsl
//!include common/liquid/particle.wgsl
//!include common/liquid/tallies.wgsl

/// ρ0, kg/m³.
override REST_DENSITY: f32 = 1000.0;

/// Volume of a sphere of radius 1.
const SPHERE = 4.18879;

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

@group(0) @binding(0) var<storage, read> bubbles: array<Bubble>;
@group(0) @binding(1) var<storage, read> drops: array<Drops>;
@group(0) @binding(2) var<storage, read_write> bubbles_before: array<BubbleBefore>;

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
    begin_sums(local);
    if (id.x < SLOTS) {
        count_bubble(id.x);
        if (SPRAY && run.first == 0u && run.limbs > 0u) {
            count_drops(2u * id.x);
            count_drops(2u * id.x + 1u);
        }
    }
    end_sums(local);
}
