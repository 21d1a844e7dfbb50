/// A number in [0, 1) from two.
fn lot(a: u32, b: u32) -> f32 {
    var bits = (a ^ (b * 2654435769u)) * 747796405u + 2891336453u;
    bits = ((bits >> ((bits >> 28u) + 4u)) ^ bits) * 277803737u;
    return f32((bits >> 22u) ^ (bits & 1023u)) / 1024.0;
}
