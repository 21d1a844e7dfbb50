// Line 27, XSPH viscosity (Eq. 16) as a velocity update between particles and
// with walls, and line 28, internal forces. Both read the state that lines 22
// to 25 left, so that one pass over the neighbours serves them. Within a frame
// it ends with the next substep's prediction, which saves another.
//
// Where acid is diluted, line 26 ends here as well: the heat of solution
// (Eqs 6 to 8 and 11 to 13) needs what the neighbours became.
//!include common/liquid/particle.wgsl
//!include common/liquid/kernel.wgsl
//!include common/liquid/step.wgsl
//!include common/glass/contact.wgsl
//!include common/liquid/internal_forces.wgsl
//!include common/chemistry/pair_share.wgsl
//!include common/chemistry/potential.wgsl
//!include common/liquid/prediction.wgsl
//!include common/maths/compensated.wgsl
//!include common/liquid/counters.wgsl
//!include common/liquid/full_list.wgsl

/// Whether the next substep is predicted here.
override PREDICT: bool = false;
/// Whether the liquid has any viscosity.
override VISCOUS: bool = true;
/// Whether particles have a temperature; whether acid diffuses; whether
/// viscosity depends on the temperature (Eq. 17).
override HEAT: bool = false;
override DILUTION: bool = false;
override BOILING: bool = false;
/// Whether the chemistry is the physical one.
override PHYSICAL: bool = false;
/// Whether volume and density follow composition and temperature.
override DENSITY: bool = false;
/// ρ0, kg/m³.
override REST_DENSITY: f32 = 1000.0;
/// D_c, m²/s.
override ACID_DIFFUSION: f32 = 0.0;
/// k_d of Eq. 13 for a particle's mass, K per J/kg.
override HEATING: f32 = 0.0;
/// ε of Eqs 11 and 12.
const EPSILON: f32 = 1e-6;

@group(0) @binding(0) var<storage, read> position: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> new_velocity: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> tags: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read> list_counts: array<u32>;
@group(0) @binding(4) var<storage, read> list: array<vec4<u32>>;
@group(0) @binding(5) var<storage, read_write> velocity: array<vec4<f32>>;
/// (ω, |ω|), 1/s.
@group(0) @binding(6) var<storage, read> vorticity: array<vec4<f32>>;
/// (T, c) after diffusion.
@group(0) @binding(7) var<storage, read> diffused: array<vec2<f32>>;
/// (c before, s_i in J/kg, coefficient of Eq. 17, what c lacks); of the
/// physical chemistry (α, coefficient, mass, what c and h lack).
@group(0) @binding(8) var<storage, read> mixing: array<vec4<f32>>;
/// (T in °C, c, ½ Σ w|v_ij|² in J/kg, what c lacks), or a potential.
@group(0) @binding(9) var<storage, read_write> heat: array<vec4<f32>>;
/// (c, h in J/kg, y, mass over V0·ρ0) of what a particle holds.
@group(0) @binding(10) var<storage, read_write> matter: array<vec4<f32>>;
/// By identity: (kinetic energy paid for, heat exchanged, steam's mass and enthalpy).
@group(0) @binding(11) var<storage, read_write> ledger: array<vec4<f32>>;
/// By identity: ½ Σ w|v_ij|², J/kg.
@group(0) @binding(12) var<storage, read_write> agitations: array<f32>;
/// (volume over V0, ρ0 over density, vapour over V0·ρ0, what c and h lack).
@group(0) @binding(13) var<storage, read_write> bulk: array<vec4<f32>>;
@group(0) @binding(14) var<storage, read_write> counters: Counters;

