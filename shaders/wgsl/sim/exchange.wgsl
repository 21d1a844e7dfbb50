// Line 26 of the physical chemistry: acid and enthalpy between particles, heat to what is around, what bubbles and
// drops took and gave, and without bubbles boiling and condensing. `chemistry/transport.rs` and `chemistry/physical.rs`
// are the same in f64, but for bubbles.
//!include common/chemistry/bubbled.wgsl
//!include common/chemistry/bulk.wgsl
//!include common/chemistry/compensated.wgsl
//!include common/chemistry/dew.wgsl
//!include common/chemistry/drops.wgsl
//!include common/chemistry/eddies.wgsl
//!include common/chemistry/evaporation.wgsl
//!include common/chemistry/features.wgsl
//!include common/chemistry/heat.wgsl
//!include common/chemistry/ledger.wgsl
//!include common/chemistry/matter.wgsl
//!include common/chemistry/mixing.wgsl
//!include common/chemistry/rests.wgsl
//!include common/chemistry/segregation.wgsl
//!include common/chemistry/solution.wgsl
//!include common/chemistry/transport.wgsl
//!include common/glass/glass_rings.wgsl
//!include common/glass/vessel.wgsl
//!include common/glass/wall.wgsl
//!include common/liquid/awake.wgsl
//!include common/liquid/counters.wgsl
//!include common/liquid/full_list.wgsl
//!include common/liquid/kernel.wgsl
//!include common/liquid/listed.wgsl
//!include common/liquid/particle.wgsl
//!include common/liquid/step.wgsl
//!include common/liquid/viscosity.wgsl
//!include common/maths/decay.wgsl

/// Time constant of boiling and condensing, s.
override SUPERHEAT_TIME: f32 = 1.0;
/// Particle spacing d, m.
override SPACING: f32 = 0.0025;
/// Heat transfer of drops through what they lie on, and at the surface, over ρ0, W m/(kg K).
override GLASS_LOSS: f32 = 0.0;
override SURFACE_LOSS: f32 = 0.0;
/// Whether steam condenses on glass, of which liquid washes it.
override DEW: bool = false;
/// 1/ρ0, m³/kg.
override SPECIFIC_VOLUME: f32 = 0.001;

@group(0) @binding(0) var<storage, read> position: array<vec4<f32>>;
/// (membership, identity)
@group(0) @binding(1) var<storage, read> tags: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> list_counts: array<u32>;
@group(0) @binding(3) var<storage, read> list: array<vec4<u32>>;
@group(0) @binding(4) var<storage, read> boundary: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read> heat: array<vec4<f32>>;
@group(0) @binding(6) var<storage, read> eddies: array<vec2<f32>>;
@group(0) @binding(7) var<storage, read_write> matter: array<vec4<f32>>;
@group(0) @binding(8) var<storage, read_write> mixing: array<vec4<f32>>;
@group(0) @binding(9) var<storage, read_write> ledger: array<vec4<f32>>;
/// By flask and row of its wall: a bit a place that liquid touched in this frame.
@group(0) @binding(10) var<storage, read_write> wetted: array<atomic<u32>>;
@group(0) @binding(11) var<storage, read_write> counters: Counters;
@group(0) @binding(12) var<storage, read> bulk: array<vec4<f32>>;
/// By flask and ring: T (°C), and quanta of heat that the liquid took in this frame.
@group(0) @binding(13) var<storage, read> glass: array<vec2<f32>>;
@group(0) @binding(14) var<storage, read_write> glass_taken: array<atomic<i32>>;
/// What of its exchange a particle may keep (`sim/turnover.wgsl`).
@group(0) @binding(15) var<storage, read> kept: array<f32>;
/// By identity: what bubbles did to a particle.
@group(0) @binding(16) var<storage, read_write> bubbled: array<vec4<i32>>;
/// By identity: gas of a particle, that which it goes to (V0), the conductance of all bubbles around it (V0·ρ0/(s K)), and
/// the time until another bubble is born at it, s.
@group(0) @binding(17) var<storage, read_write> gas: array<vec4<f32>>;

/// By identity: what drops did to a particle.
@group(0) @binding(19) var<storage, read_write> sprayed: array<vec4<i32>>;

/// What a pair exchanges in a substep.
struct Rates {
    /// Per difference of c and of h: liquid that eddies exchange, with its enthalpy, and acid by itself.
    carried: f32,
    /// Of that, what eddies exchange.
    stirred: f32,
    /// Per difference of T: conducted heat, less what of it the acid's enthalpy has already.
    conducted: f32,
}

