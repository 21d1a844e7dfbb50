//! The liquid's light: what it mirrors, and what is seen through it, refracted in the world
//! and traced against the vessel and the room. Beside the pixel only the acid where a ray turns and the liquid behind a wall are
//! looked up, at places in the stage, so both eyes see the same things in the same places.

//!include common/picture/fresnel.wgsl
//!include common/picture/liquid_way.wgsl
//!include common/picture/meniscus.wgsl
//!include common/picture/room.wgsl
//!include common/picture/schlieren.wgsl
//!include common/picture/thickness_sums.wgsl
//!include common/picture/through_wall.wgsl
//!include common/picture/under_vessel.wgsl
//!include common/picture/vessel_rays.wgsl

/// Filtered reversed depth, 0 where there is no liquid.
@group(0) @binding(2) var<storage, read> surface: array<f32>;

/// Share of the light upon many bubbles that they send on: they are clear.
const FOAM_WHITENESS = 0.85;

/// Where a point of the stage is seen (pixels), and its view depth.
fn pixel_of(point: vec3<f32>, eye: u32) -> vec3<f32> {
    let clip = frame.views[eye].clip_from_stage * vec4<f32>(point, 1.0);
    return vec3<f32>((0.5 + 0.5 * clip.xy / max(clip.w, 1e-9)) * frame.extent, clip.w);
}

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

/// What light a ray of liquid carries to the eye: that which comes from `origin` along `direction`,
/// times `kept`, and `mirrored`.
struct Wet {
    origin: vec3<f32>,
    direction: vec3<f32>,
    kept: vec3<f32>,
    mirrored: vec3<f32>,
    /// What it sees the bench through.
    through: Through,
}

/// How much further than a base's outer face what it shows is taken to be.
const BEHIND_FACE = 1.001;

/// How far off the glass particles are whole, spacings: they lie half of one from it.
const OFF_GLASS = 0.6;

/// Where a ray comes into liquid: through a vessel's wall or at the surface. From there on both are followed by the same code.
struct Entry {
    /// View depth; 0 where there is no liquid, negative behind a wall.
    depth: f32,
    /// Of the eye, of length 1.
    ray: vec3<f32>,
    /// The vessel, or `NO_VESSEL`.
    vessel: u32,
    /// Where the bent ray begins in the stage, in the vessel's frame, and along what.
    point: vec3<f32>,
    p: vec3<f32>,
    within: vec3<f32>,
    /// Share of acid that the eye's straight ray meets, and how far it is in liquid.
    acid: f32,
    straight: f32,
    /// The share of its way through the vessel that is in liquid.
    filled: f32,
    /// The surface's height, 1e9 where it is not known.
    level: f32,
    mixing: Striae,
    normal: vec3<f32>,
    /// The share of the light that the surface mirrors.
    reflectance: f32,
    foam: Foamed,
}

fn no_entry(point: vec3<f32>, ray: vec3<f32>) -> Entry {
    var entry: Entry;
    entry.ray = ray;
    entry.vessel = NO_VESSEL;
    entry.point = point;
    entry.level = 1e9;
    entry.foam = Foamed(point, vec3<f32>(0.0), 1.0, point, ray);
    return entry;
}

/// Through a vessel's wall, for a ray that comes out of its inside. There is liquid where the picture has it at that place, at the wall.
fn behind_wall(inside: Inside, eye: u32) -> Entry {
    var entry = no_entry(inside.point, inside.direction);
    let m = frame.vessels[inside.vessel].vessel_from_stage;
    let stage_from_vessel = transpose(mat3x3<f32>(m[0].xyz, m[1].xyz, m[2].xyz));
    entry.p = (m * vec4<f32>(inside.point, 1.0)).xyz;
    let inwards = select(inward(inside.vessel, entry.p), vec3<f32>(0.0, 1.0, 0.0), inside.base);
    // Down to the floor there is liquid where it is a spacing higher; nearer, particles are round.
    let lift = vec3<f32>(0.0, max(frame.spacing - entry.p.y + frame.vessels[inside.vessel].inner_floor, 0.0), 0.0);
    let lifted = pixel_of(inside.point + stage_from_vessel * lift, eye);
    let here = seen_at(vec2<i32>(floor(lifted.xy)), eye);
    // Over the base it is hidden by what the same vessel has in front of it. A ray that comes up through that is so flat that the surface
    // of shallow liquid mirrors it: it is in liquid as far as the wall.
    let hidden_by = select(frame.spacing, 2.0 * frame.vessels[inside.vessel].outer, inside.base);
    if (here.w <= 0.0 || here.w < lifted.z - hidden_by || here.w > lifted.z + frame.spacing) { return entry; }
    // How much there is is asked where particles are whole, too.
    let off = lift + OFF_GLASS * frame.spacing * inwards;
    let whole = inside.point + stage_from_vessel * off;
    let seen = pixel_of(whole, eye);
    let thickness = thickness_at(seen.xy, eye);
    entry.acid = saturate(thickness.y / max(thickness.x, 1e-9));
    let wall = -(stage_from_vessel * inwards);
    entry.within = refract(inside.direction, wall, GLASS_INDEX / index_of(entry.acid));
    // Glass as thick as that mirrors it.
    if (dot(entry.within, entry.within) == 0.0) { return entry; }
    entry.vessel = inside.vessel;
    let sight = whole - frame.views[eye].eye;
    entry.straight = length(sight) / seen.z * thickness.x;
    entry.filled = filled_along(inside.vessel, entry.p + off, (m * vec4<f32>(normalize(sight), 0.0)).xyz, entry.straight);
    entry.mixing = striae_at(seen.xy, eye, thickness, seen.z, entry.straight);
    // What the base shows is behind its outer face, which mirrors too.
    entry.depth = -select(pixel_of(inside.point, eye).z, BEHIND_FACE * inside.depth, inside.base);
    return entry;
}

