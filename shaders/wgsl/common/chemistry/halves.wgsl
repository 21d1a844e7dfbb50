// The halves of a bubble that divides. For passes that bind `bubbles` and `splits`.
//!include common/chemistry/dividing.wgsl
//!include common/chemistry/throwing.wgsl

/// How far from its place each half of a bubble that divides is at the step's end, over its radius.
const PARTS_BY: f32 = 0.7;

/// Which bubble's other half comes to a place, or goes from it: itself then.
struct Half {
    parent: u32,
    side: f32,
}

fn half_of(slot: u32, first: u32) -> Half {
    if (splits[first + slot] > 0u) { return Half(slot, 1.0); }
    let parent = parent_of(slot, first);
    if (parent == NO_PARENT || splits[first + parent] != slot + 1u) { return Half(NO_PARENT, 0.0); }
    return Half(parent, -1.0);
}

/// A half of `whole`, as it was before this step: the one that stays, with what joins it, or the one that goes.
fn divided(before: Bubble, whole: Bubble, side: f32) -> Bubble {
    var bubble = before;
    if (side < 0.0) {
        bubble = whole;
        bubble.gone = before.gone;
        bubble.vented = before.vented;
        bubble.air_gone = before.air_gone;
    }
    bubble.mass -= 0.5 * whole.mass;
    bubble.enthalpy -= 0.5 * whole.enthalpy;
    bubble.air -= 0.5 * whole.air;
    let gravity = vec3<f32>(GRAVITY_X, GRAVITY_Y, GRAVITY_Z);
    let weight = length(gravity);
    let up = select(vec3<f32>(0.0, 1.0, 0.0), -gravity / max(weight, 1e-9), weight > 1e-6);
    let across = sideways(up, bitcast<u32>(whole.position.x), bitcast<u32>(whole.radius));
    // Both begin the step as the whole: where cavities overlap there is one.
    bubble.position_before = whole.position;
    bubble.position = whole.position + side * PARTS_BY * whole.radius * across;
    return bubble;
}
