// What is around a bubble: particles, by the cells of the last rebuild, and other bubbles, by the particles that they are nearest to.
// For passes that bind particles, `boils`, `gas`, `bubbles` and `bubbled` as `sim/bubbles.wgsl` does.
//!include common/chemistry/bubble_laws.wgsl
//!include common/chemistry/bubbled.wgsl
//!include common/chemistry/bulk.wgsl
//!include common/chemistry/cavity.wgsl
//!include common/liquid/cells_around.wgsl
//!include common/liquid/lane_nearest.wgsl

/// How far from its surface a bubble exchanges steam, m, as coarse particles do too, and at least over d: with less it would lie between
/// particles. Chosen.
const CONTACT: f32 = 3.5e-3;
const LEAST_CONTACT: f32 = 1.2;

fn contact_length() -> f32 {
    return max(CONTACT, LEAST_CONTACT * SPACING);
}

/// How far from its surface a bubble has to do with liquid, m.
fn reach_beyond() -> f32 {
    return max(SUPPORT, contact_length());
}

/// How much a particle at a share q of the reach counts, by its square; FULL is its integral over reach³.
const FULL: f32 = 0.957442;
fn share_at(square: f32) -> f32 {
    let left = max(1.0 - square, 0.0);
    return left * left;
}

/// How much of a bubble's exchange a particle at that square of a distance has: those that touch it, or nearly.
fn contact_at(square: f32, radius: f32) -> f32 {
    let reach = radius + contact_length();
    return share_at(square / (reach * reach));
}

/// Least share of liquid that is divided by: of a lone drop between cavities.
const LEAST_LIQUID: f32 = 0.25;
/// Gas of a particle over its liquid from which on bubbles around it become cavities: with more, its neighbours are too far.
const HELD: f32 = 1.5;

/// Share of a particle's neighbourhood that no cavity takes but that of `bubble`.
fn liquid_share(j: u32, distance: f32, bubble: Bubble) -> f32 {
    var others = hollow[j];
    if (bubble.cavity > 0.0) { others -= bubble.cavity * cavity_at(distance, bubble.radius).x; }
    return clamp(1.0 - others, LEAST_LIQUID, 1.0);
}

/// Least share of a full neighbourhood that counts as what is below a bubble: where there is less, it lies at the bottom.
const LEAST_BELOW: f32 = 0.4;

/// How much what lies in a direction of that cosine with upwards covers a bubble: of a cavity what lies straight above it, as its sides
/// may lie at glass. Both have the same integral over all directions.
fn above_at(cosine: f32, cavity: f32) -> f32 {
    let square = cosine * cosine;
    return mix(cosine, 2.5 * square * square, cavity);
}

/// Share of the integral of `share_at` that lies beyond the share q of the reach.
fn covered_beyond(q: f32) -> f32 {
    let square = q * q;
    return 1.0 - q * square * (35.0 - square * (42.0 - 15.0 * square)) / 8.0;
}

/// What covers a place the share q of the reach under a level surface: ∫ cos θ (1 − r²)² over what of a ball's upper half lies below it,
/// over that of the whole half.
fn cover_under(q: f32) -> f32 {
    let square = q * q;
    return square * (7.0 + q * (-8.75 + square * (3.5 - 0.75 * square)));
}

/// The larger of two bubbles has the larger key.
fn key_of(bubble: Bubble, slot: u32) -> u32 {
    return (u32(min(bubble.radius * 1e6, 32767.0)) << 16u) | slot;
}

/// Whether a bubble touches that of another record.
fn touches(bubble: Bubble, record: u32) -> bool {
    let other = bubbles[record];
    if (!is_there(other) || other.membership != bubble.membership) { return false; }
    return distance(other.position, bubble.position) <= bubble.radius + other.radius;
}

/// What is around a bubble, over the sum of the weights but for the weights and `cover`.
struct Surrounding {
    weight: f32,
    /// Of what exchanges steam with it, which is nearer.
    contact: f32,
    cover: f32,
    /// Share of its neighbourhood that is liquid.
    filled: f32,
    velocity: vec3<f32>,
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
    /// Gas of what is around over what it can hold.
    crowded: f32,
    /// Share of gas in what is around, but for its own.
    crowd: f32,
}

