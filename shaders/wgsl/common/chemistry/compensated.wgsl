// Compensated addition (Kahan 1965). What an addition rounds away is kept for
// the next one: acid that diffuses through liquid at rest comes by 1e-8 of a
// substep, which is gone beside c = 0.9 (its last bit is 6e-8) and not beside
// c = 0, so that the liquid would gain acid.
//!include common/liquid/step.wgsl

/// A sum, and what it lacks because it was rounded.
struct Compensated {
    value: f32,
    lacking: f32,
}

/// A sum as it was rounded: compilers may take (x + w) − x for w, and Mesa's does.
fn rounded(sum: f32) -> f32 {
    return bitcast<f32>(bitcast<u32>(sum) ^ unknown_zero());
}

fn compensated(x: Compensated, change: f32) -> Compensated {
    let wanted = change + x.lacking;
    let sum = rounded(x.value + wanted);
    return Compensated(sum, wanted - (sum - x.value));
}
