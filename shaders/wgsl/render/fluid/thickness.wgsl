//! How much liquid each ray passes through, and how much of that is acid, added up.
//!
//! A particle spreads its volume d³ over the disc of its silhouette with the weight 1 − ρ²: the
//! sum over the picture is the liquid's true volume whatever the ellipsoids' sizes, and no pixel
//! sees where one begins. (Chords of the ellipsoids would count each overlap twice.)

//!include common/splat.wgsl

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) place: vec2<f32>,
    /// Thickness in the middle, along the eye's axis; its share of acid.
    @location(1) @interpolate(flat) middle: vec2<f32>,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(view_index) eye: u32) -> Varyings {
    let e = ellipsoids[index / 3u];
    if !(e.visible >= 0.0) {
        return Varyings(NOWHERE, vec2<f32>(2.0), vec2<f32>(0.0));
    }
    let corner = corner_of(e, eye, index % 3u);
    // In the sphere's space a ray through (u, v) goes 2κq/(1 − κ²q²) of its way to the circle's
    // plane through the sphere; that way has the view depth of the circle's plane, near enough
    // that of the centre. 4/3 (1 − ρ²) has the integral of q over the disc.
    let centre = frame.views[eye].clip_from_stage * vec4<f32>(e.centre, 1.0);
    let d = frame.spacing;
    let volume = d * d * d / (4.18879 * max(corner.determinant, 1e-30));
    let thickness = 2.6666667 * corner.kappa * centre.w * volume;
    return Varyings(corner.clip, corner.place, vec2<f32>(thickness, thickness * e.acid));
}

@fragment
fn fragment(in: Varyings) -> @location(0) vec4<f32> {
    let share = 1.0 - dot(in.place, in.place);
    if share < 0.0 {
        discard;
    }
    return vec4<f32>(in.middle * share, 0.0, 0.0);
}