/// Those of a pair with eddies of the diffusivity `eddies` (m²/s); `keeps` is cut from all alike, else a cut mixture would leave its
/// line.
fn rates_of(eddies: f32, q: f32, own: Potential, other: Potential, keeps: f32) -> Rates {
    let swapped = keeps * swapped_by(q, own, other, 1.0);
    let brought = ACID_DIFFUSIVITY * swapped.x * (0.5 * (own.capacity + other.capacity));
    return Rates(
        (eddies + ACID_DIFFUSIVITY) * swapped.x, eddies * swapped.x, THERMAL_DIFFUSIVITY * swapped.y - brought);
}

/// What a particle receives from its neighbours, and where they are.
struct Received {
    /// V0·ρ0.
    acid: f32,
    /// J per V0·ρ0.
    enthalpy: f32,
    /// Σ (c − c_i)² of what came less that of what went, V0·ρ0.
    variance: f32,
    /// Σ V∇W: where there is liquid, and by its lack the surface.
    open: vec3<f32>,
}

/// Line 26: what comes from the neighbours. For lane 0, but all lanes must ask. A particle whose list
/// is full exchanges nothing.
fn receive(i: u32, lane: u32, own: Potential, is_full: bool) -> Received {
    let x = position[i].xyz;
    let stirred = unpack_eddies(eddies[i]);
    var variance = 0.0;
    let keeps = kept[i];
    // Acid, enthalpy.
    var flux = vec2<f32>(0.0);
    var open = vec3<f32>(0.0);
    let listed = listed_of(i);
    let count = select(listed.count, 0u, is_full);
    for (var g = lane; g * 4u < count; g += LANES) {
        let four = list[listed.first + g * listed.stride];
        for (var n = 0u; n < 4u; n++) {
            let j = four[n];
            let offset = x - position[j].xyz;
            let square = max(dot(offset, offset), 1e-12 * SUPPORT * SUPPORT);
            let per_distance = inverseSqrt(square);
            let q = square * per_distance * INVERSE_SUPPORT;
            let other = unpack_potential(heat[j]);
            let others = unpack_eddies(eddies[j]);
            let mean = 0.5 * (stirred.diffusivity + others.diffusivity);
            let rates = rates_of(mean, q, own, other, min(keeps, kept[j]));
            let enthalpy = rates.carried * (other.enthalpy - own.enthalpy)
                + rates.conducted * (other.temperature - own.temperature);
            flux += vec2<f32>(rates.carried * (other.acid - own.acid), enthalpy);
            if (SEGREGATION) {
                let apart = other.acid - own.acid;
                variance += rates.stirred * (others.variance - stirred.variance + apart * apart);
            }
            if (LOSSES) {
                var volume = 1.0;
                if (DENSITY) { volume = unpack_bulk(bulk[j]).volume; }
                open += offset * (volume * per_distance * spline_slope(q));
            }
        }
    }
    flux = vec2<f32>(lane_sum(flux.x), lane_sum(flux.y));
    if (SEGREGATION) { variance = lane_sum(variance); }
    if (LOSSES) { open = lane_sum3(open) * (weight_scale() / SUPPORT); }
    return Received(flux.x, flux.y, variance, open);
}

/// Area over d² that disorder makes of a particle inside, and what one at a surface has at least.
const INSIDE: f32 = 0.3;
const SURFACE: f32 = 0.5;

/// Area of the free surface of a particle of that volume (over V0) over 2V0, 1/m: the gradient there, but for
/// that of disorder.
fn surface_of(volume: f32, glass: vec3<f32>, open: vec3<f32>) -> f32 {
    let disorder = length(glass + open);
    // Over d² of its own spacing.
    let area = 2.0 * SPACING * pow(volume, 1.0 / 3.0) * disorder;
    return volume * disorder * smoothstep(INSIDE, SURFACE, area);
}

/// Heat that a particle takes in a substep from what has the temperature `around` (°C), by a transfer over ρ0
/// (W m/(kg K)) and an area over 2V0 (1/m), J per V0·ρ0.
fn heat_from(own: Potential, around: f32, transfer_area: f32) -> f32 {
    let capacity = own.mass * own.capacity;
    let rate = 2.0 * transfer_area / max(capacity, 1e-3);
    return (around - own.temperature) * capacity * decayed(rate * step.time);
}

/// Most quanta of a particle and a substep: 2048 such fit into a ring's sum.
const MOST_QUANTA: f32 = 1048575.0;

