// A pane that stops what flies: the sash of a fume hood. Vertical, and slid in its own plane alone, so that it pushes nothing.

struct Pane {
    /// One lower corner, in the middle of its thickness, m.
    corner: vec3<f32>,
    /// Half its thickness, m.
    half: f32,
    /// From there along its lower edge, and up its side.
    along: vec3<f32>,
    /// Of the step, s.
    time: f32,
    up: vec3<f32>,
}

var<immediate> pane: Pane;

/// The velocity that something at `x` with `velocity` has in the step, so that it is no nearer to the pane's middle than `gap` behind it. What
/// would cross it loses its part across and keeps that along it: it wets the glass, and runs down.
fn stopped(x: vec3<f32>, velocity: vec3<f32>, gap: f32) -> vec3<f32> {
    let normal = normalize(cross(pane.along, pane.up));
    let from_corner = x - pane.corner;
    let apart = dot(from_corner, normal);
    let side = select(-1.0, 1.0, apart >= 0.0);
    let distance = abs(apart);
    // Towards it.
    let speed = -side * dot(velocity, normal);
    let most = (distance - gap) / pane.time;
    if (speed <= most) { return velocity; }
    // Where it would meet the middle; what is too near already is beside where it is.
    let until = select(0.0, min(distance / max(speed, 1e-12), pane.time), speed > 0.0);
    let met = from_corner + until * velocity;
    let place = vec2<f32>(dot(met, pane.along) / dot(pane.along, pane.along), dot(met, pane.up) / dot(pane.up, pane.up));
    if (any(place < vec2<f32>(0.0)) || any(place > vec2<f32>(1.0))) { return velocity; }
    return velocity + side * (speed - most) * normal;
}
