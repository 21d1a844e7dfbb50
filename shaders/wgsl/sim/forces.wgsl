// Algorithm 1 from line 26's end to 28, and line 16 of the next substep. All of them read the state that
// lines 22 to 25 left, so that one pass over the neighbours serves them:
//
// 26: heat of solution (Eqs 6 to 8 and 11 to 13), which needs what the neighbours became in line 26's own
//     pass.
// 27: XSPH viscosity (Eq. 16) as a velocity update, between particles and with walls, and the paper's anti-viscosity.
// 28: internal forces. Then line 24 once more, since they may pass v_max.
// 16: within a frame, the next substep's prediction, which saves a pass.
//!include common/chemistry/boils.wgsl
//!include common/chemistry/bubbled.wgsl
//!include common/chemistry/bulk.wgsl
//!include common/chemistry/mixing.wgsl
//!include common/chemistry/pair_share.wgsl
//!include common/chemistry/plunging.wgsl
//!include common/chemistry/potential.wgsl
//!include common/glass/contact.wgsl
//!include common/liquid/awake.wgsl
//!include common/liquid/counters.wgsl
//!include common/liquid/full_list.wgsl
//!include common/liquid/internal_forces.wgsl
//!include common/liquid/kernel.wgsl
//!include common/liquid/listed.wgsl
//!include common/liquid/particle.wgsl
//!include common/liquid/prediction.wgsl
//!include common/liquid/step.wgsl
//!include common/liquid/velocity.wgsl

/// Whether the next substep is predicted here.
override PREDICT: bool = false;
/// Whether the liquid has any viscosity of its own.
override VISCOUS: bool = true;
/// D_c, m²/s.
override ACID_DIFFUSION: f32 = 0.0;
/// k_d of Eq. 13 for a particle's mass, K per J/kg.
override HEATING: f32 = 0.0;
/// ε of Eqs 11 and 12.
const EPSILON: f32 = 1e-6;

/// Whether line 27 has anything to do.
override DRAGS: bool = VISCOUS || BOILING || PHYSICAL;
/// Whether line 26 left something to be read.
override MIXES: bool = DILUTION || BOILING || PHYSICAL;

@group(0) @binding(0) var<storage, read> position: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> new_velocity: array<vec4<f32>>;
/// (membership, identity)
@group(0) @binding(2) var<storage, read> tags: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read> list_counts: array<u32>;
@group(0) @binding(4) var<storage, read> list: array<vec4<u32>>;
@group(0) @binding(5) var<storage, read_write> velocity: array<vec4<f32>>;
@group(0) @binding(6) var<storage, read> vorticity: array<vec4<f32>>;
/// (T, c) after diffusion.
@group(0) @binding(7) var<storage, read> diffused: array<vec2<f32>>;
@group(0) @binding(8) var<storage, read> mixing: array<vec4<f32>>;
@group(0) @binding(9) var<storage, read_write> heat: array<vec4<f32>>;
@group(0) @binding(10) var<storage, read> matter: array<vec4<f32>>;
@group(0) @binding(13) var<storage, read_write> bulk: array<vec4<f32>>;
@group(0) @binding(14) var<storage, read_write> counters: Counters;
@group(0) @binding(15) var<storage, read_write> eddies: array<vec2<f32>>;
@group(0) @binding(16) var<storage, read_write> boils: array<vec4<f32>>;
/// By identity, see `sim/exchange.wgsl`.
@group(0) @binding(17) var<storage, read_write> gas: array<vec4<f32>>;
/// By place of a bubble: one more than the particle at which it is to be born, and whether it is of air. Behind them see `LIVE_GROUPS` and `LOOK_GROUPS`.
@group(0) @binding(19) var<storage, read_write> claims: array<atomic<u32>>;

/// By identity: what bubbles did to a particle.
@group(0) @binding(41) var<storage, read> bubbled: array<vec4<i32>>;
/// By identity: the fastest that a particle fell since it was at rest, less than zero once it has plunged into liquid (m/s), and the
/// width of the stream that it fell in, m.
@group(0) @binding(40) var<storage, read_write> falls: array<vec2<f32>>;

