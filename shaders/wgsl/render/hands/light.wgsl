//! The hands at each pixel of their tiles: their depth, and their light, which is that of gloves of nitrile.
//!
//! The ray begins where it enters the first capsule about a bone, and goes on as far as distances to the bones, and their slopes, say.

//!include common/picture/daylight.wgsl
//!include common/picture/glove_surface.wgsl
//!include common/picture/packed_light.wgsl
//!include common/picture/shaded_pixel.wgsl
//!include common/picture/thermometer.wgsl
//!include common/picture/tile_pixels.wgsl

/// Reversed depth of the nearest hand or sphere, 0 where there is none; in tiles that have neither, of no meaning.
@group(0) @binding(3) var<storage, read_write> depths: array<f32>;
/// Its light.
@group(0) @binding(4) var<storage, read_write> nearest: array<u32>;

/// Reflectance of a smooth surface of n = 1.5, seen at right angles.
const HEAD_ON = 0.04;
/// Most strides of a ray: most rays take two, one in a thousand ten.
const STRIDES = 32;
/// The distance that is taken for none, pixels.
const CLOSE = 0.01;
/// How far from the surface other parts of the hand take light from it, over the distance of joining: 8 mm. And how far from the
/// surface such a part may be.
const SHADE = 2.0;
const SHADING = 4.0;

/// Pixels along a square of which one is looked at: 2 where tiles are coarse (`common/picture/coarse_blocks.wgsl`), of which a
/// workgroup has all.
override SIDE: u32 = 1u;
/// Pixels that are looked at of a block, of which a workgroup has four in a row and two in a column, or two and four. A GPU's
/// invocations in step share one, and the bones that reach it.
const BLOCK = vec2<u32>(8u, 4u);
const BLOCKS = 8u;
/// Where each bone is seen as far as it has an effect on the surface, and then as far as it has one on its light.
var<workgroup> seen_bones: array<Seen, 192>;
/// By block and group a bit for each bone that reaches it; the last three are the whole workgroup's for the light.
var<workgroup> present: array<atomic<u32>, 27>;

/// The first pixel of a block, from the first one of its workgroup.
fn corner_of_block(block: u32) -> vec2<u32> {
    let in_row = 4u / SIDE;
    return SIDE * BLOCK * vec2<u32>(block % in_row, block / in_row);
}

/// From where to where a ray from the eye is in a capsule about a bone that is `grown` thicker; the second is 0 where it
/// passes by.
fn way_through(cone: Cone, ray: vec3<f32>, grown: f32) -> vec2<f32> {
    let radius = cone.greatest + grown;
    // From next to the bone, since squares of its distance would lose the digits of its radius.
    let near = dot(cone.end + 0.5 * cone.length * cone.axis, ray);
    let from_a = near * ray - cone.end;
    let from_b = from_a - cone.length * cone.axis;
    let along = dot(from_a, cone.axis);
    let turn = dot(ray, cone.axis);
    // The cylinder, between its ends; then the spheres there. NaN, for a ray along the axis, fails each comparison.
    let k2 = 1.0 - turn * turn;
    let k1 = dot(from_a, ray) - along * turn;
    let k0 = dot(from_a, from_a) - along * along - radius * radius;
    let inside = k1 * k1 - k0 * k2;
    let at_a = dot(from_a, ray);
    let at_b = dot(from_b, ray);
    let sides = (vec2<f32>(-1.0, 1.0) * sqrt(max(inside, 0.0)) - k1) / k2;
    let roots_a = within(at_a, at_a * at_a - dot(from_a, from_a) + radius * radius);
    let roots_b = within(at_b, at_b * at_b - dot(from_b, from_b) + radius * radius);
    var way = vec2<f32>(min(roots_a.x, roots_b.x), max(roots_a.y, roots_b.y));
    let places = along + sides * turn;
    if (inside >= 0.0 && places.x >= 0.0 && places.x <= cone.length) { way.x = min(way.x, sides.x); }
    if (inside >= 0.0 && places.y >= 0.0 && places.y <= cone.length) { way.y = max(way.y, sides.y); }
    return select(near + way, vec2<f32>(1e9, 0.0), way.y < way.x);
}

/// From where to where a ray is in a sphere; a negative way where it is not.
fn within(at: f32, inside: f32) -> vec2<f32> {
    let half_way = sqrt(max(inside, 0.0));
    return select(vec2<f32>(1e9, -1e9), vec2<f32>(-at - half_way, half_way - at), inside >= 0.0);
}

/// The first and the last place of a ray that may be in a hand, of those of its bones whose bits are set.
fn way_of(hand: u32, bits: u32, ray: vec3<f32>) -> vec2<f32> {
    var way = vec2<f32>(1e9, 0.0);
    for (var rest = bits; rest != 0u; rest &= rest - 1u) {
        let through = way_through(cones[BONES * hand + firstTrailingBit(rest)], ray, ADDED * run.joined);
        way = vec2<f32>(min(way.x, through.x), max(way.y, through.y));
    }
    return way;
}

fn glove_light(at: vec3<f32>, ray: vec3<f32>, place: GlovePlace, open: f32) -> vec3<f32> {
    let key = key_light(at * frame.metres_per_unit);
    let facing = max(dot(place.normal, key.direction), 0.0);
    let ambient = ambient_light(place.normal.y) * open;
    let half_vector = normalize(key.direction - ray);
    let sheen = pow(max(dot(place.normal, half_vector), 0.0), 22.0) * facing;
    let glancing = pow(1.0 - saturate(-dot(place.normal, ray)), 5.0);
    let mirrored = HEAD_ON + (1.0 - HEAD_ON) * 0.4 * glancing;
    let turned = reflect(ray, place.normal);
    let lit = place.tint * (ambient + facing * key.light) + (0.22 * sheen * key.light + mirrored * ambient_light(turned.y)) * open;
    return mix(lit, place.tint, place.glow);
}