/// Washes the dew from the place of flask k's wall that is nearest to `at` (flask's frame).
fn wash(k: u32, at: vec3<f32>) {
    let up = (at.y - flasks[k].floor) / (flasks[k].rim - flasks[k].floor) * f32(DEW_UP);
    let row = k * DEW_UP + u32(clamp(up, 0.0, f32(DEW_UP - 1u)));
    let turn = atan2(at.z, at.x) / 6.2831853;
    let around = u32(clamp((turn - floor(turn)) * f32(DEW_AROUND), 0.0, f32(DEW_AROUND - 1u)));
    let bit = 1u << around;
    // Most have been touched in this frame.
    if ((atomicLoad(&wetted[row]) & bit) == 0u) { atomicOr(&wetted[row], bit); }
}

/// Heat that a particle takes in a substep from the glass of its flask, in whole quanta, as sums of integers
/// do not depend on order; drops elsewhere lose theirs to what is around.
fn heat_from_glass(own: Potential, volume: f32, membership: u32, x: vec3<f32>, gradient: vec3<f32>) -> f32 {
    let slope = length(gradient);
    if (slope <= 0.0) { return 0.0; }
    if (membership == NOBODYS) { return heat_from(own, AMBIENT, GLASS_LOSS * volume * slope); }
    let k = membership - 1u;
    // Where it touches, half a spacing away.
    let at = flask_from_stage(poses[step.after + k], x + gradient * (0.5 * SPACING / slope));
    // What stands on the floor alone touches no wall.
    let aside = at.xz - flask_from_stage(poses[step.after + k], x).xz;
    if (DEW && dot(aside, aside) > 0.0625 * SPACING * SPACING) { wash(k, at); }
    let place = (at.y - flasks[k].floor) / (flasks[k].rim - flasks[k].floor) * f32(GLASS_RINGS);
    let place_of_ring = k * GLASS_RINGS + u32(clamp(place, 0.0, f32(GLASS_RINGS - 1u)));
    let ring = glass_rings[place_of_ring];
    let wanted = heat_from(own, glass[place_of_ring].x, ring.to_liquid * volume * slope);
    let quanta = clamp(round(wanted / ring.quantum_per_mass), -MOST_QUANTA, MOST_QUANTA);
    atomicAdd(&glass_taken[place_of_ring], i32(quanta));
    return quanta * ring.quantum_per_mass;
}

/// Most of a particle's liquid that evaporates in a substep.
const MOST_EVAPORATED: f32 = 0.01;

/// Water that a particle with that variance loses to the air in a substep below its boiling point, V0·ρ0; `surface` is its
/// area over 2V0.
fn evaporated(own: Potential, variance: f32, surface: f32) -> f32 {
    if (surface <= 0.0 || own.temperature <= AMBIENT) { return 0.0; }
    var shown = Shown(own.acid, own.acid, 1.0);
    if (SEGREGATION) { shown = shown_of_lamellae(own.acid, variance, own.temperature); }
    var flux = shown.share * evaporation_flux(row_at(shown.poorest), own.temperature);
    if (shown.share < 1.0) { flux += (1.0 - shown.share) * evaporation_flux(row_at(shown.richest), own.temperature); }
    return min(2.0 * SPECIFIC_VOLUME * surface * flux * step.time, MOST_EVAPORATED * (1.0 - own.acid) * own.mass);
}

/// What line 26 changes of a particle.
struct State {
    content: Content,
    account: Account,
    /// c and h, and what they lack by rounding.
    acid: Compensated,
    enthalpy: Compensated,
    /// s².
    variance: f32,
}

/// Line 26: adds what neighbours and surroundings bring, and takes what evaporates.
fn take_up(before: State, i: u32, membership: u32, volume: f32, own: Potential, received: Received) -> State {
    var state = before;
    var taken = received.enthalpy;
    var gone = 0.0;
    if (LOSSES) {
        let glass = wall_gradient(boundary[i]);
        let surface = surface_of(volume, glass, received.open);
        let gained = heat_from_glass(own, volume, membership, position[i].xyz, glass)
            + heat_from(own, AMBIENT, SURFACE_LOSS * surface);
        taken += gained;
        state.account.heat += gained;
        if (EVAPORATION) { gone = evaporated(own, unpack_eddies(eddies[i]).variance, surface); }
    }
    if (SEGREGATION) { state.variance = segregated(i, own, received); }
    state.acid = compensated(state.acid, received.acid / state.content.mass);
    state.enthalpy = compensated(state.enthalpy, taken / state.content.mass);
    if (gone > 0.0) { state = without_water(state, gone, gone * steam_enthalpy(own.temperature)); }
    return state;
}

