//! The liquid's light: what it mirrors, and what is seen through it, refracted in the world
//! and traced against the vessel and the room. Nothing is looked up beside the pixel, so both
//! eyes see the same things in the same places.

//!include common/picture/pixel_blocks.wgsl
//!include common/picture/room.wgsl
//!include common/picture/vessel_rays.wgsl

/// Filtered reversed depth, 0 where there is no liquid.
@group(0) @binding(2) var<storage, read> surface: array<f32>;
/// Thickness and acid of each block, as `fluid/thickness.wgsl` adds them up.
@group(0) @binding(3) var<storage, read> sums: array<vec2<u32>>;

/// Refractive index of water at 20 °C (1.333; sulfuric acid of 98 % has 1.43).
const INDEX = 1.333;
/// ((n − 1) / (n + 1))².
const NORMAL_REFLECTANCE = 0.02037;

/// What is seen at a pixel, from the eye; zero where there is no liquid.
fn seen_at(pixel: vec2<i32>, eye: u32) -> vec4<f32> {
    let at = within_picture(pixel);
    let reversed = surface[pixel_index(at, eye)];
    let depth = select(0.0, frame.views[eye].near / reversed, reversed > 0.0);
    return vec4<f32>(depth * seen_along(eye, vec2<f32>(at) + 0.5), depth);
}

/// The tangent from the pair of neighbours, of which the one nearer in depth counts.
fn tangent(before: vec4<f32>, here: vec4<f32>, after: vec4<f32>) -> vec3<f32> {
    let back = select(1e9, abs(here.w - before.w), before.w > 0.0);
    let forth = select(1e9, abs(here.w - after.w), after.w > 0.0);
    // Both, where they agree: a difference over two pixels is quieter.
    if max(back, forth) < 2.0 * min(back, forth) + 0.1 * frame.spacing { return after.xyz - before.xyz; }
    return select(after.xyz - here.xyz, here.xyz - before.xyz, back < forth);
}

fn normal_at(pixel: vec2<i32>, eye: u32, here: vec4<f32>) -> vec3<f32> {
    // Over a fifth of a spacing, if that is more than a pixel: a picture of more pixels has no
    // more of the surface, only more of the filter's grain.
    let step = clamp(i32(0.2 * frame.spacing * frame.views[eye].focal / here.w), 1, 4);
    let aside = vec2<i32>(step, 0);
    let along = vec2<i32>(0, step);
    let x = tangent(seen_at(pixel - aside, eye), here, seen_at(pixel + aside, eye));
    let y = tangent(seen_at(pixel - along, eye), here, seen_at(pixel + along, eye));
    let n = cross(y, x);
    let facing = -normalize(here.xyz);
    let towards = n * select(-1.0, 1.0, dot(n, facing) > 0.0);
    return select(facing, normalize(towards), dot(n, n) > 0.0);
}

/// Thickness (in the scene's unit) and its part that is acid, over some four by four blocks between which it is
/// interpolated: finer than that is the grain of particles.
fn thickness_at(place: vec2<f32>, eye: u32) -> vec2<f32> {
    let at = 0.5 * place - 0.5;
    let first = vec2<i32>(floor(at)) - 1;
    let share = fract(at);
    let last = vec2<i32>(blocks()) - 1;
    var sum = vec2<f32>(0.0);
    for (var y = 0; y < 4; y++) {
        for (var x = 0; x < 4; x++) {
            let block = clamp(first + vec2<i32>(x, y), vec2<i32>(0), last);
            // Linear between blocks, at a block to either side.
            let odd = vec2<bool>((x & 1) == 1, (y & 1) == 1);
            let weight = select(1.0 - share, share, odd);
            sum += weight.x * weight.y * vec2<f32>(sums[block_index(block, eye)]);
        }
    }
    return (0.25 * frame.spacing / PARTS) * sum;
}

/// What light a ray of liquid carries to the eye: that which comes from `origin` along `direction`,
/// times `kept`, and `mirrored`.
struct Wet {
    origin: vec3<f32>,
    direction: vec3<f32>,
    kept: vec3<f32>,
    mirrored: vec3<f32>,
}

/// The liquid at a pixel; `here` is `seen_at` of it, of view depth above 0.
fn liquid_at(pixel: vec2<i32>, eye: u32, here: vec4<f32>) -> Wet {
    let slant = length(here.xyz) / here.w;
    let ray = here.xyz / (slant * here.w);
    let point = frame.views[eye].eye + here.xyz;
    let thickness = thickness_at(vec2<f32>(pixel) + 0.5, eye);
    let acid = saturate(thickness.y / max(thickness.x, 1e-9));
    let path = slant * thickness.x;
    var normal = normal_at(pixel, eye, here);

    let vessel = vessel_around(point);
    var wetted = 0.0;
    var exit = point;
    var out = refract(ray, normal, 1.0 / INDEX);
    if vessel < frame.blocker_count {
        let m = frame.vessels[vessel].vessel_from_stage;
        let p = (m * vec4<f32>(point, 1.0)).xyz;
        let stage_from_vessel = transpose(mat3x3<f32>(m[0].xyz, m[1].xyz, m[2].xyz));
        let wall = -(stage_from_vessel * inward(vessel, p));
        let gap = vessel_radius(vessel, p.y) - length(p.xz);
        // Liquid that wets the glass has the glass's own surface.
        wetted = smoothstep(0.8, 0.3, gap / frame.spacing) * smoothstep(0.0, 0.05, dot(wall, -ray));
        normal = normalize(mix(normal, wall, wetted));
        let within = refract(ray, normal, 1.0 / INDEX);
        let direction = (m * vec4<f32>(within, 0.0)).xyz;
        let reach = to_glass(vessel, p, direction);
        let way = min(reach.x, reach.y);
        let met = p + way * direction;
        exit = point + way * within;
        out = within;
        if reach.x < reach.y {
            let back = stage_from_vessel * inward(vessel, met);
            let through = refract(within, back, INDEX);
            out = select(reflect(within, back), through, dot(through, through) > 0.0);
        }
    }
    let kept = exp(-path * frame.metres_per_unit * mix(frame.water, frame.acid, acid));
    let rest = 1.0 - saturate(dot(normal, -ray));
    let mirrored = NORMAL_REFLECTANCE + (1.0 - NORMAL_REFLECTANCE) * rest * rest * rest * rest * rest;
    // An edge thinner than a drop is none that could mirror.
    let reflectance = mirrored * (1.0 - wetted) * saturate(path / frame.spacing);
    return Wet(exit, out, (1.0 - reflectance) * kept, reflectance * surroundings(reflect(ray, normal)));
}
