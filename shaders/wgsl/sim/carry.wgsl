// What a held flask has in it goes with the hand where that leaps: a rigid motion of liquid, bubbles and drops, in no time, which
// none of them feels. Where the flask breaks, all that is nobody's.
//!include common/chemistry/bubble.wgsl
//!include common/chemistry/drops.wgsl
//!include common/chemistry/features.wgsl
//!include common/liquid/particle.wgsl

/// Whether walls hold the surface's line.
override HYSTERESIS: f32 = 0.0;

/// after_from_before, both in the stage.
struct Carry {
    /// w unused.
    position: vec4<f32>,
    /// Unit quaternion, xyzw.
    orientation: vec4<f32>,
    /// Of what is in the flask.
    membership: u32,
    /// What it has from now on.
    becomes: u32,
}

var<immediate> carry: Carry;

@group(0) @binding(0) var<storage, read_write> position: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read_write> velocity: array<vec4<f32>>;
/// (membership, identity)
@group(0) @binding(2) var<storage, read_write> tags: array<vec2<u32>>;
/// By identity.
@group(0) @binding(3) var<storage, read_write> held: array<vec4<f32>>;
/// Those that a frame begins and ends with.
@group(0) @binding(4) var<storage, read_write> bubbles: array<Bubble>;
@group(0) @binding(5) var<storage, read_write> drops: array<Drops>;

fn turned(v: vec3<f32>) -> vec3<f32> {
    let t = 2.0 * cross(carry.orientation.xyz, v);
    return v + carry.orientation.w * t + cross(carry.orientation.xyz, t);
}

fn moved(x: vec3<f32>) -> vec3<f32> {
    return turned(x) + carry.position.xyz;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = id.x;
    if (i < COUNT) {
        if (tags[i].x == carry.membership) {
            position[i] = vec4<f32>(moved(position[i].xyz), position[i].w);
            velocity[i] = vec4<f32>(turned(velocity[i].xyz), velocity[i].w);
            if (HYSTERESIS > 0.0) {
                let identity = tags[i].y;
                held[identity] = vec4<f32>(turned(held[identity].xyz), held[identity].w);
                // No wall holds what is nobody's.
                if (carry.becomes == NOBODYS) { held[identity] = vec4<f32>(0.0); }
            }
            tags[i].x = carry.becomes;
        }
    }
    if (BUBBLES && i < SLOTS) {
        let seen = is_there(bubbles[i]) || bubbles[i].radius_before > 0.0;
        if (seen && bubbles[i].membership == carry.membership) {
            bubbles[i].position = moved(bubbles[i].position);
            bubbles[i].position_before = moved(bubbles[i].position_before);
            bubbles[i].flow = turned(bubbles[i].flow);
            bubbles[i].velocity = turned(bubbles[i].velocity);
            bubbles[i].membership = carry.becomes;
        }
    }
    if (SPRAY && i < 2u * SLOTS) {
        if (drops[i].mass > 0.0 && drops[i].memberships >> 16u == carry.membership) {
            drops[i].position = moved(drops[i].position);
            drops[i].velocity = turned(drops[i].velocity);
            drops[i].memberships = (drops[i].memberships & 0xffffu) | (carry.becomes << 16u);
        }
    }
}
