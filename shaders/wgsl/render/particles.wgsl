//! Particles as lit spheres, one covering triangle each.
//!
//! Bounds. For a sphere of radius r whose centre lies d from the eye, κ = r/d, the lines from the
//! eye that touch it touch it on a circle in the plane that stands on the line of centres at
//! d(1 − κ²) from the eye, with radius r√(1 − κ²). A triangle around that circle, in that plane,
//! covers the silhouette exactly, whatever the frustum: no axis-aligned bounds in clip space,
//! which asymmetric frusta and the picture's edge make error-prone.
//!
//! Hit. With ρ ≤ 1 the distance from the circle's centre in its radii and q = √(1 − ρ²), the ray
//! through a point p of that plane (from the eye) enters the sphere at p / (1 + κq): put p into
//! |tp − c|² = r² and the discriminant is a square. So reversed depth, near / z, is the plane's
//! times (1 + κq); and the normal, in the frame of the plane's axes and the line to the eye, is
//! (√(1 − κ²)·(u, v), q + κ) / (1 + κq). No square root but q, no division but one.

//!include common/frame.wgsl
//!include common/daylight.wgsl

struct ParticleDraw {
    /// Radius as drawn, in the scene's unit.
    radius: f32,
    /// What colours stand for: 0 speed, 1 temperature, 2 acid.
    colour_by: u32,
    /// The attribute's value where the colour map starts, and one over the way to its end.
    start: f32,
    inverse_range: f32,
}

var<immediate> particles: ParticleDraw;

/// Position in the stage; w < 0 marks a particle that was taken out.
@group(0) @binding(1) var<storage, read> positions: array<vec4<f32>>;
/// Velocity, in the scene's unit per second; or temperature (°C) and acid fraction in x and y.
@group(0) @binding(2) var<storage, read> attributes: array<vec4<f32>>;

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    /// u, v in the plane; the parts of up along the second axis and towards the eye.
    @location(0) plane: vec4<f32>,
    /// Colour, and κ.
    @location(1) @interpolate(flat) colour: vec4<f32>,
    /// Towards the window, in the sphere's frame.
    @location(2) @interpolate(flat) window: vec4<f32>,
}

/// Corners of an equilateral triangle around the unit circle.
const CORNERS = array<vec2<f32>, 3>(
    vec2<f32>(0.0, 2.0),
    vec2<f32>(-1.7320508, -1.0),
    vec2<f32>(1.7320508, -1.0),
);

/// Outside the frustum: a triangle of three of these is dropped.
const NOWHERE = vec4<f32>(2.0, 2.0, 2.0, 1.0);

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(view_index) eye: u32) -> Varyings {
    var out: Varyings;
    out.clip = NOWHERE;
    let particle = positions[index / 3u];
    let from_eye = particle.xyz - frame.views[eye].eye;
    let distance_squared = dot(from_eye, from_eye);
    let radius = particles.radius;
    // With the eye in the sphere nothing of it is seen. The comparisons fail for NaN and for
    // what lies absurdly far.
    if particle.w < 0.0 || !(distance_squared > radius * radius && distance_squared < 1e12) {
        return out;
    }
    let inverse_distance = inverseSqrt(distance_squared);
    let kappa = radius * inverse_distance;
    let shrink = 1.0 - kappa * kappa;
    let to_eye = -inverse_distance * from_eye;
    // Any right angle to `to_eye` would do; up is kept in the plane of the last two axes, so
    // that it needs two numbers. Seen from straight above, z serves.
    let across = cross(vec3<f32>(0.0, 1.0, 0.0), to_eye);
    let across_squared = dot(across, across);
    let x_axis = select(
        vec3<f32>(0.0, 0.0, 1.0),
        across * inverseSqrt(across_squared),
        across_squared > 1e-12,
    );
    let y_axis = cross(to_eye, x_axis);

    let corner = CORNERS[index % 3u];
    let circle = radius * sqrt(shrink);
    let point = frame.views[eye].eye + from_eye * shrink
        + circle * (corner.x * x_axis + corner.y * y_axis);
    out.clip = frame.views[eye].clip_from_stage * vec4<f32>(point, 1.0);
    out.plane = vec4<f32>(corner, y_axis.y, to_eye.y);

    let values = attributes[index / 3u];
    var value = values.x;
    if particles.colour_by == 0u { value = length(values.xyz); }
    if particles.colour_by == 2u { value = values.y; }
    let place = clamp((value - particles.start) * particles.inverse_range, 0.0, 1.0) * 16.0;
    let entry = min(u32(place), 15u);
    let colour = mix(
        frame.colour_map[entry].rgb,
        frame.colour_map[entry + 1u].rgb,
        place - f32(entry),
    );
    out.colour = vec4<f32>(colour, kappa);
    let key = key_light(particle.xyz * frame.metres_per_unit);
    out.window = vec4<f32>(
        dot(key.direction, x_axis),
        dot(key.direction, y_axis),
        dot(key.direction, to_eye),
        key.light.g,
    );
    return out;
}

struct Pixel {
    @location(0) colour: vec4<f32>,
    @builtin(frag_depth) depth: f32,
}

@fragment
fn fragment(in: Varyings) -> Pixel {
    let q_squared = 1.0 - dot(in.plane.xy, in.plane.xy);
    if q_squared < 0.0 {
        discard;
    }
    let q = sqrt(q_squared);
    let kappa = in.colour.a;
    let nearer = 1.0 + kappa * q;
    let normal = vec3<f32>(in.plane.xy * sqrt(1.0 - kappa * kappa), q + kappa) / nearer;

    let window = in.window.xyz;
    let up = dot(normal.yz, in.plane.zw);
    let diffuse = max(dot(normal, window), 0.0) * in.window.w;
    // Blinn's half vector with the eye straight ahead: across one particle it hardly turns.
    let half_vector = window + vec3<f32>(0.0, 0.0, 1.0);
    let shine = max(dot(normal, half_vector) * inverseSqrt(dot(half_vector, half_vector)), 0.0);
    // Wide and faint: a sphere is a few pixels across, and a sharp highlight would glitter.
    let highlight = pow(shine, 14.0);
    let light = in.colour.rgb * (ambient_light(up) + diffuse) + 0.12 * highlight * in.window.w;
    return Pixel(vec4<f32>(display(light), 1.0), in.clip.z * nearer);
}
