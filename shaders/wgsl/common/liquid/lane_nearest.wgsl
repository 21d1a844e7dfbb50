// The nearest of what the lanes of one place have found, and sums of integers, in a fixed order.
//!include common/liquid/lane_sums.wgsl

/// Sum over the LANES invocations.
fn lane_sum_of_integers(value: i32) -> i32 {
    var sum = value;
    if (LANES >= 2u) { sum += subgroupShuffleXor(sum, 1u); }
    if (LANES >= 4u) { sum += subgroupShuffleXor(sum, 2u); }
    if (LANES >= 8u) { sum += subgroupShuffleXor(sum, 4u); }
    if (LANES >= 16u) { sum += subgroupShuffleXor(sum, 8u); }
    if (LANES >= 32u) { sum += subgroupShuffleXor(sum, 16u); }
    return sum;
}

fn lane_max(value: u32) -> u32 {
    var most = value;
    if (LANES >= 2u) { most = max(most, subgroupShuffleXor(most, 1u)); }
    if (LANES >= 4u) { most = max(most, subgroupShuffleXor(most, 2u)); }
    if (LANES >= 8u) { most = max(most, subgroupShuffleXor(most, 4u)); }
    if (LANES >= 16u) { most = max(most, subgroupShuffleXor(most, 8u)); }
    if (LANES >= 32u) { most = max(most, subgroupShuffleXor(most, 16u)); }
    return most;
}

/// A particle and how near it is.
struct Nearest {
    distance: f32,
    particle: u32,
}

fn nearer(a: Nearest, b: Nearest) -> Nearest {
    if (b.distance < a.distance || (b.distance == a.distance && b.particle < a.particle)) { return b; }
    return a;
}

fn lane_nearest(own: Nearest) -> Nearest {
    var best = own;
    if (LANES >= 2u) {
        best = nearer(best, Nearest(subgroupShuffleXor(best.distance, 1u), subgroupShuffleXor(best.particle, 1u)));
    }
    if (LANES >= 4u) {
        best = nearer(best, Nearest(subgroupShuffleXor(best.distance, 2u), subgroupShuffleXor(best.particle, 2u)));
    }
    if (LANES >= 8u) {
        best = nearer(best, Nearest(subgroupShuffleXor(best.distance, 4u), subgroupShuffleXor(best.particle, 4u)));
    }
    if (LANES >= 16u) {
        best = nearer(best, Nearest(subgroupShuffleXor(best.distance, 8u), subgroupShuffleXor(best.particle, 8u)));
    }
    if (LANES >= 32u) {
        best = nearer(best, Nearest(subgroupShuffleXor(best.distance, 16u), subgroupShuffleXor(best.particle, 16u)));
    }
    return best;
}