/// What the neighbours add up to.
struct Sums {
    /// Line 26: heat of solution, J/kg.
    warmed: f32,
    /// Line 27: Σ w (v_j − v_i), m/s.
    drag: vec3<f32>,
    /// Line 27 of the next substep: Σ w |v_j − v_i|², J/kg.
    agitation: f32,
    /// Line 28: ∇|ω|.
    eta: vec3<f32>,
    /// Line 26, where streams take air down: Σ W.
    filled: f32,
}

/// Line 26, Eqs 8 and 11: the heat that i gets of a pair, J/kg.
fn heat_of_solution(own: Mixing, other: Mixing, q: f32) -> f32 {
    let gained = (other.acid_before - own.acid_before)
        * pair_share(step.time * ACID_DIFFUSION, diffusion_weight(q));
    return (own.heat_slope - other.heat_slope) * gained * (other.acid_before + 0.5 * EPSILON)
        / (own.acid_before + other.acid_before + EPSILON);
}

/// Line 27: W of a pair; where particles differ in mass, so that both get the same impulse.
fn pair_weight(own: Mixing, other: Mixing, q: f32) -> f32 {
    var weight = spline(q);
    if (PHYSICAL) { weight *= 2.0 * other.mass / (own.mass + other.mass); }
    return weight;
}

/// Line 27, Eq. 16: the share of its relative velocity that a pair of this weight loses. A coefficient of 1
/// throughout leaves the bits as they are without one.
fn xsph_viscosity(own: Mixing, other: Mixing, weight: f32, whole: f32) -> f32 {
    var share = weight;
    if (BOILING || PHYSICAL) { share *= 0.5 * (own.coefficient + other.coefficient); }
    // Of a pair that is not whole, drag only ever slows down, whoever else knows of it.
    if (BOILING) { share = select(max(share, 0.0), share, whole > 0.0); }
    return share;
}

/// Line 27: what walls drag, which slow down only.
fn wall_viscosity(own: Mixing, drag: vec3<f32>) -> vec3<f32> {
    if (PHYSICAL) { return drag * own.coefficient; }
    if (BOILING) { return drag * max(own.coefficient, 0.0); }
    return drag;
}

/// All that particle i's neighbours do to it; for lane 0, but all lanes must ask.
fn sum_neighbours(i: u32, lane: u32, x: vec3<f32>, v: vec3<f32>, own: Mixing, omega: vec4<f32>) -> Sums {
    var sums: Sums;
    let listed = listed_of(i);
    var full = 0xffffffffu;
    if (BOILING || DILUTION) { full = full_from(atomicLoad(&counters.list_overflows)); }
    for (var g = lane; g * 4u < listed.count; g += LANES) {
        let four = list[listed.first + g * listed.stride];
        for (var n = 0u; n < 4u; n++) {
            let j = four[n];
            let offset = x - position[j].xyz;
            let square = max(dot(offset, offset), 1e-12 * SUPPORT * SUPPORT);
            let distance = sqrt(square);
            let q = distance * INVERSE_SUPPORT;
            var other: Mixing;
            if (MIXES) { other = unpack_mixing(mixing[j]); }
            var whole = 1.0;
            if (BOILING || DILUTION) {
                whole = has_whole_list(j, i, full) * select(1.0, 0.0, list_counts[i] >= full);
            }
            if (DRAGS) {
                let relative = new_velocity[j].xyz - v;
                let weight = pair_weight(own, other, q);
                sums.drag += relative * xsph_viscosity(own, other, weight, whole);
                if (BOILING) { sums.agitation += weight * dot(relative, relative); }
            }
            // A list is filled up with the particle itself.
            if (AIR) { sums.filled += select(spline(q), 0.0, j == i); }
            if (DILUTION) { sums.warmed += whole * heat_of_solution(own, other, q); }
            if (CONFINEMENT > 0.0) {
                sums.eta += offset * ((magnitude_in(vorticity[j]) - magnitude_in(omega)) / distance * spline_slope(q));
            }
        }
    }
    if (DRAGS) { sums.drag = lane_sum3(sums.drag) * weight_scale(); }
    if (BOILING) { sums.agitation = lane_sum(sums.agitation) * weight_scale(); }
    if (DILUTION) { sums.warmed = lane_sum(sums.warmed); }
    if (AIR) { sums.filled = (lane_sum(sums.filled) + spline(0.0)) * weight_scale(); }
    if (CONFINEMENT > 0.0) { sums.eta = lane_sum3(sums.eta) * (weight_scale() / SUPPORT); }
    return sums;
}

