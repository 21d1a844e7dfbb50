// Line 19, second half, and line 20: Δx from the multipliers' changes, and x*. In
// the last iteration lines 23 to 25 too: flask constraint, velocity, position.
//
// A wall is a mirror (common/glass/mirror.wgsl): it bears the particle's own pressure, and what stands behind it has
// the pressure gradient along it that the particle has.
//!include common/chemistry/bulk.wgsl
//!include common/chemistry/cavity.wgsl
//!include common/chemistry/features.wgsl
//!include common/chemistry/heat.wgsl
//!include common/glass/boundary.wgsl
//!include common/glass/constraint.wgsl
//!include common/glass/mirror.wgsl
//!include common/glass/wall.wgsl
//!include common/liquid/awake.wgsl
//!include common/liquid/counters.wgsl
//!include common/liquid/kernel.wgsl
//!include common/liquid/listed.wgsl
//!include common/liquid/list_reach.wgsl
//!include common/liquid/max_speed.wgsl
//!include common/liquid/particle.wgsl
//!include common/liquid/position.wgsl
//!include common/liquid/step.wgsl
//!include common/liquid/trial.wgsl
//!include common/liquid/velocity.wgsl

/// Whether this is a substep's last iteration, which lines 22 to 25 follow.
override COMMIT: bool = false;
/// Whether multipliers are carried from one substep to the next.
override CARRY: bool = false;
/// Whether this pass, the first of its substep, displaces by what was carried. Then `solved` is `trial` as it was predicted, and `trial`
/// is other memory, as the neighbours read the prediction. A pass of multipliers before it would sum over no neighbours.
override APPLY_CARRIED: bool = false;
/// What of σ·sin θ holds a surface's line (`sim/interface.wgsl`); 0 without surface tension.
override HYSTERESIS: f32 = 0.0;

@group(0) @binding(0) var<storage, read> solved: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> boundary: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> list_counts: array<u32>;
@group(0) @binding(3) var<storage, read> list: array<vec4<u32>>;
@group(0) @binding(4) var<storage, read_write> trial: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read_write> wall_push: array<vec4<f32>>;
@group(0) @binding(6) var<storage, read> multiplier: array<f32>;
@group(0) @binding(7) var<storage, read> velocity: array<vec4<f32>>;
@group(0) @binding(8) var<storage, read_write> position: array<vec4<f32>>;
/// (membership, identity)
@group(0) @binding(9) var<storage, read_write> tags: array<vec2<u32>>;
@group(0) @binding(10) var<storage, read_write> new_velocity: array<vec4<f32>>;
@group(0) @binding(11) var<storage, read> list_origin: array<vec4<f32>>;
@group(0) @binding(12) var<storage, read_write> counters: Counters;
@group(0) @binding(13) var<storage, read_write> heat: array<vec4<f32>>;
@group(0) @binding(14) var<storage, read_write> bulk: array<vec4<f32>>;
@group(0) @binding(15) var<storage, read_write> eddies: array<vec2<f32>>;
/// Over V0, as the first iteration's multipliers had them.
@group(0) @binding(16) var<storage, read> volumes: array<f32>;
@group(0) @binding(53) var<storage, read_write> cavities: array<vec4<i32>>;
/// Σ B at x*, for the bubbles.
@group(0) @binding(54) var<storage, read_write> hollow: array<f32>;
/// By identity: what walls hold the line of a surface with (`sim/tension.wgsl`).
@group(0) @binding(50) var<storage, read> held: array<vec4<f32>>;

/// dλ of particle j, m², of which `record` is what `solved` has.
fn change_of(j: u32, record: vec4<f32>) -> f32 {
    if (APPLY_CARRIED) { return carried_multiplier(velocity[j], step.time); }
    return change_in(record);
}

/// Volume of particle j over V0, of which `record` is what `solved` has.
fn volume_of(j: u32, record: vec4<f32>) -> f32 {
    if (APPLY_CARRIED) { return volume_in(record); }
    return volumes[j];
}

/// The record `boundary` of a particle at x*; for lane 0, but all lanes must ask.
fn walls_of(i: u32, lane: u32, x_star: vec3<f32>) -> vec4<f32> {
    if (APPLY_CARRIED) { return boundary_volume(tags[i].x, x_star, step.after, lane); }
    return boundary[i];
}

