// Line 26 of the paper's chemistry, first half: heat and acid diffuse (Eq. 5) from the values before this
// substep to those after it; line 27's coefficient (Eq. 17) follows from the temperature that comes of it. The
// second half, the heat of solution, needs the neighbours' changes, and waits for the pass of lines 27 and 28.
//!include common/chemistry/boiling.wgsl
//!include common/chemistry/compensated.wgsl
//!include common/chemistry/features.wgsl
//!include common/chemistry/heat.wgsl
//!include common/chemistry/mixing.wgsl
//!include common/chemistry/pair_share.wgsl
//!include common/chemistry/thomsen.wgsl
//!include common/glass/wall.wgsl
//!include common/liquid/awake.wgsl
//!include common/liquid/counters.wgsl
//!include common/liquid/full_list.wgsl
//!include common/liquid/kernel.wgsl
//!include common/liquid/listed.wgsl
//!include common/liquid/particle.wgsl
//!include common/liquid/step.wgsl

/// D_T and D_c, m²/s.
override HEAT_DIFFUSION: f32 = 0.0;
override ACID_DIFFUSION: f32 = 0.0;
/// T_a of the walls, °C.
override AMBIENT: f32 = 20.0;

@group(0) @binding(0) var<storage, read> position: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> list_counts: array<u32>;
@group(0) @binding(3) var<storage, read> list: array<vec4<u32>>;
@group(0) @binding(4) var<storage, read> boundary: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read> heat: array<vec4<f32>>;
/// (T, c) after diffusion.
@group(0) @binding(6) var<storage, read_write> diffused: array<vec2<f32>>;
@group(0) @binding(7) var<storage, read_write> mixing: array<vec4<f32>>;
@group(0) @binding(8) var<storage, read_write> counters: Counters;

/// What diffusion brings a particle.
struct Diffusion {
    /// Of T (°C) and of c.
    temperature: f32,
    acid: f32,
    /// Pairs that were cut short.
    limited: f32,
}

/// Line 26, Eq. 5; for lane 0, but all lanes must ask.
fn diffuse(i: u32, lane: u32, own: PaperHeat) -> Diffusion {
    var sum: Diffusion;
    let x = position[i].xyz;
    let full = full_from(atomicLoad(&counters.list_overflows));
    let listed = listed_of(i);
    let count = select(listed.count, 0u, list_counts[i] >= full);
    for (var g = lane; g * 4u < count; g += LANES) {
        let four = list[listed.first + g * listed.stride];
        for (var n = 0u; n < 4u; n++) {
            let j = four[n];
            let offset = x - position[j].xyz;
            let weight = diffusion_weight(sqrt(dot(offset, offset)) * INVERSE_SUPPORT);
            let whole = has_whole_list(j, i, full);
            let heat_share = pair_share(step.time * HEAT_DIFFUSION, weight) * whole;
            let acid_share = pair_share(step.time * ACID_DIFFUSION, weight) * whole;
            let other = heat[j];
            sum.temperature += (temperature_in(other) - own.temperature) * heat_share;
            sum.acid += (acid_in(other) - own.acid) * acid_share;
            sum.limited += select(0.0, 1.0, max(heat_share, acid_share) >= 1.0 / f32(LIST_CAPACITY));
        }
    }
    return Diffusion(lane_sum(sum.temperature), lane_sum(sum.acid), lane_sum(sum.limited));
}

@compute @workgroup_size(GROUP)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x / LANES;
    let lane = id.x % LANES;
    if (i >= awake_count()) { return; }
    let own = unpack_paper_heat(heat[i]);
    var diffusion: Diffusion;
    if (DILUTION) { diffusion = diffuse(i, lane, own); }
    if (lane != 0u) { return; }
    let acid = compensated(Compensated(own.acid, own.acid_lacking), diffusion.acid);
    var temperature = own.temperature + diffusion.temperature;
    var mixed: Mixing;
    mixed.acid_before = own.acid;
    mixed.acid_lacking = acid.lacking;
    mixed.coefficient = CALM;
    if (DILUTION) {
        let share = wall_share(step.time * HEAT_DIFFUSION, wall_volume(boundary[i]));
        temperature += (AMBIENT - temperature) * share;
        mixed.heat_slope = solution_heat_slope(own.acid, acid.value);
        if (diffusion.limited > 0.0) { atomicAdd(&counters.diffusion_limited, 1u); }
    }
    if (BOILING) {
        mixed.coefficient = stirring(temperature, own.agitation);
        if (!LITERAL_BOILING && mixed.coefficient <= -GROWTH_LIMIT / step.viscosity) {
            atomicAdd(&counters.growth_limited, 1u);
        }
    }
    diffused[i] = vec2<f32>(temperature, acid.value);
    mixing[i] = pack_mixing(mixed);
}
