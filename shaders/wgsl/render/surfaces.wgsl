//! Bench, floor and walls in daylight, with the soft shadows of the vessels.

//!include common/frame.wgsl
//!include common/mesh.wgsl
//!include common/daylight.wgsl

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) @interpolate(flat) material: u32,
}

const MATERIAL_TABLE = 0u;
const MATERIAL_FLOOR = 1u;

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(view_index) eye: u32) -> Varyings {
    let corner = vertices[index];
    return Varyings(
        frame.views[eye].clip_from_stage * vec4<f32>(corner.position, 1.0),
        corner.position,
        corner.normal,
        corner.material,
    );
}

/// The share of the hemisphere's light (x) and of the window's (y) that reaches `position`.
fn shadow(position: vec3<f32>, normal: vec3<f32>, to_window: vec3<f32>) -> vec2<f32> {
    var share = vec2<f32>(1.0);
    for (var index = 0u; index < frame.blocker_count; index++) {
        let blocker = frame.blockers[index];
        let axis = blocker.top - blocker.foot;
        let from_foot = position - blocker.foot;
        let axis_squared = max(dot(axis, axis), 1e-12);
        let along_axis = dot(from_foot, axis);

        // Ambient: the nearest sphere of the capsule hides cosθ·(r/l)² of the hemisphere.
        let to_sphere = axis * saturate(along_axis / axis_squared) - from_foot;
        let gap = max(length(to_sphere), blocker.radius);
        let ratio = blocker.radius / gap;
        let hidden = saturate(dot(to_sphere, normal) / gap) * ratio * ratio;
        share.x *= 1.0 - 0.9 * hidden;

        // Window: the nearest approach of the ray to the axis, as an angle seen from here,
        // against a window about 0.2 rad across.
        let ray_foot = dot(from_foot, to_window);
        let ray_axis = dot(to_window, axis);
        let across = max(axis_squared - ray_axis * ray_axis, 1e-12);
        let on_axis = saturate((along_axis - ray_foot * ray_axis) / across);
        let on_ray = max(dot(blocker.foot + axis * on_axis - position, to_window), 1e-6);
        let miss = length(blocker.foot + axis * on_axis - position - to_window * on_ray);
        let open = smoothstep(-0.10, 0.10, (miss - blocker.radius) / on_ray);
        share.y *= 1.0 - blocker.opacity * (1.0 - open);
    }
    return share;
}

/// ±0.5 of an 8-bit step of the sRGB encoding, so that the walls' slow gradients do not band;
/// interleaved gradient noise (J. Jimenez, 2014).
fn dither(pixel: vec2<f32>, light: vec3<f32>) -> vec3<f32> {
    let noise = fract(52.9829189 * fract(dot(pixel, vec2<f32>(0.06711056, 0.00583715)))) - 0.5;
    // The encoding's slope, about 1 / (2√light).
    return light + noise * (2.0 / 255.0) * sqrt(light);
}

@fragment
fn fragment(in: Varyings) -> @location(0) vec4<f32> {
    let key = key_light(in.position * frame.metres_per_unit);
    var ambient = ambient_light(in.normal.y);
    var window = max(dot(in.normal, key.direction), 0.0) * key.light;
    var albedo = vec3<f32>(0.62, 0.60, 0.56);
    if in.material == MATERIAL_TABLE || in.material == MATERIAL_FLOOR {
        albedo = select(
            vec3<f32>(0.20, 0.19, 0.18),
            vec3<f32>(0.30, 0.33, 0.35),
            in.material == MATERIAL_TABLE,
        );
        let share = shadow(in.position, in.normal, key.direction);
        ambient *= share.x;
        window *= share.y;
    }
    let light = display(albedo * (ambient + window));
    return vec4<f32>(dither(in.clip.xy, light), 1.0);
}
