// Line 26, first half: heat and acid diffuse (Eq. 5) from the values before
// this substep to those after it; line 27's coefficient (Eq. 17) follows from
// the temperature that comes of it. The second half, the heat of solution,
// needs the neighbours' changes, and waits for the pass of line 27.
//!include common/liquid/particle.wgsl
//!include common/liquid/kernel.wgsl
//!include common/liquid/step.wgsl
//!include common/liquid/counters.wgsl
//!include common/chemistry/pair_share.wgsl
//!include common/chemistry/thomsen.wgsl
//!include common/chemistry/boiling.wgsl
//!include common/maths/compensated.wgsl
//!include common/liquid/full_list.wgsl

/// Whether heat and acid diffuse; else this pass has no neighbours.
override DILUTION: bool = false;
override BOILING: bool = false;
/// D_T and D_c, m²/s.
override HEAT_DIFFUSION: f32 = 0.0;
override ACID_DIFFUSION: f32 = 0.0;
/// T_a of the walls, °C.
override AMBIENT: f32 = 20.0;

@group(0) @binding(0) var<storage, read> position: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> list_counts: array<u32>;
@group(0) @binding(3) var<storage, read> list: array<vec4<u32>>;
/// (∇V, V) of the walls.
@group(0) @binding(4) var<storage, read> boundary: array<vec4<f32>>;
/// (T in °C, c, ½ Σ w|v_ij|² in J/kg, what c lacks)
@group(0) @binding(5) var<storage, read> heat: array<vec4<f32>>;
/// (T, c) after diffusion.
@group(0) @binding(6) var<storage, read_write> diffused: array<vec2<f32>>;
/// (c before, s_i in J/kg, coefficient of Eq. 17, what c after diffusion lacks)
@group(0) @binding(7) var<storage, read_write> mixing: array<vec4<f32>>;
@group(0) @binding(8) var<storage, read_write> counters: Counters;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x / LANES;
    let lane = id.x % LANES;
    if (i >= COUNT) { return; }
    let own = heat[i];
    var change = vec2<f32>(0.0);
    var limited = 0.0;
    if (DILUTION) {
        let x = position[i].xyz;
        let full = full_from(atomicLoad(&counters.list_overflows));
        let listed = list_counts[i];
        let count = select(listed, 0u, listed >= full);
        for (var g = lane; g * 4u < count; g += LANES) {
            let four = list[g * COUNT + i];
            for (var n = 0u; n < 4u; n++) {
                let j = four[n];
                let offset = x - position[j].xyz;
                let weight = diffusion_weight(sqrt(dot(offset, offset)) * INVERSE_SUPPORT);
                let apart = heat[j].xy - own.xy;
                let share = vec2<f32>(pair_share(step.time * HEAT_DIFFUSION, weight),
                                      pair_share(step.time * ACID_DIFFUSION, weight))
                    * has_whole_list(j, i, full);
                change += apart * share;
                limited += select(0.0, 1.0, max(share.x, share.y) >= 1.0 / f32(LIST_CAPACITY));
            }
        }
        change = vec2<f32>(lane_sum(change.x), lane_sum(change.y));
        limited = lane_sum(limited);
    }
    if (lane != 0u) { return; }
    let acid = compensated(own.y, own.w, change.y);
    var after = vec2<f32>(own.x + change.x, acid.x);
    var slope = 0.0;
    if (DILUTION) {
        after.x += (AMBIENT - after.x) * wall_share(step.time * HEAT_DIFFUSION, boundary[i].w);
        slope = solution_heat_slope(own.y, after.y);
        if (limited > 0.0) { atomicAdd(&counters.diffusion_limited, 1u); }
    }
    var coefficient = CALM;
    if (BOILING) {
        coefficient = stirring(after.x, own.z);
        if (!LITERAL_BOILING && coefficient <= -GROWTH_LIMIT / step.viscosity) {
            atomicAdd(&counters.growth_limited, 1u);
        }
    }
    diffused[i] = after;
    mixing[i] = vec4<f32>(own.y, slope, coefficient, acid.y);
}