/// Line 26's end, of the paper's chemistry.
fn warm(i: u32, own: Mixing, sums: Sums) {
    let temperature = diffused[i].x + HEATING * sums.warmed;
    let acid = diffused[i].y;
    heat[i] = pack_paper_heat(PaperHeat(temperature, acid, 0.5 * sums.agitation, own.acid_lacking));
}

/// Line 26's end, of the physical chemistry: the state follows from what the particle now holds. Its volume over V0.
fn renew(i: u32, tag: vec2<u32>, v: vec3<f32>, own: Mixing, sums: Sums) -> f32 {
    let identity = tag.y;
    let content = unpack_content(matter[i]);
    let potential = potential_of(content, own.variance);
    if (SEGREGATION) {
        eddies[i] = pack_eddies(Eddies(unpack_eddies(eddies[i]).diffusivity, own.variance));
    }
    heat[i] = pack_potential(potential);
    var extent = Bulk(1.0, 1.0, content.mass * content.vapour, own.rests);
    if (DENSITY) {
        let density = density_of(potential.acid, potential.temperature) / REST_DENSITY;
        extent.volume = content.mass * (1.0 - content.vapour) / density;
        extent.lightness = 1.0 / density;
    }
    if (BUBBLES) { extent = swollen(i, identity, extent, content, own.variance, potential); }
    // Where there is gas, the same liquid fills less of a neighbourhood.
    if (AIR) { plunge(i, tag, v, sums.filled * (1.0 + gas[identity].x)); }
    bulk[i] = pack_bulk(extent);
    return extent.volume;
}

/// Asks for a bubble at particle i, of steam or of air.
fn claim(identity: u32, i: u32, what: u32) {
    let other = atomicMax(&claims[place_of_birth(identity, position[i].xyz)], what | (i + 1u));
    if (other != 0u) { atomicAdd(&counters.bubbles_refused, 1u); }
    // Of 64 and of 256 places each (`unclaimed` in `solver/dormant.rs`).
    atomicStore(&claims[SLOTS + LIVE_GROUPS], SLOTS / 64u);
    atomicStore(&claims[SLOTS + LOOK_GROUPS], (SLOTS + 255u) / 256u);
}

/// A particle with the gas of the bubbles around it: it fills more space, and the same pressure moves it further. Where bubbles act next,
/// what they need of it, and whether one is to be born.
fn swollen(i: u32, identity: u32, liquid: Bulk, content: Content, variance: f32, potential: Potential) -> Bulk {
    var extent = liquid;
    var held = gas[identity];
    held.x += (held.y - held.x) * step.approach;
    held.w = max(held.w - step.time, 0.0);
    extent.lightness *= (liquid.volume + held.x) / liquid.volume;
    extent.volume += held.x;
    extent.vapour = held.x * (STEAM_DENSITY / REST_DENSITY);
    if ((step.bubbles & BUBBLES_ACT) > 0u) {
        let boil = boil_of(content, variance, potential);
        boils[i] = boil;
        let nuclei = growing_nuclei(boil.x, potential.temperature);
        if (held.w <= 0.0 && nucleus_grows(identity, nuclei)) {
            held.w = NUCLEUS_WAIT * share_of_nuclei(nuclei);
            claim(identity, i, 0u);
        }
    }
    gas[identity] = held;
    return extent;
}

