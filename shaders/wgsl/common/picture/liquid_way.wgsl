//! A ray's way through a vessel's liquid: by Snell's law at glass and surface, mirrored where that lets nothing pass, and through bubbles.

//!include common/picture/bubble_light.wgsl
//!include common/picture/frame.wgsl
//!include common/picture/through_wall.wgsl
//!include common/picture/vessel_rays.wgsl

/// Refractive index of water at 20 °C.
const INDEX = 1.333;
/// Ways through the liquid, each but the first behind a mirror: after that, what is left is little.
const MOST_WAYS = 5;
/// Bubbles on a ray's way, each of which is a mirror or a lens. At the next one the ray ends, in the light that comes from all about: where it would
/// come from changes from pixel to pixel there, and glitters.
const MOST_BUBBLES = 3;
/// The share of a base's thickness at which a ray leaves it: its underside is the bench's own plane, where it would miss the bench.
const ABOVE_BENCH = 0.9;

/// Of liquid with that share of acid by mass.
fn index_of(acid: f32) -> f32 {
    return INDEX + INDEX_OF_ACID * acid;
}

/// A ray on its way through a vessel's liquid, and out of it.
struct Way {
    /// Where it leaves it, and along what.
    exit: vec3<f32>,
    out: vec3<f32>,
    /// How far it has come in the liquid, how far to where it first turned, and where that is.
    length: f32,
    first: f32,
    turned: vec3<f32>,
    /// Whether it leaves it through the base.
    down: bool,
    /// Whether it ends among bubbles.
    lost: bool,
}

/// Follows a ray from `point` (stage; `p` in the vessel's frame) along `within`, both in the liquid: what meets wall, base or the surface at the
/// height `level` (stage) too flat is mirrored there, and goes on.
fn way_through(vessel: u32, point: vec3<f32>, p: vec3<f32>, within: vec3<f32>, index: f32, level: f32) -> Way {
    let m = frame.vessels[vessel].vessel_from_stage;
    let stage_from_vessel = transpose(mat3x3<f32>(m[0].xyz, m[1].xyz, m[2].xyz));
    var ray = Way(point, within, 0.0, 0.0, point, false, false);
    var at = p;
    let bubbly = has_bubbles();
    var mirrors = 0;
    for (var n = 0; mirrors < MOST_WAYS; n++) {
        let direction = (m * vec4<f32>(ray.out, 0.0)).xyz;
        let reach = to_glass(vessel, at, direction);
        let up = select(1e9, max(level - ray.exit.y, 0.0) / ray.out.y, n > 0 && ray.out.y > 1e-3);
        var way = min(min(reach.x, reach.y), up);
        var bubble = NO_BUBBLE;
        if (bubbly) { bubble = meets_bubble(ray.exit, ray.out, way); }
        way = min(way, bubble.way);
        at += way * direction;
        ray.exit += way * ray.out;
        ray.length += way;
        if (n == 0) {
            ray.first = way;
            ray.turned = ray.exit;
        }
        if (bubble.way <= way) {
            ray.lost = n - mirrors == MOST_BUBBLES;
            if (ray.lost) { break; }
            let after = through_bubble(ray.exit, ray.out, bubble, index);
            ray.exit = after.point;
            ray.out = after.direction;
            at = (m * vec4<f32>(ray.exit, 1.0)).xyz;
            continue;
        }
        ray.down = reach.y <= min(reach.x, up);
        var back = vec3<f32>(0.0, 1.0, 0.0);
        var through = vec3<f32>(0.0);
        if (up < min(reach.x, reach.y)) {
            back = vec3<f32>(0.0, -1.0, 0.0);
            through = refract(ray.out, back, index);
        } else if (ray.down) {
            // The base is of glass: what is mirrored, its underside mirrors.
            let in_glass = refract(direction, back, index / GLASS_INDEX);
            let base = frame.vessels[vessel].inner_floor / max(-in_glass.y, 1e-3) * in_glass;
            let under = length((at + base).xz);
            let radius = vessel_radius(vessel, at.y);
            back = stage_from_vessel * back;
            if (under > radius) {
                // At its edge the base is round, and shows the bench beside it.
                ray.down = false;
                let round = normalize(vec3<f32>(-at.x - base.x, under, -at.z - base.z));
                through = stage_from_vessel * refract(in_glass, round, GLASS_INDEX);
                if (dot(through, through) > 0.0) { ray.exit += ABOVE_BENCH * (stage_from_vessel * base); }
            } else {
                through = refract(ray.out, back, index);
                let passes = dot(through, through) > 0.0;
                let returned = at.xz + 2.0 * base.xz;
                let aside = select(returned * min(1.0, radius / max(length(returned), 1e-9)) - at.xz, ABOVE_BENCH * base.xz, passes);
                let moved = vec3<f32>(aside.x, select(0.0, ABOVE_BENCH * base.y, passes), aside.y);
                ray.exit += stage_from_vessel * moved;
                at += moved;
            }
        } else {
            // Glass is a lens here: what its inner face would mirror, if there were air behind, its outer one lets pass.
            let wall = inward(vessel, at);
            back = stage_from_vessel * wall;
            let in_glass = refract((m * vec4<f32>(ray.out, 0.0)).xyz, wall, index / GLASS_INDEX);
            let on = out_of_cylinder(at, in_glass, vessel_radius(vessel, at.y) + frame.vessels[vessel].wall);
            let outer = at + on * in_glass;
            through = stage_from_vessel * refract(in_glass, inward(vessel, outer), GLASS_INDEX);
            ray.exit += select(vec3<f32>(0.0), on * (stage_from_vessel * in_glass), dot(through, through) > 0.0);
        }
        if (dot(through, through) > 0.0) {
            ray.out = through;
            break;
        }
        ray.out = reflect(ray.out, back);
        mirrors += 1;
    }
    return ray;
}