/// The acid's share of sums of thickness, `otherwise` where they are too thin to tell.
fn share_of_acid(sums: vec2<f32>, otherwise: f32) -> f32 {
    return select(otherwise, saturate(sums.y / max(sums.x, 1e-9)), sums.x > frame.spacing);
}

/// The share of a way through a vessel that is in liquid, of which a ray that is not bent meets `straight`; p and direction in the vessel's frame.
fn filled_along(vessel: u32, p: vec3<f32>, direction: vec3<f32>, straight: f32) -> f32 {
    let reach = to_glass(vessel, p, direction);
    return saturate(straight / max(min(reach.x, reach.y), 1e-9));
}

/// What comes along a ray in a vessel's liquid.
fn followed(entry: Entry, eye: u32) -> Wet {
    let vessel = entry.vessel;
    let p = entry.p;
    let level = entry.level;
    let filled = entry.filled;
    let acid = entry.acid;
    let index = index_of(acid);
    let turn = turned_by(entry.mixing, entry.within, acid, index);
    // A ray that turns evenly comes out as one that turns half way.
    let aside = -0.5 * entry.mixing.way * turn;
    let begun = p + (frame.vessels[vessel].vessel_from_stage * vec4<f32>(aside, 0.0)).xyz;
    let way = way_through(vessel, entry.point + aside, begun, normalize(entry.within + turn), index, level);
    // The bent ray goes elsewhere: to where it first turns half of it is as there. From there on it is as where it comes out, or as there if
    // that is more: acid sinks, and the eye's rays to both places have come through what lies over it.
    let there = thickness_at(pixel_of(way.turned, eye).xy, eye);
    let deep = share_of_acid(there, acid);
    let mixed = 0.5 * (acid + deep);
    let deepest = max(deep, share_of_acid(thickness_at(pixel_of(way.exit, eye).xy, eye), deep));
    // What the bench under it sends back has come down through the liquid before. The vessel's y is up, or is not.
    let upright = saturate(frame.vessels[vessel].vessel_from_stage[1].y);
    let depth = select(0.0, upright * max(p.y - frame.vessels[vessel].inner_floor, 0.0), way.down);
    // A stream along a wall does not fill the vessel: mirrored at glass, a ray meets as much liquid as is seen where it first turns and at
    // the vessel's axis, there and back.
    let m = frame.vessels[vessel].vessel_from_stage;
    var later = filled * (way.length - way.first);
    if (later > there.x) {
        let q = (m * vec4<f32>(way.turned, 1.0)).xyz;
        let lift = max(frame.vessels[vessel].inner_floor + frame.spacing - q.y, 0.0);
        let middle = way.turned + vec3<f32>(-q.x, lift, -q.z) * mat3x3<f32>(m[0].xyz, m[1].xyz, m[2].xyz);
        later = min(later, there.x + 2.0 * thickness_at(pixel_of(middle, eye).xy, eye).x);
    }
    let first = filled * way.first * mix(frame.water, frame.acid, mixed);
    let kept = exp(-frame.metres_per_unit * (first + (filled * depth + later) * mix(frame.water, frame.acid, deepest)));
    if (way.lost) {
        let all_about = ambient_light(0.0) + 0.5 * key_light(way.exit * frame.metres_per_unit).light;
        return Wet(way.exit, way.out, vec3<f32>(0.0), FOAM_WHITENESS * kept * all_about, Through(NO_VESSEL, 1.0));
    }
    // Beside its foot the bench is in the vessel's shadow, as for all others.
    var through = Through(select(NO_VESSEL, vessel, way.down), 1.0);
    if (depth > 0.0) {
        let foot = (m * vec4<f32>(way.exit, 1.0)).xz;
        let to_window = (m * vec4<f32>(middle_of_light(way.exit * frame.metres_per_unit), 0.0)).xyz;
        // A vessel that is lifted has light come in from aside. Through its wall the liquid's depth is not known.
        let standing = select(0.0, stands(vessel, upright, way.exit.y), level < 1e9);
        if (standing > 0.0) { through.window = mix(1.0, window_under(vessel, foot, depth, index, to_window), standing); }
    }
    return Wet(way.exit, way.out, kept, vec3<f32>(0.0), through);
}

