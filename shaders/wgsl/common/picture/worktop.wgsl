//! What belongs to the bench where vessels stand: a sink let into its top and a tray on it, both along its far edge, and a tap; and hot plates.
//!
//! They are only seen. The solver's bench is flat: liquid that is spilt would lie over the sink and in the tray's walls, so both are kept
//! away from where vessels, tools and hands are in any scene, and a bench smaller than `LEAST_BENCH` has neither. A hot plate is flush
//! with the bench, so vessels and liquid on it are as high as the solver has them.

//!include common/picture/sight.wgsl

/// Width and depth of a bench that has sink and tray, m, nearly.
const LEAST_BENCH = vec2<f32>(1.15, 0.65);
/// Places (x, z) and sizes from the far right corner for the sink, and from the far left one for the tray, m.
const SINK_FROM_CORNER = vec2<f32>(0.37, 0.055);
const SINK_SIZE = vec2<f32>(0.30, 0.16);
const SINK_DEPTH = 0.15;
const SINK_RIM = 0.010;
const TRAY_FROM_CORNER = vec2<f32>(0.06, 0.07);
const TRAY_SIZE = vec2<f32>(0.34, 0.135);
const TRAY_HEIGHT = 0.018;
const TRAY_WALL = 0.004;
/// How far about it the tray keeps light away, m.
const TRAY_SHADOW = 0.08;
/// The tap's.
const TAP_RADIUS = 0.0095;
const BASIN = vec3<f32>(0.23, 0.235, 0.24);
const TRAY = vec3<f32>(0.66, 0.67, 0.68);
const CHROME = vec3<f32>(0.50, 0.51, 0.52);
/// A hot plate: how wide its rim is, how far from its edge towards the user the lamp is that shines while it is hot, and the lamp's radius, m.
const PLATE_RIM = 0.003;
const PLATE_LAMP = 0.011;
const PLATE_LAMP_RADIUS = 0.0025;
const CERAMIC = vec3<f32>(0.030, 0.029, 0.030);
const PLATE_LAMP_LIGHT = vec3<f32>(0.90, 0.04, 0.03);

/// The bench's surface where hot plates are let into it.
struct Top {
    albedo: vec3<f32>,
    /// What it shines by itself.
    glow: vec3<f32>,
}

/// How much of a pixel is in a disc; of one that is smaller than a pixel no more than it fills. `apart` is the way to its middle.
fn in_disc(apart: f32, radius: f32, sharp: f32) -> f32 {
    return saturate((radius - apart) * sharp + 0.5) * min(2.0 * radius * sharp, 1.0);
}

/// The surface at a place (x, z) of the bench, m, which is `plain` beside the plates; `sharp` is one over a pixel's width.
fn top_at(at: vec2<f32>, sharp: f32, plain: vec3<f32>) -> Top {
    var top = Top(plain, vec3<f32>(0.0));
    for (var n = 0u; n < 8u; n++) {
        let plate = frame.plates[n].xyz * frame.metres_per_unit;
        if (plate.z <= 0.0) { break; }
        let from_middle = at - plate.xy;
        let apart = length(from_middle);
        let rim = in_disc(apart, plate.z, sharp);
        if (rim == 0.0) { continue; }
        let ceramic = in_disc(apart, plate.z - PLATE_RIM, sharp);
        let lamp = in_disc(distance(from_middle, vec2<f32>(0.0, plate.z - PLATE_LAMP)), PLATE_LAMP_RADIUS, sharp);
        top.albedo = mix(mix(top.albedo, CHROME, rim), CERAMIC, ceramic);
        top.glow = mix(top.glow, lamp * PLATE_LAMP_LIGHT, rim);
    }
    return top;
}

fn has_fittings() -> bool {
    let size = (frame.table_max - frame.table_min).xz * frame.metres_per_unit;
    return frame.furnished != 0u && all(size > LEAST_BENCH);
}