/// Line 19: Σ (dλ_i + dλ_j) ∇W over the neighbours, but for the kernel's scale.
fn sum_gradients(i: u32, lane: u32, own: vec4<f32>) -> vec3<f32> {
    let change = change_of(i, own);
    var sum = vec3<f32>(0.0);
    let listed = listed_of(i);
    for (var g = lane; g * 4u < listed.count; g += LANES) {
        let four = list[listed.first + g * listed.stride];
        for (var n = 0u; n < 4u; n++) {
            let j = four[n];
            let other = solved[j];
            let offset = own.xyz - other.xyz;
            let square = max(dot(offset, offset), 1e-12 * SUPPORT * SUPPORT);
            let per_distance = inverseSqrt(square);
            var slope = per_distance * spline_slope(square * per_distance * INVERSE_SUPPORT);
            if (DENSITY) { slope *= volume_of(j, other); }
            sum += offset * ((change + change_of(j, other)) * slope);
        }
    }
    return lane_sum3(sum);
}

/// Δx, m, by what gives it.
struct Displacement {
    neighbours: vec3<f32>,
    wall: vec3<f32>,
}

/// Line 19: Δx by the constraints' gradients at a particle; `sum` is that of its neighbours, `walls` its record `boundary`.
fn displacement(i: u32, own: vec4<f32>, sum: vec3<f32>, walls: vec4<f32>) -> Displacement {
    let change = change_of(i, own);
    var by_liquid = sum * (weight_scale() / SUPPORT);
    // As across a wall, a cavity has the particle's own pressure.
    if (BUBBLES) { by_liquid += 2.0 * change * cavity_gradient(cavities[i]); }
    var delta = Displacement(by_liquid, by_walls(by_liquid, change, walls));
    if (DENSITY) {
        // The same pressure moves what is light further: water rises in acid.
        let lightness = unpack_bulk(bulk[i]).lightness;
        delta.neighbours *= lightness;
        delta.wall *= lightness;
    }
    return delta;
}

/// Line 20: x* + ωΔx; ω lies in the multipliers already (`Relaxation`).
fn displace(i: u32, x_star: vec3<f32>, delta: Displacement) -> vec3<f32> {
    if (LOADS) { wall_push[i] += pushed(delta.wall); }
    return x_star + delta.neighbours + delta.wall;
}

/// x* no further from where the list was built than it serves.
fn within_list(i: u32, x_star: vec3<f32>) -> vec3<f32> {
    var to = x_star;
    let strayed = to - list_origin[i].xyz;
    let distance = length(strayed);
    if (distance > LIST_REACH) {
        to = list_origin[i].xyz + strayed * (LIST_REACH / distance);
        atomicAdd(&counters.list_limited, 1u);
    }
    return to;
}

/// x* no further from x than v_max goes in a substep: line 24 bounds the velocity alone, and line 25 would still tunnel.
fn within_speed(x: vec3<f32>, x_star: vec3<f32>) -> vec3<f32> {
    let way = x_star - x;
    let distance = length(way);
    let farthest = MAX_SPEED * step.time;
    var to = x_star;
    if (distance > farthest) { to = x + way * (farthest / distance); }
    return to;
}

/// How far a wall holds back a particle that went from `x` to `to`, across the surface's line: all the way, if that
/// takes no more than it has. The position is held, and with it the velocity: held by its velocity alone, a drop on a slope would creep
/// by Δt²·g in each substep.
fn held_back(identity: u32, x: vec3<f32>, to: vec3<f32>) -> vec3<f32> {
    let hold = held[identity];
    let strength = length(hold.xyz);
    if (strength == 0.0) { return vec3<f32>(0.0); }
    var carried_along = x;
    let flask = u32(hold.w);
    if (flask > 0u) {
        let local = flask_from_stage(poses[step.before + flask - 1u], x);
        carried_along = stage_from_flask(poses[step.after + flask - 1u], local);
    }
    let across = hold.xyz / strength;
    let most = strength * step.time * step.time;
    return -clamp(dot(to - carried_along, across), -most, most) * across;
}

/// Greatest speed away from a cavity that its shift leaves a particle, m/s, if it had no more before. What appears over a particle shifts it
/// by up to h in a substep; with h/Δt, 4 to 5 m/s, it would be thrown. Chosen: with it presets differ less in what hot acid boils and throws.
const MOST_PUSHED: f32 = 0.45;

