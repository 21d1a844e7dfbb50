// Line 19, first half: density at x* (Eq. 1), the constraint (Eq. 2) and this
// iteration's change of the Lagrange multiplier.
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
//!include common/liquid/particle.wgsl
//!include common/liquid/kernel.wgsl
//!include common/liquid/step.wgsl
//!include common/glass/boundary.wgsl

/// Whether this is a substep's first iteration.
override FIRST: bool = false;
/// Whether multipliers are carried from one substep to the next.
override CARRY: bool = false;
/// Whether this pass only applies what was carried.
override APPLY_CARRIED: bool = false;
/// Whether the rebuild's dispatch sizes return to zero here.
override CLEAR_LIST_ARGS: bool = false;

/// (x*, volume over V0)
@group(0) @binding(0) var<storage, read> trial: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> tags: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> list_counts: array<u32>;
@group(0) @binding(3) var<storage, read> list: array<vec4<u32>>;
@group(0) @binding(4) var<storage, read> velocity: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read_write> multiplier: array<f32>;
/// (x*, this iteration's dλ)
@group(0) @binding(6) var<storage, read_write> solved: array<vec4<f32>>;
/// (∇V, V) of the walls at x*.
@group(0) @binding(7) var<storage, read_write> boundary: array<vec4<f32>>;
@group(0) @binding(8) var<storage, read_write> list_args: array<u32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x / LANES;
    let lane = id.x % LANES;
    if (CLEAR_LIST_ARGS) {
        if (id.x == 0u) {
            list_args[0] = 0u;
            list_args[4] = 0u;
            list_args[8] = 0u;
            list_args[12] = 0u;
        }
    }
    if (i >= COUNT) { return; }
    let own = trial[i];
    let x = own.xyz;
    var sum = 0.0;
    if (!APPLY_CARRIED) {
        let count = list_counts[i];
        for (var g = lane; g * 4u < count; g += LANES) {
            let four = list[g * COUNT + i];
            for (var n = 0u; n < 4u; n++) {
                let j = four[n];
                let other = trial[j];
                let offset = x - other.xyz;
                let weight = other.w * spline(sqrt(dot(offset, offset)) * INVERSE_SUPPORT);
                // What fills up the last four is the particle itself.
                sum += select(weight, 0.0, j == i);
            }
        }
        sum = lane_sum(sum);
    }
    let tag = tags[i].x;
    let wall = boundary_volume(tag, x, step.after, lane);
    if (lane != 0u) { return; }
    if (tag == REMOVED) {
        solved[i] = vec4<f32>(x, 0.0);
        boundary[i] = vec4<f32>(0.0);
        multiplier[i] = 0.0;
        return;
    }
    boundary[i] = wall;
    if (APPLY_CARRIED) {
        let carried = velocity[i].w * step.time * step.time;
        multiplier[i] = carried;
        solved[i] = vec4<f32>(x, carried);
        return;
    }
    let constraint = (sum + own.w * spline(0.0)) * weight_scale() + wall.w - 1.0;
    var before = 0.0;
    var momentum = 0.0;
    if (FIRST) {
        if (CARRY) { before = multiplier[i]; }
    } else {
        before = multiplier[i];
        momentum = step.momentum * solved[i].w;
    }
    let after = min(before - step.residual * constraint + momentum, 0.0);
    multiplier[i] = after;
    solved[i] = vec4<f32>(x, after - before);
}
