// Sums of quanta over the lanes of a place, which together may be more than a word holds.
//!include common/liquid/lane_nearest.wgsl

/// A sum of quanta, which together may be more than a word holds.
struct QuantaSum {
    high: i32,
    low: i32,
}

const LOW_BITS: u32 = 12u;

fn added(sum: QuantaSum, count: i32) -> QuantaSum {
    return QuantaSum(sum.high + (count >> LOW_BITS), sum.low + (count & 4095));
}

fn lane_sum_of_quanta(sum: QuantaSum, quantum: f32) -> f32 {
    let high = f32(lane_sum_of_integers(sum.high)) * 4096.0;
    return (high + f32(lane_sum_of_integers(sum.low))) * quantum;
}