/// Velocity `v` of particle i less what a cavity's shift `push` (m) gave it beyond that.
fn less_pushed(i: u32, v: vec3<f32>, push: vec3<f32>) -> vec3<f32> {
    let way = length(push);
    if (way == 0.0) { return v; }
    let away = push / way;
    let excess = dot(v, away) - max(dot(velocity[i].xyz, away), MOST_PUSHED);
    return v - away * clamp(excess, 0.0, way / step.time);
}

/// Takes a particle out that turned non-finite. Its neighbours still have it on their lists.
fn take_out(i: u32, identity: u32) {
    if (HEAT) { heat[i] = vec4<f32>(0.0); }
    if (PHYSICAL) {
        eddies[i] = vec2<f32>(0.0);
        bulk[i] = pack_bulk(Bulk(1.0, 1.0, 0.0, 0.0));
    }
    tags[i].x = REMOVED;
    position[i] = pack_taken_out(parked(identity));
    new_velocity[i] = vec4<f32>(0.0);
    atomicAdd(&counters.removed, 1u);
}

/// Lines 22 to 25 of a particle whose numbers are finite; `push` is what cavities shifted it by in this substep, m.
fn commit(i: u32, tag: vec2<u32>, x_star: vec3<f32>, multiplied: f32, push: vec3<f32>) {
    let x = position[i].xyz;
    var lines = vec3<f32>(0.0);
    if (HYSTERESIS > 0.0) {
        lines = held_back(tag.y, x, x_star);
        if (LOADS) { wall_push[i] += vec4<f32>(lines, 0.0); }
    }
    let free = x_star + lines;
    let near = within_speed(x, free);
    let is_cut = any(near != free);
    if (is_cut) { atomicAdd(&counters.speed_limited, 1u); }
    let to = within_list(i, near);
    let allowed = constrain(tag.x, x, to, step.before, step.after); // 23
    if (allowed.generated) {
        atomicAdd(&counters.flask_constraints, 1u);
        if (LOADS) { wall_push[i] += pushed(allowed.position - to); }
    }
    // The position stays where the flask has it: cut back with the
    // velocity (line 24 alone), it would be left behind in the glass.
    var v = (allowed.position - x) / step.time; // 24
    if (BUBBLES) { v = less_pushed(i, v, push); }
    if (is_cut) { v = bounded_speed(v); } else { v = clamp_speed(v); }
    var carried = 0.0;
    if (CARRY) {
        carried = carried_by(velocity[i]);
        carried += step.carry * (multiplied / (step.time * step.time) - carried);
    }
    var vapour = 0.0;
    if (PHYSICAL) { vapour = unpack_bulk(bulk[i]).vapour; }
    position[i] = pack_position(allowed.position, vapour); // 25
    tags[i].x = allowed.membership;
    new_velocity[i] = pack_velocity(v, carried);
}

@compute @workgroup_size(GROUP)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x / LANES;
    let lane = id.x % LANES;
    if (i >= awake_count()) { return; }
    let own = solved[i];
    let sum = sum_gradients(i, lane, own); // 19
    let walls = walls_of(i, lane, own.xyz);
    if (lane != 0u) { return; }
    let x_star = displace(i, own.xyz, displacement(i, own, sum, walls)); // 19 and 20
    if (!COMMIT) {
        var volume = 1.0;
        if (DENSITY) { volume = volume_of(i, own); }
        trial[i] = pack_trial(x_star, volume);
        return;
    }
    let tag = tags[i];
    let multiplied = multiplier[i];
    var push = vec3<f32>(0.0);
    if (BUBBLES) {
        push = 2.0 * multiplied * cavity_gradient(cavities[i]);
        if (DENSITY) { push *= unpack_bulk(bulk[i]).lightness; }
        hollow[i] = cavity_volume(cavities[i], x_star - position[i].xyz);
        cavities[i] = vec4<i32>(0);
    }
    var finite = is_finite(x_star) && is_finite(vec3<f32>(multiplied));
    if (HEAT) { finite = finite && is_finite(tested_in(heat[i])); }
    if (tag.x == REMOVED) {
        new_velocity[i] = vec4<f32>(0.0);
    } else if (!finite) {
        take_out(i, tag.y);
    } else {
        commit(i, tag, x_star, multiplied, push);
    }
}