/// Line 26: what eddies bring arrives unmixed, and what is unmixed is mixed by eddies and molecules.
fn segregated(i: u32, own: Potential, received: Received) -> f32 {
    let stirred = unpack_eddies(eddies[i]);
    let gained = received.acid / own.mass;
    let brought = received.variance / own.mass - gained * gained;
    let variance = clamp(stirred.variance + brought, 0.0, own.acid * (1.0 - own.acid));
    let left = variance * exp(-decay_rate(own.acid, own.temperature, stirred) * step.time);
    return select(0.0, left, left > MIXED);
}

/// Water vapour that leaves the liquid for good, and its enthalpy; a particle's vapour stays what it is.
fn without_water(before: State, gone: f32, enthalpy: f32) -> State {
    var state = before;
    let mass = rounded(state.content.mass - gone);
    let change = mass - state.content.mass;
    if (SEGREGATION) {
        let acid = liquid_acid(state.acid.value, state.content.vapour);
        let share = -change / (state.content.mass * (1.0 - state.content.vapour));
        let poorest = poorest_of(acid, state.variance);
        state.variance = without_lamellar_water(state.variance, acid, poorest, share);
    }
    state.acid = compensated(state.acid, -state.acid.value * change / mass);
    state.enthalpy = compensated(state.enthalpy, -(enthalpy + state.enthalpy.value * change) / mass);
    state.content.vapour *= state.content.mass / mass;
    state.content.mass = mass;
    state.account.steam += vec2<f32>(-change, enthalpy);
    return state;
}

/// Acid fraction that boiling leaves at most: a little more than the azeotrope's.
const STRONGEST: f32 = 0.99;

/// What a particle keeps at least, V0·ρ0, whatever is asked of it: what it holds is known by its mass, and of no mass it is no number.
const LEAST_MASS: f32 = 0.01;

/// Most that a particle gives away in a substep, V0·ρ0.
fn most_given(wanted: f32, mass: f32) -> f32 {
    return max(min(wanted, mass - LEAST_MASS), 0.0);
}

/// What of a mass that is `asked` for a particle can give if it has `most` to give; what it is given it takes whole. The rest waits.
fn share_of(asked: f32, most: f32) -> f32 {
    return select(1.0, most / max(-asked, 1e-12), -asked > most);
}

fn part_of(quanta: i32, share: f32) -> i32 {
    return select(i32(f32(quanta) * share), quanta, share >= 1.0);
}

/// Line 26: what bubbles took of this particle and gave it. Of the mass what f32 can add is taken over; the rest waits.
fn take_from_bubbles(before: State, identity: u32) -> State {
    let first = BUBBLED_VECTORS * identity;
    let did = bubbled[first];
    var state = before;
    // No water but what there is, whatever bubbles took.
    let water = state.content.mass * (1.0 - clamp(state.acid.value, 0.0, 1.0) / STRONGEST);
    let asked = f32(did.x) * MASS_QUANTUM;
    let share = share_of(asked, most_given(water, state.content.mass));
    let mass = rounded(state.content.mass + share * asked);
    let change = mass - state.content.mass;
    let enthalpy_quanta = part_of(did.y, share);
    let enthalpy = f32(enthalpy_quanta) * ENTHALPY_QUANTUM;
    if (SEGREGATION && change < 0.0) {
        let poorest = poorest_of(state.acid.value, state.variance);
        state.variance = without_lamellar_water(state.variance, state.acid.value, poorest, -change / state.content.mass);
    }
    state.acid = compensated(state.acid, -state.acid.value * change / mass);
    state.enthalpy = compensated(state.enthalpy, (enthalpy - state.enthalpy.value * change) / mass);
    state.content.mass = mass;
    let comes = f32(did.z) * GAS_QUANTUM;
    let before_gas = gas[identity];
    gas[identity] = vec4<f32>(before_gas.x, comes, f32(did.w) * CONDUCTANCE_QUANTUM, before_gas.w);
    bubbled[first] = vec4<i32>(did.x - i32(change / MASS_QUANTUM), did.y - enthalpy_quanta, 0, 0);
    let others = bubbled[first + 1u];
    bubbled[first + 1u] = vec4<i32>(0, others.x, 0, others.z);
    bubbled[first + BUBBLED_LIFTED] = bubbled[first + BUBBLED_LIFTED - 1u];
    bubbled[first + BUBBLED_LIFTED - 1u] = vec4<i32>(0);
    return state;
}

