//! The light of the drops of spray, once the nearest at each pixel is known: balls of water, which mirror the room and show it upside down.

//!include common/picture/fresnel.wgsl
//!include common/picture/packed_light.wgsl
//!include common/picture/room.wgsl
//!include common/picture/spray_drops.wgsl
//!include common/picture/tile_pixels.wgsl

@group(0) @binding(2) var<storage, read> flights: array<Flight>;
/// Its number and one more; its light when this is done.
@group(0) @binding(3) var<storage, read_write> nearest: array<u32>;

/// Refractive index of water at 20 °C.
const DROP_INDEX = 1.333;
/// The way through liquid of which a drop has the tint, m: that of the legend, as in `render/src/tints.rs`. By its own width acid could not
/// be told from water.
const LEGEND_PATH = 0.06;
/// Places in a pixel at which a drop is seen.
const DROP_TAPS = array<vec2<f32>, 4>(
    vec2<f32>(-0.25, -0.25), vec2<f32>(0.25, -0.25), vec2<f32>(-0.25, 0.25), vec2<f32>(0.25, 0.25));

/// What a ray brings that meets a drop where its outward normal is `normal`: mirrored, and through both faces, between which the share `kept`
/// is let through.
fn drop_light(centre: vec3<f32>, ray: vec3<f32>, normal: vec3<f32>, kept: vec3<f32>) -> vec3<f32> {
    let mirrors = fresnel(saturate(-dot(ray, normal)), DROP_INDEX);
    let within = refract(ray, normal, 1.0 / DROP_INDEX);
    let out = normal - 2.0 * dot(within, normal) * within;
    let through = refract(within, -out, DROP_INDEX);
    let passed = kept * (1.0 - mirrors) * (1.0 - mirrors) * mirrored_light(centre, through);
    return passed + mirrors * mirrored_light(centre, reflect(ray, normal));
}

@compute @workgroup_size(32, 8)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_id) local: vec3<u32>) {
    let place = place_of(group, local);
    if (!place.inside) { return; }
    let index = pixel_index(place.pixel, place.eye);
    let found = nearest[index];
    if (found == 0u) { return; }
    let number = (found - 1u) / MOST_DROPS;
    let flight = flights[number];
    let centre = drop_place(flight, number, (found - 1u) % MOST_DROPS);
    let view = &frame.views[place.eye];
    let depth = ((*view).clip_from_stage * vec4<f32>(centre, 1.0)).w;
    let drawn = drawn_drop(flight.radius, depth, (*view).focal);
    let kept = exp(-LEGEND_PATH * mix(frame.water, frame.acid, flight.acid));
    var light = vec3<f32>(0.0);
    for (var n = 0u; n < 4u; n++) {
        let ray = normalize(seen_along(place.eye, vec2<f32>(place.pixel) + 0.5 + DROP_TAPS[n]));
        let to_centre = centre - (*view).eye;
        let miss = (dot(to_centre, ray) * ray - to_centre) / drawn.x;
        // Beside it, what is at its edge.
        let aside = miss * min(1.0, 0.98 / max(length(miss), 1e-6));
        let normal = aside - sqrt(max(1.0 - dot(aside, aside), 0.0)) * ray;
        light += 0.25 * drop_light(centre, ray, normalize(normal), kept);
    }
    nearest[index] = packed_share(display(light), drawn.y);
}
