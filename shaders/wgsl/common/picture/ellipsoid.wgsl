//! A particle's shape as drawn.

/// The ellipsoid of the points centre + M u for |u| ≤ 1, M symmetric.
struct Ellipsoid {
    /// In the stage, in the scene's unit.
    centre: vec3<f32>,
    /// Acid mass fraction.
    acid: f32,
    /// M's diagonal: xx, yy, zz.
    diagonal: vec3<f32>,
    /// 1 where it may be seen; 0 deep in the liquid; −1 for a particle that was taken out.
    visible: f32,
    /// M beside its diagonal: xy, xz, yz.
    others: vec3<f32>,
}
