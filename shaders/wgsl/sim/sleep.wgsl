// At a frame's start: which flasks' liquid sleeps. It does once the flask has stood still, and its liquid has been slow, even and at the room's
// temperature for `CALM_FRAMES`, and nothing has come near. All of that is known on the device when the frame begins, so nothing sleeps that a
// pass would have moved.
//!include common/chemistry/features.wgsl
//!include common/chemistry/turnover_plan.wgsl
//!include common/liquid/flask_sleep.wgsl
//!include common/liquid/list_asked.wgsl
//!include common/liquid/sleep_words.wgsl
//!include common/liquid/step.wgsl

/// Frames for which nothing may happen before liquid sleeps.
override CALM_FRAMES: u32 = 18u;

/// As `common/liquid/awake.wgsl` has it.
@group(0) @binding(59) var<storage, read_write> sleep: array<u32>;

/// How far a flask may drift while it counts as unmoved, m; how far it may turn, as a length of quaternions; difference of acid fractions up to
/// which liquid is even (`solver/sleep.rs`).
override STILL: f32 = 1e-4;
override UPRIGHT: f32 = 1e-3;
override EVEN: f32 = 1e-3;
/// Way of a flask in a frame that counts as a leap, m.
override LEAP: f32 = 0.0075;

/// Whether a flask is no longer where it was.
fn has_moved(from_position: vec3<f32>, from_orientation: vec4<f32>, to: FlaskPose) -> bool {
    let way = to.position.xyz - from_position;
    // A quaternion and its negative are the same orientation.
    let turned = min(distance(from_orientation, to.orientation), distance(from_orientation, -to.orientation));
    // Negated, so that a NaN counts as motion.
    return !(dot(way, way) <= STILL * STILL && turned <= UPRIGHT);
}

/// Whether a flask moves in this frame.
fn moves(k: u32) -> bool {
    return has_moved(poses[k].position.xyz, poses[k].orientation, poses[step.after + k]);
}

/// Whether flask k goes, at its base or mouth, further than `LEAP` from where it was noted.
fn leaps(k: u32) -> bool {
    let noted = FlaskPose(vec4<f32>(flask_sleeps[k].position, 0.0), flask_sleeps[k].orientation);
    let to = poses[step.after + k];
    let mouth = vec3<f32>(0.0, flasks[k].rim, 0.0);
    let way = distance(stage_from_flask(noted, mouth), stage_from_flask(to, mouth));
    return !(max(way, distance(noted.position.xyz, to.position.xyz)) <= LEAP);
}

/// Bit of `lively` of a flask that leaps or begins to move: the last frame did not tell whom its liquid may reach (`sim/calm.wgsl`).
const STARTS = 4u;

/// Notes whether flask k moves or has drifted.
fn note_motion(k: u32) {
    let drifted = has_moved(flask_sleeps[k].position, flask_sleeps[k].orientation, poses[step.after + k]);
    let before = atomicLoad(&flask_sleeps[k].lively);
    var bits = before & (LIVELY | DISTURBED);
    if (drifted || moves(k)) {
        bits |= MOVED;
        if ((before & MOVED) == 0u || leaps(k)) { bits |= STARTS; }
    }
    atomicStore(&flask_sleeps[k].lively, bits);
}

/// How far the axis of a flask may lean in which liquid settles: 1°. Filled level, its liquid is as high within 0.35 mm in a beaker of 40 mm.
const UPRIGHT_COSINE = 0.99985;

/// Whether flask k stands upright: the lattice of one that leans is no more level than that.
fn is_upright(k: u32) -> bool {
    let pose = poses[step.after + k];
    return stage_from_flask(pose, vec3<f32>(0.0, 1.0, 0.0)).y - pose.position.y > UPRIGHT_COSINE;
}

/// Whether liquid of a flask that leaps or begins to move is near that of flask k: the last frame did not tell. Glass of another flask does not
/// act on it.
fn is_met(k: u32) -> bool {
    for (var other = 0u; other < FLASKS; other++) {
        let has_liquid = flask_sleeps[other].top > 0.0;
        if (other == k || !has_liquid || (atomicLoad(&flask_sleeps[other].lively) & STARTS) == 0u) { continue; }
        let half = 0.5 * flask_sleeps[other].top;
        let middle = stage_from_flask(poses[step.after + other], vec3<f32>(0.0, half, 0.0));
        if (way_to(k, poses[k], flask_sleeps[k].top, middle) < length(vec2<f32>(half, flasks[other].outer)) + CLEARANCE) { return true; }
    }
    return false;
}

/// Whether liquid of flask k was even in composition.
fn is_even(k: u32) -> bool {
    let least = bitcast<f32>(atomicExchange(&flask_sleeps[k].least_acid, 0x7f7fffffu));
    let most = bitcast<f32>(atomicExchange(&flask_sleeps[k].most_acid, 0u));
    return !HEAT || most - least <= EVEN;
}

@compute @workgroup_size(1)
fn main() {
    var changed = false;
    for (var k = 0u; k < FLASKS; k++) {
        note_motion(k);
        // Of liquid that sleeps no pass notes it.
        if (sleep[SLEEP_FLASKS + k] != ASLEEP) { flask_sleeps[k].top = bitcast<f32>(atomicExchange(&flask_sleeps[k].highest, 0u)); }
    }
    for (var k = 0u; k < FLASKS; k++) {
        let pose = poses[step.after + k];
        let unrest = atomicExchange(&flask_sleeps[k].unrest, 0);
        let lively = unrest > 0 || atomicLoad(&flask_sleeps[k].lively) != 0u;
        let even = is_even(k);
        if (lively || !even || is_met(k)) {
            flask_sleeps[k].calm = 0u;
            flask_sleeps[k].position = pose.position.xyz;
            flask_sleeps[k].orientation = pose.orientation;
        } else {
            flask_sleeps[k].calm = min(flask_sleeps[k].calm + 1u, CALM_FRAMES);
        }
        let before = sleep[SLEEP_FLASKS + k];
        let sleeps = flask_sleeps[k].calm == CALM_FRAMES;
        changed = changed || sleeps != (before == ASLEEP);
        let disturbed = (atomicLoad(&flask_sleeps[k].lively) & DISTURBED) != 0u;
        let settles = before > SETTLES && !disturbed && !moves(k) && is_upright(k);
        sleep[SLEEP_FLASKS + k] = select(select(0u, before - 1u, settles), ASLEEP, sleeps);
    }
    for (var k = 0u; k < FLASKS; k++) { atomicAnd(&flask_sleeps[k].lively, MOVED); }
    sleep[SLEEP_SORTED] = select(sleep[SLEEP_AWAKE], COUNT, changed);
    if (changed) {
        ask_for_list(COUNT);
        // Nothing is known of the eddies of what woke up.
        if (DORMANT_TURNOVER) { atomicStore(&turnover_plan.fastest, 0xffffffffu); }
    }
}