/// Of `bubble` in `slot` within `reach`, in cells `cells` around its own; others are those from `first` on. All lanes must ask.
fn gather(bubble: Bubble, slot: u32, first: u32, reach: f32, cells: i32, lane: u32, up: vec3<f32>) -> Surrounding {
    var s: Surrounding;
    s.nearest = Nearest(1e9, 0u);
    s.nearest_of_all = Nearest(1e9, 0u);
    let key = key_of(bubble, slot);
    let share = bubble.cavity;
    var below = 0.0;
    var own_share = 0.0;
    let count = select(0u, count_around(cells), is_there(bubble));
    for (var n = lane; n < count; n += LANES) {
        let run = cell_within(bubble.position, reach, cells, n);
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
            s.contact += contact;
            let filled = weight * (1.0 + gas[tags[j].y].x) / liquid_share(j, distance, bubble);
            let cosine = dot(offset, up) / distance;
            s.cover += above_at(max(cosine, 0.0), share) * filled;
            below += above_at(max(-cosine, 0.0), share) * filled;
            s.velocity += weight * velocity[j].xyz;
            s.temperature += weight * heat[j].x;
            s.acid += weight * heat[j].y;
            s.superheat += excess;
            s.subcooling += lack;
            s.growing += excess * boil.z;
            s.shrinking += lack * boil.z;
            s.nearest = nearer(s.nearest, Nearest(distance, j));
            let held = gas[tags[j].y];
            let extent = unpack_bulk(bulk[j]).volume;
            s.crowded += weight * held.y / max(HELD * (extent - held.x), 1e-3);
            s.crowd += weight * (1.0 - liquid_share(j, distance, bubble) * (1.0 - held.x / extent));
            own_share += weight * weight / extent;
        }
    }
    s.weight = lane_sum(s.weight);
    let around = max(1.0 - share * (1.0 - covered_beyond(min(bubble.radius / reach, 1.0))), 0.1);
    let whole = 4.0 * VOLUME / (FULL * around * reach * reach * reach);
    // A bubble that particles hold has pushed them away, above it as below it.
    let under = lane_sum(below) * whole;
    s.cover = lane_sum(s.cover) * whole;
    s.filled = 0.5 * (s.cover + under);
    s.cover /= mix(clamp(under, LEAST_BELOW, 1.0), 1.0, share);
    s.crowded = lane_sum(s.crowded);
    s.velocity = lane_sum3(s.velocity);
    let thermal = lane_sum3(vec3<f32>(s.temperature, s.acid, s.contact));
    s.contact = thermal.z;
    let excess = vec2<f32>(lane_sum(s.superheat), lane_sum(s.growing));
    let lack = vec2<f32>(lane_sum(s.subcooling), lane_sum(s.shrinking));
    let per_weight = 1.0 / max(s.weight, 1e-12);
    s.nearest = lane_nearest(s.nearest);
    s.nearest_of_all = lane_nearest(s.nearest_of_all);
    s.larger = lane_max(s.larger);
    s.velocity *= per_weight;
    s.crowded *= per_weight;
    // Less what particles hold of its own gas, by their weights.
    let own_gas = (1.0 - share) * bubble_volume(bubble.radius) / VOLUME * lane_sum(own_share) * per_weight * per_weight;
    s.crowd = max(lane_sum(s.crowd) * per_weight - own_gas, 0.0);
    s.temperature = thermal.x * per_weight;
    s.acid = thermal.y * per_weight;
    s.superheat = excess.x / max(s.contact, 1e-12);
    s.subcooling = lack.x / max(s.contact, 1e-12);
    s.growing = excess.y / max(excess.x, 1e-12);
    s.shrinking = lack.y / max(lack.x, 1e-12);
    return s;
}

/// How fast the share of a bubble that is a cavity follows the crowd, in a step.
const FOLLOWS: f32 = 0.3;
/// Most of it in a step: until the next one, particles hold what has become a cavity too.
const MOST_FOLLOWED: f32 = 0.2;
/// What is added to the share that is none yet: without it, a bubble that is a cavity altogether would stay one. Chosen.
const STILL_FOLLOWS: f32 = 0.05;

/// Share of a bubble that is a cavity: as it is wider than particles resolve, and what of it they cannot hold.
fn cavity_of(bubble: Bubble, s: Surrounding) -> f32 {
    let crowd = FOLLOWS * (s.crowded - 1.0) * (1.0 - bubble.cavity + STILL_FOLLOWS);
    return clamp(bubble.cavity + clamp(crowd, -MOST_FOLLOWED, MOST_FOLLOWED), cavity_share(bubble.radius), 1.0);
}