/// How fast a particle falls, m/s: past the glass that it is in, since what is lowered with its glass is no stream.
fn speed_of_fall(membership: u32, x: vec3<f32>, v: vec3<f32>) -> f32 {
    var relative = v;
    if (FLASKS > 0u && membership != NOBODYS) { relative -= wall_velocity(membership - 1u, x); }
    let gravity = vec3<f32>(GRAVITY_X, GRAVITY_Y, GRAVITY_Z);
    return max(dot(relative, gravity) / max(length(gravity), 1e-9), 0.0);
}

/// A particle that fell in a stream and plunges into liquid takes air down, in a bubble or, by lot, in none. Once it did it does not again
/// until it has come to rest. What falls in the midst of liquid is no stream, as when its glass is stopped at once.
fn plunge(i: u32, tag: vec2<u32>, v: vec3<f32>, filled: f32) {
    if ((step.bubbles & BUBBLES_ACT) == 0u) { return; }
    let identity = tag.y;
    let falling = speed_of_fall(tag.x, position[i].xyz, v);
    let fall = falls[identity];
    var next = fall;
    if (fall.x >= 0.0 && falling >= fall.x && (fall.x >= RESTS || filled < IMMERSED)) {
        next = vec2<f32>(falling, width_of_fall(fall, filled));
    } else if (fall.x >= 0.0 && falling < SLOWED * fall.x && filled > IMMERSED) {
        next.x = -fall.x;
        let air = taken_down(fall.x, fall.y) * VOLUME;
        let radius = radius_of_air(identity, next.x);
        if (lot(identity, bitcast<u32>(fall.y)) * radius * radius * radius * (4.0 / 3.0 * 3.14159265) < air) {
            claim(identity, i, CLAIM_OF_AIR);
        }
    } else if (falling < RESTS) {
        next.x = 0.0;
    }
    falls[identity] = next;
}

@compute @workgroup_size(GROUP)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x / LANES;
    let lane = id.x % LANES;
    if (i >= awake_count()) { return; }
    let x = position[i].xyz;
    let before = new_velocity[i];
    var omega = vec4<f32>(0.0);
    if (CONFINEMENT > 0.0) { omega = vorticity[i]; }
    var own: Mixing;
    if (MIXES) { own = unpack_mixing(mixing[i]); }
    var sums: Sums;
    if (DRAGS || DILUTION || CONFINEMENT > 0.0) {
        sums = sum_neighbours(i, lane, x, before.xyz, own, omega);
    }
    let tag = tags[i].x;
    var drag = sums.drag;
    var by_walls = vec3<f32>(0.0);
    if (VISCOUS || PHYSICAL) {
        by_walls = wall_viscosity(own, drag_by_walls(tag, x, before.xyz, lane)); // 27
        drag += by_walls;
    }
    if (lane != 0u) { return; }
    // Of the frame whose pushes are summed: the next one's begins with its own prediction.
    if (LOADS) { wall_push[i] += vec4<f32>(step.time * step.viscosity * by_walls, 0.0); }

    var v = before.xyz;
    if (DRAGS) { v += step.viscosity * drag; } // 27
    if (CONFINEMENT > 0.0) { v += step.time * confinement(sums.eta, omega); } // 28
    if (BUBBLES && tag != REMOVED) { v += step.time * LIFT_QUANTUM * vec3<f32>(bubbled[BUBBLED_VECTORS * tags[i].y + BUBBLED_LIFTED].xyz); } // 28
    v = clamp_speed(v); // 24
    velocity[i] = pack_velocity(v, carried_by(before));
    var volume = 1.0;
    if (PHYSICAL) {
        if (tag != REMOVED) { volume = renew(i, tags[i], before.xyz, own, sums); } // 26
    } else if (HEAT) {
        warm(i, own, sums); // 26
    }
    if (PREDICT) { predict(i, x, v, volume, tag, step.after, step.next); } // 16
}
