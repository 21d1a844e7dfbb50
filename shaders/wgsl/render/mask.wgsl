//! The part of the picture that the headset's lenses hide, at the nearest depth: what comes
//! after it fails the depth test there and costs nothing.

/// Corners in the picture, 0 to 1 from the upper left; the view that they are of.
@group(0) @binding(0) var<storage, read> hidden: array<vec4<f32>>;

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(view_index) eye: u32) -> @builtin(position) vec4<f32> {
    let corner = hidden[index];
    if (u32(corner.z) != eye) { return vec4<f32>(2.0, 2.0, 2.0, 1.0); }
    return vec4<f32>(2.0 * corner.xy - 1.0, 1.0, 1.0);
}

@fragment
fn fragment() -> @location(0) vec4<f32> {
    return vec4<f32>(0.0, 0.0, 0.0, 1.0);
}
