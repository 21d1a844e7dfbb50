// What every pass over particles shares.

/// Number of particles.
override COUNT: u32 = 1u;
/// Rows of the neighbour list.
override LIST_CAPACITY: u32 = 64u;
/// Invocations that share one particle's neighbours. 1 on a software driver;
/// more hides the latency of a small scene on a large GPU.
override LANES: u32 = 1u;

/// Membership of a particle that is in no flask.
const NOBODYS: u32 = 0u;
/// Tag of a particle that was taken out because it turned non-finite.
const REMOVED: u32 = 0xffffffffu;

/// Sum over the LANES invocations of one particle. The order is fixed, so the
/// bits repeat.
fn lane_sum(value: f32) -> f32 {
    var sum = value;
    if (LANES >= 2u) { sum += subgroupShuffleXor(sum, 1u); }
    if (LANES >= 4u) { sum += subgroupShuffleXor(sum, 2u); }
    if (LANES >= 8u) { sum += subgroupShuffleXor(sum, 4u); }
    return sum;
}

fn lane_sum3(value: vec3<f32>) -> vec3<f32> {
    var sum = value;
    if (LANES >= 2u) { sum += subgroupShuffleXor(sum, 1u); }
    if (LANES >= 4u) { sum += subgroupShuffleXor(sum, 2u); }
    if (LANES >= 8u) { sum += subgroupShuffleXor(sum, 4u); }
    return sum;
}

/// Tests of the bits: a compiler may assume that arithmetic is finite.
fn is_finite(v: vec3<f32>) -> bool {
    let bits = bitcast<vec3<u32>>(v) & vec3<u32>(0x7f800000u);
    return all(bits != vec3<u32>(0x7f800000u));
}

/// Where a particle that was taken out is parked: far off, and apart from the others.
fn parked(index: u32) -> vec3<f32> {
    return vec3<f32>(1.0e4 + f32(index & 1023u) * 4.0, -1.0e4, f32(index >> 10u) * 4.0);
}
