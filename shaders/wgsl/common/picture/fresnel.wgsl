//! What a face between two clear media mirrors.

/// Share of unpolarised light that a face mirrors, by Fresnel's equations: `cosine` on the side that the light comes from, and `index` of
/// the side behind over that of this one. All of it where nothing passes.
fn fresnel(cosine: f32, index: f32) -> f32 {
    let inside = 1.0 - (1.0 - cosine * cosine) / (index * index);
    let within = sqrt(max(inside, 0.0));
    let across = (cosine - index * within) / (cosine + index * within);
    let along = (index * cosine - within) / (index * cosine + within);
    return select(0.5 * (across * across + along * along), 1.0, inside <= 0.0);
}
