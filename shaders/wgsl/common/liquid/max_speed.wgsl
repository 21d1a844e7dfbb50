// Line 24's bound is one of the magnitude: the minimum of a vector and a scalar does not exist.

/// v_max, m/s.
override MAX_SPEED: f32 = 10.0;

/// Line 24: a velocity as it may be. What is cut is counted in the including shader's `counters`.
fn clamp_speed(v: vec3<f32>) -> vec3<f32> {
    if (length(v) > MAX_SPEED) { atomicAdd(&counters.speed_limited, 1u); }
    return bounded_speed(v);
}

/// The same, not counted.
fn bounded_speed(v: vec3<f32>) -> vec3<f32> {
    var bounded = v;
    let speed = length(v);
    if (speed > MAX_SPEED) { bounded *= MAX_SPEED / speed; }
    return bounded;
}
