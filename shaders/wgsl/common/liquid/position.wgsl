// The record `position`: where a particle is in the stage, m (xyz), and the vapour that it holds over
// V0·ρ0; a negative amount marks a particle that was taken out. The picture reads it too.

fn pack_position(x: vec3<f32>, vapour: f32) -> vec4<f32> {
    return vec4<f32>(x, vapour);
}

fn pack_taken_out(x: vec3<f32>) -> vec4<f32> {
    return vec4<f32>(x, -1.0);
}

fn is_taken_out(position: vec4<f32>) -> bool {
    return position.w < 0.0;
}
