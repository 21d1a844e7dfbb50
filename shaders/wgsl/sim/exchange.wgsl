// Line 26 of the physical chemistry: acid and enthalpy between particles, heat
// to what is around, boiling and condensing, and what boiling may spend on
// motion. `chemistry/transport.rs` and `chemistry/physical.rs` are the same in f64.
//!include common/liquid/particle.wgsl
//!include common/liquid/kernel.wgsl
//!include common/liquid/step.wgsl
//!include common/liquid/counters.wgsl
//!include common/chemistry/pair_share.wgsl
//!include common/chemistry/potential.wgsl
//!include common/chemistry/boiling.wgsl
//!include common/maths/compensated.wgsl
//!include common/liquid/full_list.wgsl

override BOILING: bool = false;
override EVAPORATION: bool = false;
override VISCOSITY: bool = false;
/// Whether volume and density follow composition and temperature.
override DENSITY: bool = false;
override LOSSES: bool = false;
/// C_t: diffusivity of the eddies over h·|v_ij|; Le of their mixing.
override MIXING: f32 = 0.0;
override LEWIS: f32 = 1.0;
/// Molecular diffusivities of acid and of heat, m²/s.
override ACID_DIFFUSIVITY: f32 = 0.0;
override THERMAL_DIFFUSIVITY: f32 = 0.0;
/// Time constant of boiling and condensing, s.
override SUPERHEAT_TIME: f32 = 1.0;
/// Speed of bubbles in the liquid, m/s; 0 where they stay with their particle.
override BUBBLE_SPEED: f32 = 0.0;
/// Particle spacing d, m.
override SPACING: f32 = 0.0025;
/// η: share of the vapour's work that becomes motion, times R/M (J/(kg K)).
override AGITATION: f32 = 0.0;
/// Heat transfer to glass and at the surface over ρ0, W m/(kg K); T of what is around, °C.
override GLASS_LOSS: f32 = 0.0;
override SURFACE_LOSS: f32 = 0.0;
override AMBIENT: f32 = 20.0;

/// (x, vapour over V0·ρ0)
@group(0) @binding(0) var<storage, read> position: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> tags: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> list_counts: array<u32>;
@group(0) @binding(3) var<storage, read> list: array<vec4<u32>>;
/// (∇V, V) of the walls.
@group(0) @binding(4) var<storage, read> boundary: array<vec4<f32>>;
/// Potentials, see `common/chemistry/potential.wgsl`.
@group(0) @binding(5) var<storage, read> heat: array<vec4<f32>>;
@group(0) @binding(6) var<storage, read> new_velocity: array<vec4<f32>>;
/// (c, h in J/kg, y, mass over V0·ρ0) of what a particle holds.
@group(0) @binding(7) var<storage, read_write> matter: array<vec4<f32>>;
/// (volume over V0, ρ0 over density, vapour over V0·ρ0, what c and h lack)
@group(0) @binding(12) var<storage, read> bulk: array<vec4<f32>>;
/// (α, XSPH coefficient over the substep's, mass, what c and h lack)
@group(0) @binding(8) var<storage, read_write> mixing: array<vec4<f32>>;
/// By identity: (kinetic energy paid for, heat exchanged, steam's mass and enthalpy), in J and kg
/// per V0·ρ0.
@group(0) @binding(9) var<storage, read_write> ledger: array<vec4<f32>>;
/// By identity: e_i of the substep before, J/kg.
@group(0) @binding(10) var<storage, read> agitation: array<f32>;
@group(0) @binding(11) var<storage, read_write> counters: Counters;

/// What a pair exchanges of acid and of heat per difference, for `rates` = Δt·D (m²), where one
/// particle holds `a` and the other `b`; and how many of the two were cut short. The kernel's part
/// is `diffusion_weight`; with the two harmonic means it needs one division instead of three.
fn conductances(rates: vec2<f32>, q: f32, a: vec2<f32>, b: vec2<f32>) -> vec3<f32> {
    let sums = max(a + b, vec2<f32>(1e-12));
    let inverse = 1.0 / ((q * q + 0.01) * sums.x * sums.y);
    let weight = (4.0 / (SUPPORT * SUPPORT)) * weight_scale() * (-spline_slope(q) * q) * inverse;
    let wanted = rates * (weight * (a * b)) * sums.yx;
    let most = min(a, b) * (1.0 / f32(LIST_CAPACITY));
    let cut = select(vec2<f32>(0.0), vec2<f32>(1.0), wanted > most);
    return vec3<f32>(min(wanted, most), cut.x + cut.y);
}

/// Share of a particle's vapour that rises out of it in a substep, where there is liquid all
/// around.
fn rising() -> f32 {
    return decayed(step.time * BUBBLE_SPEED / SPACING);
}

/// What of it goes to a neighbour `up` (share of the distance that is upwards): by the kernel, over
/// the same for a full neighbourhood, of whose weight W(0) is the particle's own and a quarter of
/// the rest counts as above.
fn towards(up: f32, weight: f32) -> f32 {
    let full = 0.25 * (1.0 - weight_scale() * spline(0.0));
    return max(up, 0.0) * weight * weight_scale() / full;
}

