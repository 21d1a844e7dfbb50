// Bubbles that touch one another: which join, and which part. For passes that have `bubble_surroundings.wgsl` and bind `live`.
//!include common/chemistry/bubble_surroundings.wgsl
//!include common/chemistry/live_places.wgsl
//!include common/glass/vessel.wgsl

/// Share of the overlap of two cavities that they leave in a step.
const PARTED: f32 = 0.5;
/// Quantum of the way in which it leaves them, m.
const WAY_QUANTUM: f32 = 1e-8;
/// Share of a vessel's width that a bubble has at most.
const WIDEST_BUBBLE: f32 = 0.5;
/// Radius over h beyond which a bubble divides anywhere: `CAVITY_CELLS` have no room for what is around it.
const MOST_RADIUS: f32 = 7.0;

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
    /// Whether the driver ended the loop over all bubbles.
    is_cut: bool,
}

/// What touches a cavity, of all bubbles: the particle nearest to another may be out of its reach. All lanes must ask.
fn touching_of(bubble: Bubble, around: Around, slot: u32, first: u32, lane: u32) -> Touching {
    var way = vec3<i32>(0);
    var larger = 0u;
    let key = key_of(bubble, slot);
    let count = select(0u, live[count_of_live()], cavity_share(bubble.radius) > 0.0);
    var n = lane;
    for (; n < count; n += LANES) {
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
    return Touching(lane_max(larger), vec3<f32>(sum) * WAY_QUANTUM, n < count);
}

/// Greatest radius of a bubble where one is, m: half of its vessel's.
fn widest_at(bubble: Bubble) -> f32 {
    if (FLASKS == 0u || bubble.membership == NOBODYS) { return MOST_RADIUS * SUPPORT; }
    let k = bubble.membership - 1u;
    let y = flask_from_stage(poses[step.after + k], bubble.position).y;
    let lowest = min(flasks[k].floor + bubble.radius, flasks[k].rim);
    return min(WIDEST_BUBBLE * inner_radius(k, clamp(y, lowest, flasks[k].rim)), MOST_RADIUS * SUPPORT);
}