/// The sink's light where a ray goes down through the opening at `at`; its low corner (x, z) is `low`.
fn basin_light(ray: Sight, at: vec3<f32>, low: vec2<f32>, sharp: f32) -> vec3<f32> {
    let bottom = vec3<f32>(low.x, at.y - SINK_DEPTH, low.y);
    let leaves = out_of_box(ray, at, bottom, vec3<f32>(low.x + SINK_SIZE.x, at.y, low.y + SINK_SIZE.y));
    let place = at + leaves.w * ray.direction;
    let under = at.y - place.y;
    let inside = place - bottom;
    let beside = min(inside, vec3<f32>(SINK_SIZE.x, 9.0, SINK_SIZE.y) - inside) + 9.0 * abs(leaves.xyz);
    let corner = min(beside.x, min(beside.y, beside.z)) / 0.03;
    let open = (0.95 - 4.0 * under) * (1.0 - 0.45 / (1.0 + corner * corner));
    let key = key_light(place);
    // The window's light comes in under its angle.
    let shaded = saturate(1.0 - under * abs(key.direction.x) / (key.direction.y * max(inside.x, 0.004)));
    let drain = length(place.xz - low - 0.5 * SINK_SIZE);
    var albedo = BASIN;
    if (leaves.y > 0.5) {
        albedo = mix(albedo, 2.2 * BASIN, saturate((0.026 - drain) * sharp + 0.5));
        albedo = mix(albedo, vec3<f32>(0.01), saturate((0.019 - drain) * sharp + 0.5));
    }
    return albedo * (open * ambient_light(0.4 + 0.6 * leaves.y) + shaded * max(dot(leaves.xyz, key.direction), 0.0) * key.light);
}

/// The light of the bench's top at `at`, with sink and tray in it or on it; without them it would be `plain`. `share` of the sky's (x) and the window's (y)
/// light comes there.
fn fitted(ray: Sight, at: vec3<f32>, sharp: f32, plain: vec3<f32>, share: vec2<f32>) -> vec3<f32> {
    let low = frame.table_min * frame.metres_per_unit;
    let high = frame.table_max * frame.metres_per_unit;
    let up = vec3<f32>(0.0, 1.0, 0.0);
    var light = plain;
    let sink = vec2<f32>(high.x, low.z) + vec2<f32>(-SINK_FROM_CORNER.x, SINK_FROM_CORNER.y);
    let rim = in_rectangle(at.xz, sink - SINK_RIM, sink + SINK_SIZE + SINK_RIM, sharp);
    if (rim > 0.0) {
        let open = in_rectangle(at.xz, sink, sink + SINK_SIZE, sharp);
        light = mix(light, 1.25 * lit(CHROME, at, up, 1.0), rim);
        if (open > 0.0) { light = mix(light, basin_light(ray, at, sink, sharp), open); }
    }
    let tray = low.xz + TRAY_FROM_CORNER;
    let middle = tray + 0.5 * TRAY_SIZE;
    let beside = abs(at.xz - middle) - 0.5 * TRAY_SIZE;
    if (max(beside.x, beside.y) < TRAY_SHADOW) {
        // Its shadow, which is darkest where it stands, and what of the window it hides.
        let near = length(max(beside, vec2<f32>(0.0))) / 0.012;
        let key = key_light(at);
        let through = abs(at.xz + key.direction.xz * (0.5 * TRAY_HEIGHT / key.direction.y) - middle) - 0.5 * TRAY_SIZE;
        let hidden = 1.0 - smoothstep(vec2<f32>(-0.008), vec2<f32>(0.008), through);
        light *= 1.0 - 0.40 / (1.0 + near * near) - 0.30 * hidden.x * hidden.y;
        // The ray is above the rim's plane there:
        let over = at + (TRAY_HEIGHT / ray.direction.y) * ray.direction;
        let side = in_rectangle(at.xz, tray, tray + TRAY_SIZE, sharp);
        let top = in_rectangle(over.xz, tray, tray + TRAY_SIZE, sharp);
        let enters = abs(over.xz - middle) - 0.5 * TRAY_SIZE;
        let normal = select(vec3<f32>(0.0, 0.0, 1.0), vec3<f32>(-sign(ray.direction.x), 0.0, 0.0), enters.x > enters.y);
        light = mix(light, lit(0.8 * TRAY, at, normal, 0.8), side);
        light = mix(light, lit(1.1 * TRAY, over, up, 1.0), top);
        let inner = in_rectangle(over.xz, tray + TRAY_WALL, tray + TRAY_SIZE - TRAY_WALL, sharp);
        if (inner > 0.0) {
            let bottom = vec3<f32>(tray.x + TRAY_WALL, at.y + 0.002, tray.y + TRAY_WALL);
            let end = vec3<f32>(tray.x + TRAY_SIZE.x - TRAY_WALL, over.y, tray.y + TRAY_SIZE.y - TRAY_WALL);
            let leaves = out_of_box(ray, over, bottom, end);
            let place = over + leaves.w * ray.direction;
            let corner = min(place.xz - bottom.xz, end.xz - place.xz) + 9.0 * abs(leaves.xz);
            let shade = min(corner.x, corner.y) / 0.010;
            light = mix(light, lit(TRAY, place, leaves.xyz, 0.92 - 0.35 / (1.0 + shade * shade)) * mix(1.0, share.y, 0.5), inner);
        }
    }
    return light;
}