@compute @workgroup_size(32, 8)
fn main(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let block = lane / 32u;
    let in_block = vec2<u32>(lane % BLOCK.x, lane / BLOCK.x % BLOCK.y);
    let in_group = corner_of_block(block) + SIDE * in_block;
    var place = place_of(group, vec3<u32>(in_group, 0u));
    let eye = place.eye;
    // The last half of the invocations looks where light ends.
    let half = lane / 128u;
    let n = lane % 128u;
    let is_bone = n < GROUPS * BONES && n % BONES < run.counts[min(n / BONES, GROUPS - 1u)];
    if (lane < 27u) { atomicStore(&present[lane], 0u); }
    if (is_bone) {
        let bone = bones[n];
        if (half == 0u) { cones[n] = cone_of(bone, frame.views[eye].eye); }
        seen_bones[GROUPS * BONES * half + n] = bone_seen(bone, eye, select(EFFECT, SHADING, half == 1u) * run.joined);
    }
    workgroupBarrier();
    if (is_bone) {
        let low = vec2<f32>(place.pixel) - vec2<f32>(in_group);
        let hand = n / BONES;
        let bit = 1u << (n % BONES);
        let at = seen_bones[GROUPS * BONES * half + n];
        if (half == 1u) {
            if (reaches(at, low, low + vec2<f32>(32.0, f32(8u * SIDE * SIDE)))) { atomicOr(&present[GROUPS * BLOCKS + hand], bit); }
        } else {
            for (var other = 0u; other < BLOCKS; other++) {
                let corner = low + vec2<f32>(corner_of_block(other));
                if (reaches(at, corner, corner + vec2<f32>(SIDE * BLOCK))) { atomicOr(&present[GROUPS * other + hand], bit); }
            }
        }
    }
    workgroupBarrier();
    if (!place.inside) { return; }
    place.pixel = shaded_in(place.pixel, i32(SIDE));
    var bits: array<u32, GROUPS>;
    for (var hand = 0u; hand < GROUPS; hand++) { bits[hand] = atomicLoad(&present[GROUPS * block + hand]); }

    let seen = seen_along(eye, vec2<f32>(place.pixel) + 0.5);
    let stretch = length(seen);
    let ray = seen / stretch;
    let near = frame.views[eye].near * stretch;
    var through = vec2<f32>(1e9, 0.0);
    for (var hand = 0u; hand < GROUPS; hand++) {
        let of_hand = way_of(hand, bits[hand], ray);
        through = vec2<f32>(min(through.x, of_hand.x), max(through.y, of_hand.y));
    }
    let end = through.y;
    var way = max(through.x, near);
    var nearest_hand = 0u;
    let pixel = 1.0 / frame.views[eye].focal;
    var met = false;
    var apart = 1e9;
    // A distance to a bone curves by no more than one over its radius there. So if there is nothing in its way, a stride of this
    // length and less, squared, over the distance that has been gone, ends as close to the surface as needed.
    let last = 2.0 * run.thinnest * CLOSE * pixel;
    for (var stride = 0; stride < STRIDES && way < end; stride++) {
        apart = 1e9;
        var free = 1e9;
        var is_straight = false;
        var freest = 0u;
        for (var hand = 0u; hand < GROUPS; hand++) {
            if (bits[hand] == 0u) { continue; }
            let stride_to = stride_at(hand, bits[hand], way * ray, ray);
            if (stride_to.distance < apart) {
                apart = stride_to.distance;
                nearest_hand = hand;
            }
            if (stride_to.free < free) {
                free = stride_to.free;
                is_straight = stride_to.is_straight;
                freest = hand;
            }
        }
        // A hand that the eye is in, or that reaches through the near plane, is not seen from within.
        if (apart < 0.0 && way == near) { break; }
        met = apart < CLOSE * pixel * way;
        if (met) { break; }
        nearest_hand = freest;
        way += free;
        met = is_straight && free * free < last * way;
        if (met) { break; }
    }
    // In the last corner of a crease strides are short; nothing is seen through it.
    met = met || (way < end && apart > 0.0 && apart < pixel * way);
    let index = pixel_index(place.pixel, eye);
    var before = 0.0;
    // A drop of spray may hide only a part of the pixel.
    var over = vec4<f32>(0.0);
    if (run.over != 0u) {
        before = depths[index];
        if (before > 0.0) { over = unpacked(nearest[index]); }
    }
    let reversed = select(0.0, near / way, met);
    if (reversed > before) { over.a = 0.0; }
    if (reversed > 0.0 && over.a < 1.0) {
        let at = way * ray;
        let hand = nearest_hand;
        let all = atomicLoad(&present[GROUPS * BLOCKS + hand]);
        var surface = hand_place(hand, all, at);
        if (hand == GROUPS - 1u && run.scale_bone < BONES) {
            let stem = cones[BONES * hand + run.scale_bone];
            if (way_from(stem, at).distance < 0.5 * stem.radius) {
                surface.tint = stem_tint(stem, at, ray, pixel * way, bones[BONES * hand + run.scale_bone].tint);
            }
        }
        // Between fingers less of the room is seen.
        let reach = SHADE * run.joined;
        let open = saturate(0.25 + 0.75 * hand_distance(hand, all, at + reach * surface.normal) / reach);
        let light = display(glove_light(at + frame.views[eye].eye, ray, surface, open));
        nearest[index] = packed(mix(light, over.rgb, over.a));
        depths[index] = select(before, reversed, over.a <= 0.5);
    } else if (run.over == 0u) {
        depths[index] = 0.0;
    }
}
