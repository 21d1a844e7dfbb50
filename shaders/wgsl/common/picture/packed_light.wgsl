//! Light in a word: the roots of red, green and blue (0 to 1), nine bits each, so that dark steps are as
//! fine as the eye takes them; and the share of what is behind that it hides, five bits.

fn packed_share(light: vec3<f32>, share: f32) -> u32 {
    let parts = vec3<u32>(sqrt(saturate(light)) * 511.0 + 0.5);
    let hidden = u32(clamp(share * 31.0 + 0.5, 0.0, 31.0));
    return parts.r | (parts.g << 9u) | (parts.b << 18u) | (hidden << 27u);
}

/// Light that hides all.
fn packed(light: vec3<f32>) -> u32 {
    return packed_share(light, 1.0);
}

/// The light, and its share.
fn unpacked(word: u32) -> vec4<f32> {
    let root = vec3<f32>((vec3<u32>(word) >> vec3<u32>(0u, 9u, 18u)) & vec3<u32>(511u)) / 511.0;
    return vec4<f32>(root * root, f32(word >> 27u) / 31.0);
}