/// How near a ray passes to a straight piece of tube.
struct Pass {
    /// Distance over the tube's radius.
    out: f32,
    way: f32,
    /// From the tube's axis to the ray.
    miss: vec3<f32>,
}

fn passes(ray: Sight, from_: vec3<f32>, to: vec3<f32>, radius: f32) -> Pass {
    let axis = to - from_;
    let aside = ray.origin - from_;
    let a = dot(ray.direction, ray.direction);
    let b = dot(ray.direction, axis);
    let c = dot(axis, axis);
    let d = dot(ray.direction, aside);
    let e = dot(axis, aside);
    let along = saturate((a * e - b * d) / max(a * c - b * b, 1e-9));
    let way = (b * along - d) / a;
    let miss = aside + way * ray.direction - along * axis;
    return Pass(length(miss) / radius, way, miss);
}

fn nearer(a: Pass, b: Pass) -> Pass {
    if (a.out < b.out) { return a; }
    return b;
}

/// What of a ray's pixel the tap takes, and its light there.
struct Metal {
    share: f32,
    way: f32,
    light: vec3<f32>,
}

/// The tap behind the sink, where it is nearer than `end`.
fn tap(ray: Sight, end: f32) -> Metal {
    let none = Metal(0.0, end, vec3<f32>(0.0));
    let low = frame.table_min * frame.metres_per_unit;
    let high = frame.table_max * frame.metres_per_unit;
    let foot = vec3<f32>(high.x - SINK_FROM_CORNER.x + 0.5 * SINK_SIZE.x, high.y, low.z + 0.025);
    // Most rays pass beside it. From its side, where they hardly get on along z, all are looked at.
    let slant = ray.inverse.z * ray.direction.xy;
    let apart = ray.origin.xy + (foot.z + 0.05 - ray.origin.z) * slant - foot.xy - vec2<f32>(0.0, 0.125);
    if (any(abs(apart) > vec2<f32>(0.02, 0.15) + 0.07 * abs(slant))) { return none; }
    let bend = foot + vec3<f32>(0.0, 0.235, 0.0);
    let end_ = foot + vec3<f32>(0.0, 0.245, 0.105);
    var met = nearer(
        passes(ray, foot, bend, TAP_RADIUS),
        nearer(passes(ray, bend, end_, TAP_RADIUS), passes(ray, end_, end_ - vec3<f32>(0.0, 0.045, 0.0), TAP_RADIUS)),
    );
    let sharp = 1.0 / max(met.way * ray.fine, 1e-6);
    let share = saturate((1.0 - met.out) * TAP_RADIUS * sharp + 0.5);
    if (share == 0.0 || met.way <= 0.0 || met.way > end) { return none; }
    let out = min(met.out, 1.0);
    let along = ray.direction * inverseSqrt(dot(ray.direction, ray.direction));
    let normal = normalize(met.miss) * out - along * sqrt(max(1.0 - out * out, 0.0));
    // Chrome: bright or dark by where what it mirrors is.
    let mirrored = reflect(along, normal);
    let key = key_light(ray.origin + met.way * ray.direction);
    let band = 0.35 + 0.65 * smoothstep(-0.25, 0.35, mirrored.y);
    let light = 1.6 * CHROME * band * ambient_light(mirrored.y) + smoothstep(0.75, 0.95, dot(mirrored, key.direction)) * key.light;
    return Metal(share, met.way, light);
}
