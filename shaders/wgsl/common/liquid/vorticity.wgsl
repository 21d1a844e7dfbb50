// The record `vorticity`: ω (xyz) and |ω|, 1/s.

fn pack_vorticity(omega: vec3<f32>) -> vec4<f32> {
    return vec4<f32>(omega, length(omega));
}

fn magnitude_in(vorticity: vec4<f32>) -> f32 {
    return vorticity.w;
}