/// At the surface of a pixel's liquid; `here` is `seen_at` of it, of view depth above 0.
fn at_surface(pixel: vec2<i32>, eye: u32, here: vec4<f32>) -> Entry {
    let slant = length(here.xyz) / here.w;
    let ray = here.xyz / (slant * here.w);
    let point = frame.views[eye].eye + here.xyz;
    var entry = no_entry(point, ray);
    entry.depth = here.w;
    let thickness = thickness_at(vec2<f32>(pixel) + 0.5, eye);
    entry.acid = saturate(thickness.y / max(thickness.x, 1e-9));
    entry.straight = slant * thickness.x;
    let index = index_of(entry.acid);
    entry.normal = normal_at(pixel, eye, here);

    let vessel = vessel_around(point);
    var wetted = 0.0;
    if vessel < frame.blocker_count {
        entry.vessel = vessel;
        let m = frame.vessels[vessel].vessel_from_stage;
        let p = (m * vec4<f32>(point, 1.0)).xyz;
        let stage_from_vessel = transpose(mat3x3<f32>(m[0].xyz, m[1].xyz, m[2].xyz));
        let wall = -(stage_from_vessel * inward(vessel, p));
        let gap = vessel_radius(vessel, p.y) - length(p.xz);
        // Liquid that wets the glass has the glass's own surface; what is level there is its upper one.
        let side = 1.0 - levelness(entry.normal);
        wetted = side * (1.0 - smoothstep(0.3, 0.8, gap / frame.spacing)) * smoothstep(0.0, 0.05, dot(wall, -ray));
        entry.normal = normalize(mix(with_meniscus(entry.normal, wall, gap, entry.acid), wall, wetted));
        // Through glass the surface's height is not known.
        entry.level = select(1e9, point.y, wetted < 0.5);
        entry.filled = filled_along(vessel, p, (m * vec4<f32>(ray, 0.0)).xyz, entry.straight);
        if (has_bubbles() && wetted < 0.5) {
            entry.foam = through_foam(point, ray, index);
            entry.point = entry.foam.point;
            if (any(entry.foam.normal != vec3<f32>(0.0))) { entry.normal = entry.foam.normal; }
        }
        entry.p = p + (m * vec4<f32>(entry.point - point, 0.0)).xyz;
        entry.mixing = striae_at(vec2<f32>(pixel) + 0.5, eye, thickness, here.w, entry.straight);
    }
    entry.within = refract(ray, entry.normal, 1.0 / index);
    // An edge thinner than a drop is none that could mirror.
    entry.reflectance = fresnel(saturate(dot(entry.normal, -ray)), index) * (1.0 - wetted) * saturate(entry.straight / frame.spacing);
    return entry;
}

/// What comes to the eye along a ray that is in liquid from `entry` on.
fn liquid_light(entry: Entry, eye: u32) -> Wet {
    var light: Wet;
    if (entry.vessel == NO_VESSEL) {
        let kept = exp(-entry.straight * frame.metres_per_unit * mix(frame.water, frame.acid, entry.acid));
        light = Wet(entry.point, entry.within, kept, vec3<f32>(0.0), Through(NO_VESSEL, 1.0));
    } else {
        light = followed(entry, eye);
    }
    let foam = entry.foam;
    let passes = foam.kept * (1.0 - entry.reflectance);
    light.kept *= passes;
    light.mirrored *= passes;
    if (entry.depth > 0.0) { light.mirrored += foam.kept * entry.reflectance * mirrored_light(foam.point, reflect(entry.ray, entry.normal)); }
    if (foam.kept < 1.0) { light.mirrored += (1.0 - foam.kept) * mirrored_light(foam.film, foam.mirrored); }
    return light;
}