/// Line 26: liquid that went into drops, and that of drops that fell back.
fn take_from_drops(before: State, identity: u32) -> State {
    let did = sprayed[identity];
    var state = before;
    let asked = f32(did.x) * SPRAYED_QUANTUM;
    let share = share_of(asked, most_given(0.5 * state.content.mass, state.content.mass));
    let mass = rounded(state.content.mass + share * asked);
    let change = mass - state.content.mass;
    // No acid and no water but what there is: neighbours may have brought and taken some since drops asked for theirs.
    let held = state.acid.value * state.content.mass;
    let acid = clamp(part_of(did.y, share), i32(-held / SPRAYED_QUANTUM), i32((mass - held) / SPRAYED_QUANTUM));
    state.acid = compensated(state.acid, (f32(acid) * SPRAYED_QUANTUM - state.acid.value * change) / mass);
    let enthalpy_quanta = part_of(did.z, share);
    let enthalpy = f32(enthalpy_quanta) * SPRAYED_ENTHALPY_QUANTUM;
    state.enthalpy = compensated(state.enthalpy, (enthalpy - state.enthalpy.value * change) / mass);
    state.content.mass = mass;
    sprayed[identity] = vec4<i32>(did.x - i32(change / SPRAYED_QUANTUM), did.y - acid, did.z - enthalpy_quanta, 0);
    return state;
}

/// Line 26: a particle's vapour and variance after a substep of boiling or condensing.
fn boiled(content: Content, variance: f32) -> Boiled {
    let share = 1.0 - exp(-step.time / SUPERHEAT_TIME);
    if (SEGREGATION && variance > 0.0) {
        let poorest = poorest_of(liquid_acid(content.acid, content.vapour), variance);
        let wanted = flash(content.acid, content.enthalpy, content.vapour, variance, poorest);
        let vapour = content.vapour + (wanted - content.vapour) * share;
        return boiled_to(content.acid, content.vapour, variance, poorest, vapour);
    }
    let wanted = equilibrium(content.acid, content.enthalpy, content.vapour);
    return Boiled(content.vapour + (wanted - content.vapour) * share, 0.0);
}

/// XSPH coefficient over the substep's with the liquid's own viscosity and its eddies'.
fn coefficient_of(own: Potential, eddies: Eddies) -> f32 {
    var diffusivity = SCHMIDT * eddies.diffusivity;
    if (VISCOSITY) {
        diffusivity += viscosity_of(own.acid, own.temperature) / density_of(own.acid, own.temperature);
    }
    if (diffusivity <= 0.0) { return CALM; }
    let real = decayed(diffusivity * step.time / (XSPH_MOMENT * SUPPORT * SUPPORT));
    return (step.viscosity * CALM + real - step.viscosity * CALM * real) / step.viscosity;
}

@compute @workgroup_size(GROUP)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x / LANES;
    let lane = id.x % LANES;
    if (i >= awake_count()) { return; }
    let own = unpack_potential(heat[i]);
    let full = full_from(atomicLoad(&counters.list_overflows));
    let is_full = list_counts[i] >= full;
    let received = receive(i, lane, own, is_full);
    if (lane != 0u) { return; }
    let tag = tags[i];
    if (tag.x == REMOVED) { return; }
    if (kept[i] < 1.0 && !is_full) { atomicAdd(&counters.diffusion_limited, 1u); }

    let extent = unpack_bulk(bulk[i]);
    let lacking = unpack_rests(extent.rests);
    var state: State;
    state.content = unpack_content(matter[i]);
    state.account = unpack_account(ledger[tag.y]);
    state.acid = Compensated(state.content.acid, lacking.acid);
    state.enthalpy = Compensated(state.content.enthalpy, lacking.enthalpy);
    state = take_up(state, i, tag.x, extent.volume, own, received);
    if (BUBBLES) {
        if ((step.bubbles & BUBBLES_ACTED) > 0u) {
            state = take_from_bubbles(state, tag.y);
            if (SPRAY) { state = take_from_drops(state, tag.y); }
        }
    }
    var content = state.content;
    content.acid = clamp(state.acid.value, 0.0, 1.0);
    content.enthalpy = state.enthalpy.value;
    if (EVAPORATION && !BUBBLES) {
        let after = boiled(content, state.variance);
        content.vapour = after.vapour;
        state.variance = after.variance;
    }
    matter[i] = pack_content(content);
    ledger[tag.y] = pack_account(state.account);

    if (DENSITY || VISCOSITY) {
        if (own.temperature < TABLES_FROM || own.temperature > TABLES_TO) {
            atomicAdd(&counters.table_ends, 1u);
        }
    }
    var mixed: Mixing;
    mixed.coefficient = coefficient_of(own, unpack_eddies(eddies[i]));
    mixed.variance = state.variance;
    mixed.mass = content.mass;
    mixed.rests = pack_rests(Rests(
        state.acid.value - content.acid + state.acid.lacking, state.enthalpy.lacking));
    mixing[i] = pack_mixing(mixed);
}
