// Sums over the invocations that share a particle, of the solver and of the picture's ellipsoids.

/// Invocations that share one particle's neighbours. 1 on a software driver;
/// more hides the latency of a small scene on a large GPU.
override LANES: u32 = 1u;

/// Sum over the LANES invocations of one particle. The order is fixed, so the
/// bits repeat.
fn lane_sum(value: f32) -> f32 {
    var sum = value;
    if (LANES >= 2u) { sum += subgroupShuffleXor(sum, 1u); }
    if (LANES >= 4u) { sum += subgroupShuffleXor(sum, 2u); }
    if (LANES >= 8u) { sum += subgroupShuffleXor(sum, 4u); }
    if (LANES >= 16u) { sum += subgroupShuffleXor(sum, 8u); }
    if (LANES >= 32u) { sum += subgroupShuffleXor(sum, 16u); }
    return sum;
}

fn lane_sum3(value: vec3<f32>) -> vec3<f32> {
    var sum = value;
    if (LANES >= 2u) { sum += subgroupShuffleXor(sum, 1u); }
    if (LANES >= 4u) { sum += subgroupShuffleXor(sum, 2u); }
    if (LANES >= 8u) { sum += subgroupShuffleXor(sum, 4u); }
    if (LANES >= 16u) { sum += subgroupShuffleXor(sum, 8u); }
    if (LANES >= 32u) { sum += subgroupShuffleXor(sum, 16u); }
    return sum;
}
