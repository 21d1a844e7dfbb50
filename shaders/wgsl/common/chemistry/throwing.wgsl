// Drops that a bubble throws up as it bursts. For passes that have `bubble_surroundings.wgsl`.
//!include common/chemistry/bubble_surroundings.wgsl
//!include common/chemistry/drops.wgsl
//!include common/chemistry/quanta_sum.wgsl
//!include common/chemistry/spray_laws.wgsl
//!include common/liquid/counters.wgsl
//!include common/maths/lot.wgsl

@group(0) @binding(14) var<storage, read_write> drops: array<Drops>;
/// By identity: what drops did to a particle.
@group(0) @binding(15) var<storage, read_write> sprayed: array<atomic<i32>>;

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
    let count = select(0u, count_around(cells), mass > 0.0);
    for (var n = lane; n < count; n += LANES) {
        let run = cell_within(bubble.position, reach, cells, n);
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
    drops[place].about = burst.about;
    drops[place].memberships = bubble.membership | (bubble.membership << 16u);
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
            throw_up(place, bubble, s, burst, liquid, around.density, direction, up);
        }
    }
}
