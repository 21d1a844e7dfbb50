// Line 19, second half, and line 20: Δx from the multipliers' changes. In the
// last iteration lines 23 to 25 too: flask constraint, velocity, position.
//
// The wall's gradient counts once, not mirrored as in Akinci et al. 2012: the
// single form is the gradient of the constraint, and the mirrored one pumps
// energy into a resting column.
//!include common/liquid/particle.wgsl
//!include common/liquid/kernel.wgsl
//!include common/liquid/step.wgsl
//!include common/glass/vessel.wgsl
//!include common/glass/ground.wgsl
//!include common/glass/constraint.wgsl
//!include common/liquid/counters.wgsl

override COMMIT: bool = false;
override CARRY: bool = false;
override LOADS: bool = false;
/// Whether particles differ in volume and density.
override DENSITY: bool = false;
/// Whether particles have a temperature.
override HEAT: bool = false;
/// Whether the chemistry is the physical one.
override PHYSICAL: bool = false;
/// v_max, m/s.
override MAX_SPEED: f32 = 10.0;
/// Half of the list's margin, metres: a particle that went further might miss neighbours.
override LIST_REACH: f32 = 0.000375;

@group(0) @binding(0) var<storage, read> solved: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> boundary: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> list_counts: array<u32>;
@group(0) @binding(3) var<storage, read> list: array<vec4<u32>>;
/// (x*, volume over V0)
@group(0) @binding(4) var<storage, read_write> trial: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read_write> wall_push: array<vec4<f32>>;
@group(0) @binding(6) var<storage, read> multiplier: array<f32>;
@group(0) @binding(7) var<storage, read> velocity: array<vec4<f32>>;
/// (x, vapour over V0·ρ0; negative for a particle that was taken out)
@group(0) @binding(8) var<storage, read_write> position: array<vec4<f32>>;
@group(0) @binding(9) var<storage, read_write> tags: array<vec2<u32>>;
/// Velocity before viscosity; w holds the carried multiplier, −p/ρ in m²/s².
@group(0) @binding(10) var<storage, read_write> new_velocity: array<vec4<f32>>;
@group(0) @binding(11) var<storage, read> list_origin: array<vec4<f32>>;
@group(0) @binding(12) var<storage, read_write> counters: Counters;
@group(0) @binding(13) var<storage, read_write> heat: array<vec4<f32>>;
/// (volume over V0, ρ0 over density, vapour over V0·ρ0, what c and h lack).
@group(0) @binding(14) var<storage, read> bulk: array<vec4<f32>>;

fn commit(i: u32, x_star: vec3<f32>) {
    let tag = tags[i];
    let x = position[i].xyz;
    if (tag.x == REMOVED) {
        new_velocity[i] = vec4<f32>(0.0);
        return;
    }
    let multiplied = multiplier[i];
    var finite = is_finite(x_star) && is_finite(vec3<f32>(multiplied));
    if (HEAT) { finite = finite && is_finite(heat[i].xyz); }
    if (!finite) {
        // Its neighbours still have it on their lists.
        if (HEAT) { heat[i] = vec4<f32>(0.0); }
        tags[i].x = REMOVED;
        position[i] = vec4<f32>(parked(tag.y), -1.0);
        new_velocity[i] = vec4<f32>(0.0);
        atomicAdd(&counters.removed, 1u);
        return;
    }
    var to = x_star;
    let strayed = to - list_origin[i].xyz;
    let distance = length(strayed);
    if (distance > LIST_REACH) {
        to = list_origin[i].xyz + strayed * (LIST_REACH / distance);
        atomicAdd(&counters.list_limited, 1u);
    }
    let allowed = constrain(tag.x, x, to, step.before, step.after);
    if (allowed.generated) {
        atomicAdd(&counters.flask_constraints, 1u);
        if (LOADS) { wall_push[i] += vec4<f32>(allowed.position - to, 0.0); }
    }
    to = allowed.position;
    var v = (to - x) / step.time;
    let speed = length(v);
    if (speed > MAX_SPEED) {
        // The position stays where the flask has it: cut back with the
        // velocity (line 24 alone), it would be left behind in the glass.
        v *= MAX_SPEED / speed;
        atomicAdd(&counters.speed_limited, 1u);
    }
    var carried = 0.0;
    if (CARRY) {
        carried = velocity[i].w;
        carried += step.carry * (multiplied / (step.time * step.time) - carried);
    }
    var vapour = 0.0;
    if (PHYSICAL) { vapour = bulk[i].z; }
    position[i] = vec4<f32>(to, vapour);
    tags[i].x = allowed.membership;
    new_velocity[i] = vec4<f32>(v, carried);
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x / LANES;
    let lane = id.x % LANES;
    if (i >= COUNT) { return; }
    let own = solved[i];
    var sum = vec3<f32>(0.0);
    let count = list_counts[i];
    for (var g = lane; g * 4u < count; g += LANES) {
        let four = list[g * COUNT + i];
        for (var n = 0u; n < 4u; n++) {
            let j = four[n];
            let other = solved[j];
            let offset = own.xyz - other.xyz;
            let square = max(dot(offset, offset), 1e-12 * SUPPORT * SUPPORT);
            let per_distance = inverseSqrt(square);
            var slope = per_distance * spline_slope(square * per_distance * INVERSE_SUPPORT);
            if (DENSITY) { slope *= bulk[j].x; }
            sum += offset * ((own.w + other.w) * slope);
        }
    }
    sum = lane_sum3(sum);
    if (lane != 0u) { return; }
    var wall = own.w * boundary[i].xyz;
    var pressed = sum * (weight_scale() / SUPPORT);
    if (DENSITY) {
        // The same pressure moves what is light further: water rises in acid.
        wall *= bulk[i].y;
        pressed *= bulk[i].y;
    }
    let x_star = own.xyz + pressed + wall;
    if (LOADS) { wall_push[i] += vec4<f32>(wall, 0.0); }
    if (COMMIT) {
        commit(i, x_star);
    } else {
        var volume = 1.0;
        if (DENSITY) { volume = bulk[i].x; }
        trial[i] = vec4<f32>(x_star, volume);
    }
}
