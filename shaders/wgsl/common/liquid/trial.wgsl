// The records of a predicted position x*, m (xyz). `trial` has the particle's volume over V0 beside it,
// `sorted_trial` the bits of its membership, and `solved` an iteration's change of its multiplier.

fn pack_trial(x: vec3<f32>, volume: f32) -> vec4<f32> {
    return vec4<f32>(x, volume);
}

fn volume_in(trial: vec4<f32>) -> f32 {
    return trial.w;
}

fn pack_sorted_trial(x: vec3<f32>, membership: u32) -> vec4<f32> {
    return vec4<f32>(x, bitcast<f32>(membership));
}

fn membership_in(sorted_trial: vec4<f32>) -> u32 {
    return bitcast<u32>(sorted_trial.w);
}

fn pack_solved(x: vec3<f32>, change: f32) -> vec4<f32> {
    return vec4<f32>(x, change);
}

fn change_in(solved: vec4<f32>) -> f32 {
    return solved.w;
}
