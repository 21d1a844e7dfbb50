//! The window's light on the bench under a vessel of liquid. Through the side none comes: the base mirrors it. Through the upper surface it comes
//! steeply, and the wall mirrors what meets it, so the side towards the window lies in shadow and the other has its light twice.

//!include common/picture/daylight.wgsl
//!include common/picture/fresnel.wgsl
//!include common/picture/frame.wgsl
//!include common/picture/vessel_rays.wgsl

/// Directions about the vertical in which light is followed back from the bench, and heights of the window, rad from its middle's: the root of their
/// mean square from the bench. Both ours.
const AZIMUTHS = 16u;
const HEIGHTS = array<f32, 2>(-0.2, 0.2);
/// The window is ((1 + cos φ)/2)¹⁶ wide: as a box of ±0.6 rad, its width seen from the bench, is in mean square. Where nothing is in the way,
/// even directions sum that without an error. This is its mean over all φ, (32 over 16)/4¹⁶.
const MEAN_OF_LOBE = 0.13995;
/// Half of how much further aside the next height comes to the surface, depths.
const SOONER = 0.19;
/// Mirrors at the wall: a third one sends on less than a tenth.
const MOST_WALLS = 3u;

/// Its nearer panes give more: across, the middle of their light upon a bench is at this share of the way from straight ahead to the window's own middle.
/// Over its width light falls as the fourth power of the distance, here 1.9 m.
const NEARER = 0.68;

/// Upward part of a vessel's axis from which on it counts as upright, and the height of its base over the bench, in outer radii, up to which all of its
/// light comes down through it and from which on none does. Ours.
const UPRIGHT = vec2<f32>(0.8, 0.95);
const LIFTED = vec2<f32>(0.1, 0.6);

/// How far a vessel stands on the bench, 0 to 1; `base` is the height of its base in the stage.
fn stands(vessel: u32, upright: f32, base: f32) -> f32 {
    let lifted = abs(base - frame.table_max.y) / frame.vessels[vessel].outer;
    return smoothstep(UPRIGHT.x, UPRIGHT.y, upright) * (1.0 - smoothstep(LIFTED.x, LIFTED.y, lifted));
}

/// Of length 1, towards the middle of the window's light.
fn middle_of_light(position: vec3<f32>) -> vec3<f32> {
    let to_window = WINDOW - position;
    return normalize(to_window - (1.0 - NEARER) * dot(to_window, WINDOW_ACROSS) * WINDOW_ACROSS);
}

/// The share of the window's light upon an open bench that comes to `foot`, a place of the inner floor, under liquid of that depth; all in the upright
/// vessel's frame. `to_window` is of length 1.
fn window_under(vessel: u32, foot: vec2<f32>, depth: f32, index: f32, to_window: vec3<f32>) -> f32 {
    let radius = vessel_radius(vessel, frame.vessels[vessel].inner_floor + 0.5 * depth);
    let home = to_window.xz / max(length(to_window.xz), 1e-6);
    let start = foot * min(1.0, 0.999 * radius / max(length(foot), 1e-9));
    let middle = asin(saturate(to_window.y));
    var sum = 0.0;
    for (var n = 0u; n < AZIMUTHS * 2u; n++) {
        let turn = 6.2831853 * (f32(n / 2u) + 0.5) / f32(AZIMUTHS);
        // Snell's law at the surface and, of a flat base, at the floor.
        let sine = cos(middle + HEIGHTS[n % 2u]) / index;
        var left = depth * sine * inverseSqrt(1.0 - sine * sine);
        var way = vec2<f32>(cos(turn), sin(turn));
        var at = start;
        var open = 1.0;
        for (var wall = 0u; wall <= MOST_WALLS; wall++) {
            let along = dot(at, way);
            let chord = sqrt(max(along * along - dot(at, at) + radius * radius, 0.0)) - along;
            // Each height stands for those about it, which come to the surface sooner and later.
            let arrives = select(smoothstep(-SOONER * depth, SOONER * depth, chord - left), 1.0, wall == MOST_WALLS);
            let lobe = 0.5 + 0.5 * dot(way, home);
            let squared = lobe * lobe;
            let fourth = squared * squared;
            let eighth = fourth * fourth;
            sum += open * arrives * eighth * eighth;
            // What the wall lets out has come in there from below, and not from the window.
            let facing = sine * dot(way, at + chord * way) / radius;
            open *= select(0.0, 1.0 - arrives, (1.0 - facing * facing) * index * index > 1.0);
            if (open == 0.0) { break; }
            at += chord * way;
            left -= chord;
            way = reflect(way, at / radius);
        }
    }
    // It goes through two faces, at angles of which each is the other's by Snell's law.
    let passes = 1.0 - fresnel(to_window.y, index);
    return passes * passes * sum / (2.0 * f32(AZIMUTHS) * MEAN_OF_LOBE);
}
