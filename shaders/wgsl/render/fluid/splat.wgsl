//! The nearest ellipsoid at each pixel, as reversed depth.

//!include common/splat.wgsl

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) place: vec2<f32>,
    @location(1) @interpolate(flat) kappa: f32,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(view_index) eye: u32) -> Varyings {
    let e = ellipsoids[index / 3u];
    // What lies deep in the liquid is never seen, and most of it does.
    if !(e.visible > 0.0) {
        return Varyings(NOWHERE, vec2<f32>(2.0), 0.0);
    }
    let corner = corner_of(e, eye, index % 3u);
    return Varyings(corner.clip, corner.place, corner.kappa);
}

@fragment
@early_depth_test(less_equal)
fn fragment(in: Varyings) -> @builtin(frag_depth) f32 {
    let q_squared = 1.0 - dot(in.place, in.place);
    if q_squared < 0.0 {
        discard;
    }
    return in.clip.z * ((1.0 + in.kappa * sqrt(q_squared)) / (1.0 + in.kappa));
}
