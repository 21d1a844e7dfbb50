//! Light in a word: the roots of red, green and blue (0 to 1), ten bits each; so that dark steps are as
//! fine as the eye takes them.

fn packed(light: vec3<f32>) -> u32 {
    let parts = vec3<u32>(sqrt(saturate(light)) * 1023.0 + 0.5);
    return parts.r | (parts.g << 10u) | (parts.b << 20u);
}

fn unpacked(word: u32) -> vec3<f32> {
    let root = vec3<f32>((vec3<u32>(word) >> vec3<u32>(0u, 10u, 20u)) & vec3<u32>(1023u)) / 1023.0;
    return root * root;
}
