// What the liquid did to each flask in a frame: impulse and angular impulse
// about the flask's origin, and how it stirs at the wall, by workgroup; the host adds
// the workgroups up.
//!include common/chemistry/features.wgsl
//!include common/chemistry/matter.wgsl
//!include common/glass/vessel.wgsl
//!include common/liquid/particle.wgsl
//!include common/liquid/step.wgsl

/// Mass of a particle, kg.
override MASS: f32 = 1.0;

struct LiquidLoad {
    /// Impulse, N s; w: mass in the flask, in particles of rest density.
    impulse: vec4<f32>,
    /// Angular impulse about the flask's origin, N m s; w: kinetic energy relative to the flask of
    /// what its wall pushes, J.
    angular: vec4<f32>,
    /// Sum of the particles' offsets from the flask's origin times their mass, m, stage axes.
    offsets: vec4<f32>,
}

@group(0) @binding(0) var<storage, read> position: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> tags: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> wall_push: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read_write> loads: array<LiquidLoad>;
@group(0) @binding(4) var<storage, read> matter: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read> velocity: array<vec4<f32>>;

var<workgroup> impulses: array<vec4<f32>, 256>;
var<workgroup> angulars: array<vec4<f32>, 256>;
var<workgroup> offsets: array<vec4<f32>, 256>;

/// Velocity of flask k at a point that moves with it, m/s.
fn velocity_of(k: u32, x: vec3<f32>) -> vec3<f32> {
    let fixed = flask_from_stage(poses[step.after + k], x);
    return (x - stage_from_flask(poses[step.before + k], fixed)) / step.time;
}

@compute @workgroup_size(256)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(workgroup_id) group: vec3<u32>,
        @builtin(local_invocation_index) local: u32) {
    let i = id.x;
    var tag = NOBODYS;
    var impulse = vec3<f32>(0.0);
    var x = vec3<f32>(0.0);
    var mass = 1.0;
    var energy = 0.0;
    if (i < COUNT) {
        tag = tags[i].x;
        if (PHYSICAL) { mass = unpack_content(matter[i]).mass; }
        impulse = wall_push[i].xyz * (-MASS * mass / step.time);
        x = position[i].xyz;
        if (tag > NOBODYS && tag <= FLASKS && wall_push[i].w > 0.0) {
            let relative = velocity[i].xyz - velocity_of(tag - 1u, x);
            energy = 0.5 * MASS * mass * dot(relative, relative);
        }
    }
    for (var k = 0u; k < FLASKS; k++) {
        let mine = tag == k + 1u;
        let arm = x - poses[step.after + k].position.xyz;
        let none = vec4<f32>(0.0);
        impulses[local] = select(none, vec4<f32>(impulse, mass), mine);
        angulars[local] = select(none, vec4<f32>(cross(arm, impulse), energy), mine);
        offsets[local] = select(none, vec4<f32>(arm * mass, 0.0), mine);
        workgroupBarrier();
        // Four at a time, since a barrier costs more than the sums.
        for (var reach = 64u; reach > 0u; reach >>= 2u) {
            if (local < reach) {
                let b = local + reach;
                let c = b + reach;
                let d = c + reach;
                impulses[local] = (impulses[local] + impulses[c]) + (impulses[b] + impulses[d]);
                angulars[local] = (angulars[local] + angulars[c]) + (angulars[b] + angulars[d]);
                offsets[local] = (offsets[local] + offsets[c]) + (offsets[b] + offsets[d]);
            }
            workgroupBarrier();
        }
        if (local == 0u) {
            loads[group.x * FLASKS + k] = LiquidLoad(impulses[0], angulars[0], offsets[0]);
        }
        workgroupBarrier();
    }
}
