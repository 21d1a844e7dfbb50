//! Rays among the room's flat things, and edges that are as soft as a pixel is wide, so that nothing far away shimmers.

//!include common/maths/lot.wgsl
//!include common/picture/daylight.wgsl
//!include common/picture/frame.wgsl

/// A ray in metres.
struct Sight {
    origin: vec3<f32>,
    direction: vec3<f32>,
    inverse: vec3<f32>,
    /// A pixel's width over the way along the ray.
    fine: f32,
}

/// What of a rectangle the ray's pixel sees.
struct Layer {
    /// The share of the pixel, 0 to 1.
    share: f32,
    /// In lengths of the ray's direction.
    way: f32,
    /// Where the ray meets its plane.
    at: vec3<f32>,
    /// One over a pixel's width there, 1/m.
    sharp: f32,
}

/// `slant` says how much wider than across the ray a pixel is along the rectangle's sides. Each side's ends are as soft as that side is seen: where a plane is
/// seen along one side, the other one's ends stay sharp.
fn rectangle(way: f32, at: vec3<f32>, place: vec2<f32>, low: vec2<f32>, high: vec2<f32>, fine: f32, slant: vec2<f32>) -> Layer {
    let sharp = 1.0 / max(way * fine * (1.0 + abs(slant)), vec2<f32>(1e-6));
    // Less than a pixel wide it fills no more of it: seen along its plane it would be half of one wherever the plane is.
    let edge = saturate(min(place - low, high - place) * sharp + 0.5) * saturate((high - low) * sharp);
    return Layer(select(0.0, edge.x * edge.y, way > 0.0), way, at, min(sharp.x, sharp.y));
}

/// A rectangle in the plane of that z; corners (x, y).
fn on_z(ray: Sight, z: f32, low: vec2<f32>, high: vec2<f32>) -> Layer {
    let way = (z - ray.origin.z) * ray.inverse.z;
    let at = ray.origin + way * ray.direction;
    return rectangle(way, at, at.xy, low, high, ray.fine, ray.direction.xy * ray.inverse.z);
}

/// A rectangle in the plane of that x; corners (y, z).
fn on_x(ray: Sight, x: f32, low: vec2<f32>, high: vec2<f32>) -> Layer {
    let way = (x - ray.origin.x) * ray.inverse.x;
    let at = ray.origin + way * ray.direction;
    return rectangle(way, at, at.yz, low, high, ray.fine, ray.direction.yz * ray.inverse.x);
}

/// A rectangle in the plane of that y; corners (x, z).
fn on_y(ray: Sight, y: f32, low: vec2<f32>, high: vec2<f32>) -> Layer {
    let way = (y - ray.origin.y) * ray.inverse.y;
    let at = ray.origin + way * ray.direction;
    return rectangle(way, at, at.xz, low, high, ray.fine, ray.direction.xz * ray.inverse.y);
}

/// How much of a pixel is in the rectangle; `sharp` is one over its width.
fn in_rectangle(place: vec2<f32>, low: vec2<f32>, high: vec2<f32>, sharp: f32) -> f32 {
    let edge = saturate(min(place - low, high - place) * sharp + 0.5);
    return edge.x * edge.y;
}

/// How much of a pixel is in lines of that width, so many a metre; from far, their mean.
fn lines(x: f32, a_metre: f32, width: f32, sharp: f32) -> f32 {
    let apart = abs(fract(x * a_metre + 0.5) - 0.5);
    let pixels = sharp / a_metre;
    let cover = saturate((0.5 * width * sharp - apart * pixels) + 0.5) * min(1.0, width * sharp);
    return mix(width * a_metre, cover, saturate(0.4 * pixels - 0.6));
}

/// What a surface sends back, of which `open` of the hemisphere is open.
fn lit(albedo: vec3<f32>, at: vec3<f32>, normal: vec3<f32>, open: f32) -> vec3<f32> {
    let key = key_light(at);
    return albedo * (open * ambient_light(normal.y) + max(dot(normal, key.direction), 0.0) * key.light);
}

/// The way from within a box to where the ray leaves it (w), and the normal there, inwards.
fn out_of_box(ray: Sight, origin: vec3<f32>, low: vec3<f32>, high: vec3<f32>) -> vec4<f32> {
    let ways = (select(low, high, ray.direction > vec3<f32>(0.0)) - origin) * ray.inverse;
    let way = min(ways.x, min(ways.y, ways.z));
    return vec4<f32>(-sign(ray.direction) * select(vec3<f32>(0.0), vec3<f32>(1.0), ways <= vec3<f32>(way)), max(way, 0.0));
}
