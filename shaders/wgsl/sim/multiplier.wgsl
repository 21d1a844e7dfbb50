// Line 19, first half: density at x* (Eq. 1), the constraint (Eq. 2) and the
// Lagrange multiplier λ.
//
// The inequality of Eq. 2 is kept by the accumulated multiplier (λ ≤ 0), not
// by each iteration's own: an iteration may take back what an earlier one
// pushed too far, which plain PBF's max(C, 0) cannot. The sum of squared
// gradients is that of a full neighbourhood, a constant: the surface is
// under-relaxed, and needs no ε.
//
// Where density follows composition, Σ V_j W is the share of space that is
// filled, and the multiplier is −p/ρ0·Δt² of every particle, whatever its own
// density: that of a neighbour of another liquid is its equal.
//!include common/chemistry/bulk.wgsl
//!include common/chemistry/cavity.wgsl
//!include common/chemistry/features.wgsl
//!include common/glass/boundary.wgsl
//!include common/liquid/awake.wgsl
//!include common/liquid/kernel.wgsl
//!include common/liquid/list_args.wgsl
//!include common/liquid/listed.wgsl
//!include common/liquid/particle.wgsl
//!include common/liquid/step.wgsl
//!include common/liquid/trial.wgsl
//!include common/liquid/velocity.wgsl

/// Whether this is a substep's first iteration: the rebuild's dispatch sizes return to zero, and what the walls were before
/// is found.
override FIRST: bool = false;
/// Whether multipliers are carried from one substep to the next.
override CARRY: bool = false;

/// Most that what is mirrored adds: a lone particle at a wall lacks 0.18 of a full density.
const MOST_MIRRORED: f32 = 0.1;

@group(0) @binding(0) var<storage, read> trial: array<vec4<f32>>;
/// (membership, identity)
@group(0) @binding(1) var<storage, read> tags: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> list_counts: array<u32>;
@group(0) @binding(3) var<storage, read> list: array<vec4<u32>>;
@group(0) @binding(4) var<storage, read> velocity: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read_write> multiplier: array<f32>;
@group(0) @binding(6) var<storage, read_write> solved: array<vec4<f32>>;
/// At x*.
@group(0) @binding(7) var<storage, read_write> boundary: array<vec4<f32>>;
@group(0) @binding(8) var<storage, read_write> list_args: array<u32>;
/// At the substep's start.
@group(0) @binding(9) var<storage, read> position: array<vec4<f32>>;
/// V there.
@group(0) @binding(10) var<storage, read_write> wall_before: array<f32>;
@group(0) @binding(11) var<storage, read> bulk: array<vec4<f32>>;
/// Volumes over V0, where they differ, for the displacements: theirs are records of x* and dλ.
@group(0) @binding(12) var<storage, read_write> volumes: array<f32>;
@group(0) @binding(53) var<storage, read> cavities: array<vec4<i32>>;

/// Line 19: Σ V_j W over the neighbours, over its value at rest density but for the kernel's scale.
fn sum_weights(i: u32, lane: u32, x: vec3<f32>) -> f32 {
    var sum = 0.0;
    let listed = listed_of(i);
    for (var g = lane; g * 4u < listed.count; g += LANES) {
        let four = list[listed.first + g * listed.stride];
        for (var n = 0u; n < 4u; n++) {
            let j = four[n];
            let other = trial[j];
            let offset = x - other.xyz;
            let weight = volume_in(other) * spline(sqrt(dot(offset, offset)) * INVERSE_SUPPORT);
            // What fills up the last four is the particle itself.
            sum += select(weight, 0.0, j == i);
        }
    }
    return lane_sum(sum);
}

/// Line 19, Eqs 1 and 2: C = ρ/ρ0 − 1 of a particle at x*. What is mirrored in a wall comes as fast as the particle goes
/// there, so that the wall's part changes twice as much in a substep as the map's: then what the mirror pushes with is
/// the gradient of this, and does no work on what rests. Up to a bound: a lone drop that flies at a wall has no liquid
/// around it to be mirrored.
fn density_constraint(sum: f32, volume: f32, wall: f32, before: f32) -> f32 {
    let mirrored = clamp(wall - before, -MOST_MIRRORED, MOST_MIRRORED);
    return (sum + volume * spline(0.0)) * weight_scale() + wall + mirrored - 1.0;
}

/// Line 19: V of the walls at the substep's start; of boundary particles, which do not mirror, that at x*.
fn walls_before(i: u32, lane: u32, membership: u32, wall: f32) -> f32 {
    if (SOLIDS) { return wall; }
    if (!FIRST) { return wall_before[i]; }
    let before = wall_volume(boundary_volume(membership, position[i].xyz, step.before, lane));
    if (lane == 0u) { wall_before[i] = before; }
    return before;
}

/// Share of liquid up to which particles in a cavity are drops: a little less than that at a level surface. With that itself a bubble of
/// 7 mm rose 1.15 times as fast as it should, with this 1.11 times.
const MOST_ALONE: f32 = 0.45;

/// Line 19: how much of its multiplier's change a particle takes that gas has swollen, or that is light: the sum of its gradients grows with its
/// volume and with its lightness, and so would what an iteration overshoots.
fn stiffness_of(i: u32) -> f32 {
    if (!BUBBLES) { return 1.0; }
    let extent = unpack_bulk(bulk[i]);
    return 1.0 / max(extent.volume * extent.lightness, 1.0);
}

/// Line 19: λ after this iteration, for C at x*, and its change.
fn update_multiplier(i: u32, x: vec3<f32>, constraint: f32) {
    var before = 0.0;
    var momentum = 0.0;
    if (FIRST) {
        if (CARRY) { before = carried_multiplier(velocity[i], step.time); }
    } else {
        before = multiplier[i];
        momentum = step.momentum * change_in(solved[i]);
    }
    let after = min(before - step.residual * stiffness_of(i) * constraint + momentum, 0.0);
    multiplier[i] = after;
    solved[i] = pack_solved(x, after - before);
}

@compute @workgroup_size(GROUP)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x / LANES;
    let lane = id.x % LANES;
    if (FIRST) {
        if (id.x == 0u) {
            list_args[PARTICLE_ARGS] = 0u;
            list_args[CELL_ARGS] = 0u;
            list_args[LIST_ARGS] = 0u;
        }
    }
    if (i >= awake_count()) { return; }
    let own = trial[i];
    let x = own.xyz;
    let sum = sum_weights(i, lane, x);
    let membership = tags[i].x;
    let wall = boundary_volume(membership, x, step.after, lane);
    let before = walls_before(i, lane, membership, wall_volume(wall));
    if (lane != 0u) { return; }
    if (FIRST && DENSITY) { volumes[i] = volume_in(own); }
    if (membership == REMOVED) {
        solved[i] = pack_solved(x, 0.0);
        boundary[i] = vec4<f32>(0.0);
        multiplier[i] = 0.0;
        return;
    }
    boundary[i] = wall;
    var constraint = density_constraint(sum, volume_in(own), wall_volume(wall), before);
    if (BUBBLES) {
        // No more than wall and liquid leave: gas does not push a few drops that are alone in it.
        let liquid = min((sum + volume_in(own) * spline(0.0)) * weight_scale(), MOST_ALONE);
        constraint += min(cavity_volume(cavities[i], x - position[i].xyz), max(1.0 - wall_volume(wall) - liquid, 0.0));
    }
    update_multiplier(i, x, constraint);
}
