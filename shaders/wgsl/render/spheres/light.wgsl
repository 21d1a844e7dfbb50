//! The light of the coloured spheres, once the nearest at each pixel is known: their attribute's colour,
//! lit by the window and the room.

//!include common/chemistry/heat.wgsl
//!include common/picture/daylight.wgsl
//!include common/picture/packed_light.wgsl
//!include common/picture/tile_pixels.wgsl

struct SphereLight {
    /// Radius as drawn, in the scene's unit.
    radius: f32,
    /// What colours stand for: 0 speed, 1 temperature, 2 acid.
    colour_by: u32,
    /// The attribute's value where the colour map starts, and one over the way to its end.
    start: f32,
    inverse_range: f32,
}

var<immediate> spheres: SphereLight;

@group(0) @binding(2) var<storage, read> positions: array<vec4<f32>>;
/// The record `velocity`, in the scene's unit per second, or `heat`.
@group(0) @binding(3) var<storage, read> attributes: array<vec4<f32>>;
/// Reversed depth of the nearest sphere.
@group(0) @binding(4) var<storage, read> depths: array<f32>;
/// The nearest sphere's number and one more; its light when this is done.
@group(0) @binding(5) var<storage, read_write> nearest: array<u32>;

fn colour_of(particle: u32) -> vec3<f32> {
    let values = attributes[particle];
    var value = temperature_in(values);
    if (spheres.colour_by == 0u) { value = length(values.xyz); }
    if (spheres.colour_by == 2u) { value = acid_in(values); }
    let place = saturate((value - spheres.start) * spheres.inverse_range) * 16.0;
    let entry = min(u32(place), 15u);
    return mix(frame.colour_map[entry].rgb, frame.colour_map[entry + 1u].rgb, place - f32(entry));
}

@compute @workgroup_size(32, 8)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_id) local: vec3<u32>) {
    let place = place_of(group, local);
    if (!place.inside) { return; }
    let index = pixel_index(place.pixel, place.eye);
    let number = nearest[index];
    if (number == 0u) { return; }
    let particle = number - 1u;
    let centre = positions[particle].xyz;
    let view = &frame.views[place.eye];
    let way = (*view).near / depths[index];
    let at = (*view).eye + way * seen_along(place.eye, vec2<f32>(place.pixel) + 0.5);
    let normal = normalize(at - centre);
    let key = key_light(centre * frame.metres_per_unit);
    let diffuse = max(dot(normal, key.direction), 0.0) * key.light.g;
    // Blinn's half vector as at the sphere's middle: across one particle it hardly turns.
    let half_vector = normalize(key.direction + normalize((*view).eye - centre));
    // Wide and faint: a sphere is a few pixels across, and a sharp highlight would glitter.
    let highlight = pow(max(dot(normal, half_vector), 0.0), 14.0);
    let light = colour_of(particle) * (ambient_light(normal.y) + diffuse) + 0.12 * highlight * key.light.g;
    nearest[index] = packed(display(light));
}