/// What Eqs 8 and 11 make of a pair: the heat that i gets of it, J/kg.
fn warming(own: vec4<f32>, other: vec4<f32>, q: f32) -> f32 {
    let gained = (other.x - own.x) * pair_share(step.time * ACID_DIFFUSION, diffusion_weight(q));
    return (own.y - other.y) * gained * (other.x + 0.5 * EPSILON) / (own.x + other.x + EPSILON);
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x / LANES;
    let lane = id.x % LANES;
    if (i >= COUNT) { return; }
    let x = position[i].xyz;
    let own = new_velocity[i];
    var omega = vec4<f32>(0.0);
    if (CONFINEMENT > 0.0) { omega = vorticity[i]; }
    var mixed = vec4<f32>(0.0);
    if (DILUTION || BOILING || PHYSICAL) { mixed = mixing[i]; }

    var drag = vec3<f32>(0.0);
    var eta = vec3<f32>(0.0);
    var attraction = vec3<f32>(0.0);
    var agitation = 0.0;
    var warmed = 0.0;
    var push = vec3<f32>(0.0);
    if (VISCOUS || BOILING || DILUTION || PHYSICAL || CONFINEMENT > 0.0 || COHESION > 0.0) {
        let count = list_counts[i];
        var full = 0xffffffffu;
        if (BOILING || DILUTION) { full = full_from(atomicLoad(&counters.list_overflows)); }
        for (var g = lane; g * 4u < count; g += LANES) {
            let four = list[g * COUNT + i];
            for (var n = 0u; n < 4u; n++) {
                let j = four[n];
                let offset = x - position[j].xyz;
                let square = max(dot(offset, offset), 1e-12 * SUPPORT * SUPPORT);
                let distance = sqrt(square);
                let q = distance * INVERSE_SUPPORT;
                var other = vec4<f32>(0.0);
                if (DILUTION || BOILING || PHYSICAL) { other = mixing[j]; }
                var whole = 1.0;
                if (BOILING || DILUTION) {
                    whole = has_whole_list(j, i, full) * select(1.0, 0.0, count >= full);
                }
                if (PHYSICAL) {
                    let relative = new_velocity[j].xyz - own.xyz;
                    let weight = spline(q) * (2.0 * other.z / (mixed.z + other.z));
                    drag += relative * (weight * (0.5 * (mixed.y + other.y)));
                    if (BOILING) {
                        push -= relative * (whole * weight * (0.5 * (mixed.x + other.x)));
                        agitation += weight * dot(relative, relative);
                    }
                } else if (VISCOUS || BOILING) {
                    let relative = new_velocity[j].xyz - own.xyz;
                    let weight = spline(q);
                    // A coefficient of 1 throughout leaves the bits as they are without boiling.
                    var pair = weight;
                    if (BOILING) {
                        pair *= 0.5 * (mixed.z + other.z);
                        // Drag only ever slows down, whoever else knows of it.
                        pair = select(max(pair, 0.0), pair, whole > 0.0);
                        agitation += weight * dot(relative, relative);
                    }
                    drag += relative * pair;
                }
                if (DILUTION) { warmed += whole * warming(mixed, other, q); }
                if (CONFINEMENT > 0.0) {
                    eta += offset * ((vorticity[j].w - omega.w) / distance * spline_slope(q));
                }
                if (COHESION > 0.0) { attraction -= offset * (cohesion(q) / distance); }
            }
        }
        if (VISCOUS || BOILING || PHYSICAL) { drag = lane_sum3(drag) * weight_scale(); }
        if (PHYSICAL && BOILING) { push = lane_sum3(push) * weight_scale(); }
        if (BOILING) { agitation = lane_sum(agitation) * weight_scale(); }
        if (DILUTION) { warmed = lane_sum(warmed); }
        if (CONFINEMENT > 0.0) { eta = lane_sum3(eta) * (weight_scale() / SUPPORT); }
        if (COHESION > 0.0) { attraction = lane_sum3(attraction); }
    }
    let tag = tags[i].x;
    var acceleration = attraction;
    if (VISCOUS || PHYSICAL || ADHESION > 0.0) {
        let walls = contact(tag, x, own.xyz, lane);
        if (PHYSICAL) {
            drag += walls.drag * mixed.y;
        } else if (BOILING) {
            // Walls only ever slow down.
            drag += walls.drag * max(mixed.z, 0.0);
        } else if (VISCOUS) {
            drag += walls.drag;
        }
        if (ADHESION > 0.0) { acceleration += ADHESION * walls.pull; }
    }
    if (lane != 0u) { return; }

    if (CONFINEMENT > 0.0) { acceleration += confinement(eta, omega); }
    var v = own.xyz;
    if (VISCOUS || BOILING || PHYSICAL) { v += step.viscosity * drag; }
    if (PHYSICAL && BOILING) { v += push; }
    if (CONFINEMENT > 0.0 || COHESION > 0.0 || ADHESION > 0.0) { v += step.time * acceleration; }
    // Line 24 again: what boils or attracts came after it.
    let speed = length(v);
    if (speed > MAX_SPEED) {
        v *= MAX_SPEED / speed;
        atomicAdd(&counters.speed_limited, 1u);
    }
    velocity[i] = vec4<f32>(v, own.w);
    var volume = 1.0;
    if (PHYSICAL) {
        if (tag != REMOVED) {
            var content = matter[i];
            var rests = mixed.w;
            if (BOILING) {
                // What the impulses gave in kinetic energy is taken from the enthalpy: over a
                // pair, and so over the liquid, it is what they added.
                let paid = dot(push, own.xyz) + 0.5 * dot(push, push);
                let lacking = unpack_rests(rests);
                let enthalpy = compensated(content.y, lacking.y, -paid);
                content.y = enthalpy.x;
                rests = pack_rests(lacking.x, enthalpy.y);
                matter[i] = content;
                let identity = tags[i].y;
                ledger[identity].x += content.w * paid;
                agitations[identity] = 0.5 * agitation;
            }
            let new_potential = potential(content.x, content.y, content.z, content.w);
            heat[i] = new_potential;
            var bulky = vec4<f32>(1.0, 1.0, content.w * content.z, rests);
            if (DENSITY) {
                let density = density_of(new_potential.y, new_potential.x) / REST_DENSITY;
                bulky.x = content.w * (1.0 - content.z) / density;
                bulky.y = 1.0 / density;
            }
            volume = bulky.x;
            bulk[i] = bulky;
        }
    } else if (HEAT) {
        let after = diffused[i];
        heat[i] = vec4<f32>(after.x + HEATING * warmed, after.y, 0.5 * agitation, mixed.w);
    }
    if (PREDICT) { predict(i, x, v, volume, tag, step.after, step.next); }
}
