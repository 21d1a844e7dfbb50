//! Bubbles in the liquid as its rays meet them: a ball of vapour, at whose face a ray is mirrored or bent, and a film over what of
//! it is above the surface. Rays find them in cells, so in the stage and not in the picture: behind glass and in mirrors they are
//! where they are, and both eyes see the same.

//!include common/picture/bubble_cells.wgsl
//!include common/picture/frame.wgsl
//!include common/picture/fresnel.wgsl

@group(0) @binding(15) var<storage, read> bubble_heads: array<u32>;
@group(0) @binding(16) var<storage, read> bubble_entries: array<BubbleEntry>;

/// Cells that a ray goes through at most: across a vessel of 2 L.
const MOST_CELLS = 64;

/// A bubble on a ray.
struct MetBubble {
    /// To where the ray enters it, in lengths of its direction; 1e9 for none.
    way: f32,
    centre: vec3<f32>,
    radius: f32,
}

const NO_BUBBLE = MetBubble(1e9, vec3<f32>(0.0), 0.0);

fn has_bubbles() -> bool {
    return bubble_heads[BUBBLE_CELLS] > 0u;
}

/// The first bubble that a ray from outside of it enters nearer than `end`; `direction` is of length 1.
fn meets_bubble(origin: vec3<f32>, direction: vec3<f32>, end: f32) -> MetBubble {
    var met = NO_BUBBLE;
    let steep = select(vec3<f32>(-1e-9), vec3<f32>(1e-9), direction >= vec3<f32>(0.0));
    let inverse = 1.0 / select(steep, direction, abs(direction) > vec3<f32>(1e-9));
    let forth = select(vec3<i32>(-1), vec3<i32>(1), direction >= vec3<f32>(0.0));
    var cell = vec3<i32>(floor(origin / frame.bubble_cell));
    for (var n = 0; n < MOST_CELLS; n++) {
        for (var next = bubble_heads[place_of_cell(cell)]; next != 0u; next = bubble_entries[next - 1u].next) {
            let entry = bubble_entries[next - 1u];
            let to_centre = entry.centre - origin;
            let along = dot(to_centre, direction);
            let miss = to_centre - along * direction;
            let inside = entry.radius * entry.radius - dot(miss, miss);
            let way = along - sqrt(max(inside, 0.0));
            if (inside > 0.0 && way > 0.0 && way < min(end, met.way)) {
                met = MetBubble(way, entry.centre, entry.radius);
            }
        }
        let to_side = (vec3<f32>(cell + max(forth, vec3<i32>(0))) * frame.bubble_cell - origin) * inverse;
        let leaves = min(to_side.x, min(to_side.y, to_side.z));
        if (min(met.way, end) <= leaves) { break; }
        cell += select(vec3<i32>(0), forth, to_side <= vec3<f32>(leaves));
    }
    return met;
}

/// A ray after it met a bubble.
struct Bubbled {
    point: vec3<f32>,
    direction: vec3<f32>,
}

/// Where a ray in liquid of `index` goes that meets a bubble at `point`: mirrored at its face, or through it.
fn through_bubble(point: vec3<f32>, direction: vec3<f32>, met: MetBubble, index: f32) -> Bubbled {
    let normal = (point - met.centre) / met.radius;
    let within = refract(direction, normal, index);
    // One ray is followed, of the two that a face makes: the brighter.
    let mirrors = dot(within, within) == 0.0 || fresnel(saturate(-dot(within, normal)), index) > 0.5;
    if (mirrors) { return Bubbled(point, reflect(direction, normal)); }
    let out = point - 2.0 * met.radius * dot(within, normal) * within;
    return Bubbled(out, refract(within, (met.centre - out) / met.radius, 1.0 / index));
}

/// How far before the surface a film is looked for, metres as drawn: the height of the largest bubble that lasts.
const FOAM_HEIGHT = 0.012;

/// A ray from the eye at the liquid's surface, behind what foam is over it.
struct Foamed {
    /// Where it meets the liquid: the surface, or the wall of the bubble that it is in.
    point: vec3<f32>,
    /// Towards the eye; 0 where it is the surface's own.
    normal: vec3<f32>,
    /// Share of light that the films let through, and where and along what one mirrors.
    kept: f32,
    film: vec3<f32>,
    mirrored: vec3<f32>,
}

/// What of a ray that meets the surface at `point` is left by films over it. A film is thinner than an eye resolves, and bends nothing.
fn through_foam(point: vec3<f32>, ray: vec3<f32>, index: f32) -> Foamed {
    var foamed = Foamed(point, vec3<f32>(0.0), 1.0, point, ray);
    let before = FOAM_HEIGHT / frame.metres_per_unit;
    let start = point - before * ray;
    let met = meets_bubble(start, ray, before);
    if (met.way > before) { return foamed; }
    foamed.film = start + met.way * ray;
    let normal = (foamed.film - met.centre) / met.radius;
    let face = fresnel(saturate(-dot(ray, normal)), index);
    // Both faces, with all that goes to and fro between them.
    foamed.kept = 1.0 - 2.0 * face / (1.0 + face);
    foamed.mirrored = reflect(ray, normal);
    let out = foamed.film - 2.0 * met.radius * dot(ray, normal) * ray;
    if (dot(out - point, ray) > 0.0) {
        foamed.point = out;
        foamed.normal = (met.centre - out) / met.radius;
    }
    return foamed;
}
