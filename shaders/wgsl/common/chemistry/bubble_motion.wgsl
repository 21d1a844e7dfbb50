// How a bubble moves, by the liquid around it, and keeps off glass; and the liquid that a cavity drags along. For passes that have
// `bubble_surroundings.wgsl`, `bulk` and `throwing.wgsl`'s bindings.
//!include common/chemistry/bubble_surroundings.wgsl
//!include common/glass/boundary.wgsl
//!include common/liquid/step.wgsl

/// Share of space that glass leaves around a bubble at least, as far as it counts.
const LEAST_BESIDE_GLASS: f32 = 0.3;
/// Share of solid space around a bubble from which on glass holds it back.
const AT_GLASS: f32 = 0.2;
/// Most acceleration of the liquid around a bubble that its velocity is changed by, over gravity's: more is noise. Without weight
/// there is none.
const MOST_ACCELERATION: f32 = 1.0;
/// Step of the differences by which the way from glass is found, m.
const GAP_STEP: f32 = 2e-4;
/// Where fewer neighbours than this are above, over a full neighbourhood's, a cavity is at the surface: with more, those inside of a
/// swarm would count as at its surface.
const CAVITY_COVERED: f32 = 0.35;

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
    for (var n = lane; n < count_around(cells); n += LANES) {
        let run = cell_within(wake, reach, cells, n);
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
    return cover / max(1.0 - wall_volume(wall), LEAST_BESIDE_GLASS) + 2.0 * wall_volume(wall) * above;
}
