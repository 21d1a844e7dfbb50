// Cubic spline kernel with support radius h (Monaghan 1992, written as two
// truncated powers so that it needs no branch: on a software driver both
// sides of a branch are paid for).

/// Support radius h, metres.
override SUPPORT: f32 = 0.005;
/// 1/h: no driver makes a multiplication of a division by h.
override INVERSE_SUPPORT: f32 = 1.0 / SUPPORT;
/// Particle volume V0 = d³, cubic metres.
override VOLUME: f32 = 1.5625e-8;

/// V0·σ of the cubic spline, σ = 8/(π h³): weights below are fractions of the rest density.
fn weight_scale() -> f32 {
    return VOLUME * 8.0 / (3.14159265358979 * SUPPORT * SUPPORT * SUPPORT);
}

/// W(q)/σ for q = r/h.
fn spline(q: f32) -> f32 {
    let a = max(1.0 - q, 0.0);
    let b = max(0.5 - q, 0.0);
    return 2.0 * a * a * a - 8.0 * b * b * b;
}

/// dW/dq / σ.
fn spline_slope(q: f32) -> f32 {
    let a = max(1.0 - q, 0.0);
    let b = max(0.5 - q, 0.0);
    return 24.0 * b * b - 6.0 * a * a;
}
