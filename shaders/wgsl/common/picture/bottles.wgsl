//! Bottles in a row, flat but lit as round.

//!include common/picture/sight.wgsl

/// Distance between two bottles' middles, m.
const BOTTLE_STEP = 0.108;

/// The light of what bottle is at `place` (x, y) of a shelf, and its share of the pixel; `at` in the room.
/// Boards are `step` apart.
fn bottles(place: vec2<f32>, step: f32, at: vec3<f32>, sharp: f32) -> vec4<f32> {
    let row = floor(place.y / step);
    let cell = floor(place.x / BOTTLE_STEP);
    let number = u32(cell + 16.0 * row);
    let u = place.x - (cell + 0.5) * BOTTLE_STEP - 0.012 * (lot(number + 99u, 0u) - 0.5);
    let y = place.y - row * step;
    let kind = u32(3.0 * lot(number * 7u + 3u, 0u));
    let size = 0.82 + 0.18 * lot(number * 5u + 1u, 0u);
    let body = select(select(0.150, 0.135, kind == 1u), 0.185, kind == 2u) * size;
    let radius = select(0.045, 0.038, kind > 0u) * size;
    let neck = 0.44 * radius;
    let above = saturate((y - body) / (0.8 * radius));
    var half = mix(radius, neck, above * above * (3.0 - 2.0 * above));
    let cap = y > body + 0.8 * radius;
    half = select(half, neck + 0.005, cap);
    let top = body + 0.8 * radius + 0.028;
    let share = saturate((half - abs(u)) * sharp + 0.5) * saturate((top - y) * sharp + 0.5);
    if (share == 0.0) { return vec4<f32>(0.0); }

    let x = clamp(u / half, -1.0, 1.0);
    let normal = vec3<f32>(x, 0.0, sqrt(max(1.0 - x * x, 0.0)));
    // Clear glass with something in it, brown glass, white plastic.
    let filled = saturate((body * (0.35 + 0.5 * lot(number * 3u + 2u, 0u)) - y) * sharp + 0.5);
    let tint = lot(number * 11u + 4u, 0u);
    var content = vec3<f32>(0.55, 0.58, 0.60);
    if (tint > 0.55) { content = vec3<f32>(0.10, 0.30, 0.55); }
    if (tint > 0.75) { content = vec3<f32>(0.60, 0.30, 0.05); }
    if (tint > 0.90) { content = vec3<f32>(0.10, 0.42, 0.25); }
    var albedo = mix(vec3<f32>(0.36, 0.37, 0.36), content, filled);
    if (kind == 1u) { albedo = vec3<f32>(0.16, 0.055, 0.012) * (1.0 - 0.3 * filled); }
    if (kind == 2u) { albedo = vec3<f32>(0.62, 0.63, 0.62); }
    let shiny = select(1.0, 0.25, kind == 2u || cap);
    if (cap) {
        albedo = vec3<f32>(0.02, 0.11, 0.36);
        if (kind == 1u) { albedo = vec3<f32>(0.03); }
        if (kind == 2u) { albedo = vec3<f32>(0.48, 0.03, 0.03); }
    } else {
        // A label: lines of text, and a red diamond on some.
        let label = in_rectangle(vec2<f32>(abs(u), y), vec2<f32>(-1.0, 0.25 * body), vec2<f32>(0.86 * half, 0.78 * body), sharp);
        let text = lines(y, 1.0 / 0.012, 0.004, sharp) * in_rectangle(vec2<f32>(u, y), vec2<f32>(-0.6 * half, 0.52 * body), vec2<f32>(0.5 * half, 0.74 * body), sharp);
        let diamond = abs(u) + abs(y - 0.385 * body) - 0.014;
        let red = select(0.0, saturate(0.5 - abs(diamond + 0.002) * sharp + 0.002 * sharp), kind < 2u) * min(1.0, 0.004 * sharp);
        albedo = mix(albedo, mix(mix(vec3<f32>(0.70, 0.70, 0.66), vec3<f32>(0.15), 0.8 * text), vec3<f32>(0.55, 0.03, 0.03), red), label);
    }
    // What stands in a shelf has light from before it.
    let light = lit(albedo, at, normal, 0.5 + 0.3 * normal.z);
    let glint = saturate(1.0 - abs(x + 0.58) / 0.10) * saturate(1.0 - abs(y - 0.45 * body) / (0.5 * body));
    return vec4<f32>(light + 0.35 * shiny * glint * key_light(at).light, share);
}