/// Where fewer neighbours than this are above, over a full neighbourhood's, vapour leaves.
const COVERED: f32 = 0.7;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x / LANES;
    let lane = id.x % LANES;
    if (i >= COUNT) { return; }
    let x = position[i].xyz;
    let own = heat[i];
    let own_held = held(own);
    let v = new_velocity[i].xyz;
    // Acid (V0·ρ0), enthalpy (J per V0·ρ0), pairs that were cut short.
    var flux = vec3<f32>(0.0);
    var open = vec3<f32>(0.0);
    // Vapour that came from below, its enthalpy, and what covers this particle.
    var bubbles = vec3<f32>(0.0);
    let full = full_from(atomicLoad(&counters.list_overflows));
    let listed = list_counts[i];
    let count = select(listed, 0u, listed >= full);
    for (var g = lane; g * 4u < count; g += LANES) {
        let four = list[g * COUNT + i];
        for (var n = 0u; n < 4u; n++) {
            let j = four[n];
            let near = position[j];
            let offset = x - near.xyz;
            let square = max(dot(offset, offset), 1e-12 * SUPPORT * SUPPORT);
            let per_distance = inverseSqrt(square);
            let q = square * per_distance * INVERSE_SUPPORT;
            let other = heat[j];
            let whole = has_whole_list(j, i, full);
            let other_held = held(other) * whole;
            let eddies = MIXING * SUPPORT * length(new_velocity[j].xyz - v);
            let rates = step.time * vec2<f32>(ACID_DIFFUSIVITY + eddies, THERMAL_DIFFUSIVITY + LEWIS * eddies);
            let share = conductances(rates, q, own_held, other_held);
            let acid = share.x * (other.y - own.y);
            flux += vec3<f32>(acid, acid * (0.5 * (own.w + other.w)) + share.y * (other.x - own.x), share.z);
            if (LOSSES) { open += offset * (per_distance * spline_slope(q)); }
            if (BUBBLE_SPEED > 0.0) {
                let up = offset.y * per_distance;
                let kernel = spline(q);
                let come = near.w * towards(up, kernel) * whole;
                bubbles += vec3<f32>(come, come * steam_enthalpy(other.x), towards(-up, kernel) * whole);
            }
        }
    }
    flux = lane_sum3(flux);
    if (BUBBLE_SPEED > 0.0) { bubbles = lane_sum3(bubbles) * vec3<f32>(rising(), rising(), 1.0); }
    if (LOSSES) { open = lane_sum3(open) * (weight_scale() / SUPPORT); }
    if (lane != 0u) { return; }
    let tag = tags[i];
    if (tag.x == REMOVED) { return; }
    if (flux.z > 0.0) { atomicAdd(&counters.diffusion_limited, 1u); }

    var content = matter[i];
    var account = ledger[tag.y];
    if (LOSSES) {
        let glass = boundary[i].xyz;
        let rate = 2.0 * (GLASS_LOSS * length(glass) + SURFACE_LOSS * length(glass + open)) / max(own_held.y, 1e-3);
        let gained = (AMBIENT - own.x) * own_held.y * decayed(rate * step.time);
        flux.y += gained;
        account.y += gained;
    }
    let lacking = unpack_rests(bulk[i].w);
    var acid = compensated(content.x, lacking.x, flux.x / content.w);
    var enthalpy = compensated(content.y, lacking.y, flux.y / content.w);

    var budget = 0.0;
    if (BUBBLE_SPEED > 0.0) {
        // Bubbles rise to the particles above, and leave where there are none: only there does
        // their vapour push the liquid out of the air's way.
        let held_vapour = bulk[i].z;
        let specific = steam_enthalpy(own.x);
        let passed = held_vapour * rising() * bubbles.z;
        var gone = held_vapour * rising() * max(1.0 - bubbles.z / COVERED, 0.0);
        // What is above it is not looked for.
        if (listed >= full) { gone = 0.0; }
        let gained = bubbles.x - passed - gone;
        let mass = rounded(content.w + gained);
        // What the rounded mass became, and increments: where none rises, c and h keep their bits.
        let change = mass - content.w;
        acid = compensated(acid.x, acid.y, -acid.x * change / mass);
        let carried = bubbles.y - (passed + gone) * specific;
        enthalpy = compensated(enthalpy.x, enthalpy.y, (carried - enthalpy.x * change) / mass);
        account.z += gone;
        account.w += gone * specific;
        if (BOILING) { budget = AGITATION * (gone / content.w) * (own.x - ABSOLUTE_ZERO); }
        content.z = max((content.z * content.w + gained) / mass, 0.0);
        content.w = mass;
    }
    let bounded = clamp(acid.x, 0.0, 1.0);
    content.x = bounded;
    content.y = enthalpy.x;
    if (EVAPORATION) {
        content.z += (equilibrium(content.x, content.y, content.z) - content.z)
            * (1.0 - exp(-step.time / SUPERHEAT_TIME));
    }
    matter[i] = content;
    ledger[tag.y] = account;
    let rests = pack_rests(acid.x - bounded + acid.y, enthalpy.y);

    var growth = 0.0;
    if (BOILING) { if (budget > 0.0) { growth = bounded_growth(budget, agitation[tag.y]); } }
    if (growth >= GROWTH_LIMIT) { atomicAdd(&counters.growth_limited, 1u); }
    if (DENSITY || VISCOSITY) {
        if (own.x < TABLES_FROM || own.x > TABLES_TO) { atomicAdd(&counters.table_ends, 1u); }
    }
    var coefficient = CALM;
    if (VISCOSITY) {
        let diffusivity = viscosity_of(own.y, own.x) / density_of(own.y, own.x);
        let real = decayed(diffusivity * step.time / (XSPH_MOMENT * SUPPORT * SUPPORT));
        coefficient = (step.viscosity * CALM + real - step.viscosity * CALM * real) / step.viscosity;
    }
    mixing[i] = vec4<f32>(growth, select(coefficient, 0.0, growth > 0.0), content.w, rests);
}
