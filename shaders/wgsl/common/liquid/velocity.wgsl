// The records `velocity` and `new_velocity` (before lines 27 and 28): a particle's velocity, m/s (xyz), and
// the multiplier that it carries to the next substep, −p/ρ in m²/s².

fn pack_velocity(v: vec3<f32>, carried: f32) -> vec4<f32> {
    return vec4<f32>(v, carried);
}

fn carried_by(velocity: vec4<f32>) -> f32 {
    return velocity.w;
}

/// λ, m², with which a substep of that time begins: what the one before left.
fn carried_multiplier(velocity: vec4<f32>, time: f32) -> f32 {
    return carried_by(velocity) * time * time;
}
