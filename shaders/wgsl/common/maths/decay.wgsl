/// 1 − exp(−x) for x ≥ 0: what a decay takes in a substep. Of small x the
/// difference would keep few digits: heat through glass has x = 1e-6, where
/// f32 steps by 6 %.
fn decayed(x: f32) -> f32 {
    return select(1.0 - exp(-x), x * (1.0 - x * (0.5 - x / 6.0)), x < 0.02);
}
