//! The vessels' glass, traced: surfaces of revolution whose outlines are segments, so that a ray meets
//! cones, and what is printed on them. Liquid and the room behind it are bent by `through_wall.wgsl`; all else is seen where it is.

//!include common/picture/dew_light.wgsl
//!include common/picture/frame.wgsl
//!include common/picture/liquid_light.wgsl
//!include common/picture/printed.wgsl
//!include common/picture/room.wgsl
//!include common/picture/shard.wgsl
//!include common/picture/tile_marks.wgsl

/// Reflectance of borosilicate glass (n = 1.47) at normal incidence, ((n−1)/(n+1))².
const GLASS_REFLECTANCE = 0.036;
/// Share of a broken edge that is seen over what is behind: as bright as glass a palm thick, through which one looks along the wall.
const EDGE_OPACITY = 0.75;
/// What it sends to the eye.
const BROKEN_EDGE = vec3<f32>(0.30, 0.46, 0.42);
/// What a rim sends to the eye: light that comes up along the wall, and has gone that far (m) through liquid that wets it. Chosen so that
/// the still `boil` of docs/measurements/rendering.md has the least FLIP of five pairs, whose FLIP differs by 0.0005.
const RIM = vec3<f32>(0.36, 0.36, 0.36);
const RIM_WAY = 0.045;
/// Least cosine between a wall's normal and the way to the eye that counts.
const STEEPEST = 0.18;
/// A wall whose normal's outward part is below this looks into the vessel.
const INNER = -0.1;
/// What lies over something: its colour as displayed, and the share of what is behind that is still seen.
struct Cover {
    colour: vec3<f32>,
    open: f32,
}

fn over(above: Cover, below: Cover) -> Cover {
    return Cover(above.colour + above.open * below.colour, above.open * below.open);
}

/// A ray in a vessel's frame, from where it is nearest to the vessel's middle, so that roots keep their digits.
struct GlassRay {
    origin: vec3<f32>,
    direction: vec3<f32>,
    /// View depth of the origin; a way of one along the direction is a view depth of one.
    depth: f32,
    /// View depth, in front of which glass is seen.
    end: f32,
    /// How far beside it a pixel's other rays are there.
    aside: f32,
}

/// Where a ray meets a vessel's glass, the first to be dealt with in front: eight at most, through two walls and a
/// base, twice each. Shifted and not indexed, so that they stay in registers.
struct Meetings {
    count: u32,
    ways: array<vec4<f32>, 2>,
    segments: array<vec4<f32>, 2>,
}

fn put_in_front(before: Meetings, way: f32, segment: u32) -> Meetings {
    let w = before.ways;
    let s = before.segments;
    return Meetings(
        min(before.count + 1u, 8u),
        array<vec4<f32>, 2>(vec4<f32>(way, w[0].xyz), vec4<f32>(w[0].w, w[1].xyz)),
        array<vec4<f32>, 2>(vec4<f32>(f32(segment), s[0].xyz), vec4<f32>(s[0].w, s[1].xyz)),
    );
}

fn without_front(before: Meetings) -> Meetings {
    let w = before.ways;
    let s = before.segments;
    return Meetings(
        before.count - 1u,
        array<vec4<f32>, 2>(vec4<f32>(w[0].yzw, w[1].x), vec4<f32>(w[1].yzw, 0.0)),
        array<vec4<f32>, 2>(vec4<f32>(s[0].yzw, s[1].x), vec4<f32>(s[1].yzw, 0.0)),
    );
}

/// Where a ray meets a segment of an outline.
struct SegmentMet {
    /// The ways along it; 1e9 for none.
    ways: vec2<f32>,
    /// Whether another ray of its pixel may meet more or less: this one passes next to an end, or nearly touches the cone.
    edge: bool,
}

/// How near an end of a segment is next to it, over `aside`: from above, a pixel covers more of a wall.
const NEXT_TO = 2.0;

fn meets_segment(ray: GlassRay, ends: vec4<f32>) -> SegmentMet {
    let o = ray.origin;
    let d = ray.direction;
    let rise = ends.w - ends.y;
    let flat_ = abs(rise) < 1e-6 * (abs(ends.w) + abs(ends.x - ends.z));
    // r = radius + slope · way along the segment's cone.
    let lean = (ends.z - ends.x) / select(rise, 1.0, flat_);
    let radius = ends.x + lean * (o.y - ends.y);
    let slope = lean * d.y;
    let a = dot(d.xz, d.xz) - slope * slope;
    let b = dot(o.xz, d.xz) - radius * slope;
    let c = dot(o.xz, o.xz) - radius * radius;
    let discriminant = b * b - a * c;
    let q = -(b + select(-1.0, 1.0, b >= 0.0) * sqrt(max(discriminant, 0.0)));
    var ways = vec2<f32>(q / a, c / q);
    if (flat_) { ways = vec2<f32>((ends.y - o.y) / d.y, 1e9); }
    let y = o.y + ways * d.y;
    let x = o.x + ways * d.x;
    let z = o.z + ways * d.z;
    let r = select(radius + ways * slope, sqrt(x * x + z * z), flat_);
    let place = select(y, r, flat_);
    let limits = select(ends.yw, ends.xz, flat_);
    let fits = (place >= vec2<f32>(min(limits.x, limits.y))) & (place < vec2<f32>(max(limits.x, limits.y)))
        & (r >= vec2<f32>(0.0));
    let depth = ray.depth + ways;
    let seen = (depth > vec2<f32>(0.0)) & (depth < vec2<f32>(ray.end)) & (vec2<bool>(discriminant >= 0.0) | vec2<bool>(flat_));
    let from_end = min(abs(place - limits.x), abs(place - limits.y));
    let is_next = any((from_end < vec2<f32>(NEXT_TO * ray.aside)) & seen);
    // Beside a cylinder by δ of its radius r the discriminant is 2 a r δ.
    let middle = -b / a;
    let height = o.y + middle * d.y;
    let touches = !flat_ && abs(discriminant) < 2.0 * a * abs(radius + slope * middle) * ray.aside
        && height > min(ends.y, ends.w) - ray.aside && height < max(ends.y, ends.w) + ray.aside;
    return SegmentMet(select(vec2<f32>(1e9), ways, fits & seen), is_next || touches);
}

/// One wall's light at `place` (stage). `grain` is the least cosine between its normal and the way to the eye that a pixel can show.
fn wall(place: vec3<f32>, to_eye: vec3<f32>, normal: vec3<f32>, grain: f32) -> Cover {
    // A silhouette thinner than a pixel would break into dots.
    let facing = max(max(dot(normal, to_eye), grain), STEEPEST);
    let rest = 1.0 - facing;
    let rest_squared = rest * rest;
    let reflectance = GLASS_REFLECTANCE + (1.0 - GLASS_REFLECTANCE) * rest_squared * rest_squared * rest;
    // What borosilicate of 2 mm absorbs, 0.05 %, is less than a level.
    return Cover(display(mirrored_light(place, reflect(-to_eye, normal))) * reflectance, 1.0 - reflectance);
}

/// What the rim of a vessel sends to the eye; of the liquid in it what is seen at its floor's middle counts.
fn rim_light(index: u32, eye: u32) -> vec3<f32> {
    let clear = frame.sky_level * RIM;
    // A picture without liquid has no sums.
    if (frame.spacing == 0.0) { return clear; }
    let m = frame.vessels[index].vessel_from_stage;
    let low = vec3<f32>(0.0, frame.vessels[index].inner_floor + frame.spacing, 0.0);
    let seen = pixel_of((low - m[3].xyz) * mat3x3<f32>(m[0].xyz, m[1].xyz, m[2].xyz), eye);
    // What is seen there may be another vessel's.
    let here = seen_at(vec2<i32>(floor(seen.xy)), eye);
    let met = (m * vec4<f32>(frame.views[eye].eye + here.xyz, 1.0)).xyz;
    if (here.w <= 0.0 || length(met.xz) > frame.vessels[index].outer) { return clear; }
    let sums = thickness_at(seen.xy, eye);
    let absorbs = mix(frame.water, frame.acid, share_of_acid(sums, 0.0));
    return clear * exp(-RIM_WAY * smoothstep(0.0, 2.0 * frame.spacing, sums.x) * absorbs);
}

/// View depth of the middle of the nearest of the vessels in `bits`.
fn nearest_vessel(bits: u32, eye: u32) -> f32 {
    var nearest = 1e9;
    for (var rest = bits & MARK_VESSELS; rest != 0u; rest &= rest - 1u) {
        let index = firstTrailingBit(rest);
        let m = frame.vessels[index].vessel_from_stage;
        let middle = transpose(mat3x3<f32>(m[0].xyz, m[1].xyz, m[2].xyz)) * (vec3<f32>(0.0, 0.5 * frame.vessels[index].rim, 0.0) - m[3].xyz);
        nearest = min(nearest, (frame.views[eye].clip_from_stage * vec4<f32>(middle, 1.0)).w);
    }
    return nearest;
}

/// Rays of a pixel that has an edge of glass or print: places of `RAYS`, of which the first one alone serves elsewhere. With one, that one everywhere.
override GLASS_RAYS: u32 = 4u;
/// Pixels over which they are spread.
override GLASS_SPREAD: f32 = 1.0;

/// Places in a pixel, that a rim thinner than it does not break into dots: its middle and a triangle about it, turned.
const RAYS = array<vec2<f32>, 4>(
    vec2<f32>(0.0, 0.0),
    vec2<f32>(0.376, 0.137),
    vec2<f32>(-0.306, 0.257),
    vec2<f32>(-0.069, -0.394),
);
/// Of them the distance from the middle, pixels.
const FURTHEST_RAY = 0.4;

/// All glass of the vessels in `bits` that is nearer to an eye than view depth `end`, over the pixel with its
/// middle at `place`.
fn glass_over(bits: u32, eye: u32, place: vec2<f32>, end: f32) -> Cover {
    var sum = Cover(vec3<f32>(0.0), 0.0);
    for (var n = 0u; n < GLASS_RAYS; n++) {
        let ray = glass_along(bits, eye, place + GLASS_SPREAD * RAYS[n], end);
        if (n == 0u && (GLASS_RAYS == 1u || !ray.edge)) { return ray.cover; }
        sum = Cover(sum.colour + ray.cover.colour, sum.open + ray.cover.open);
    }
    return Cover(sum.colour / f32(GLASS_RAYS), sum.open / f32(GLASS_RAYS));
}

/// What is along a ray of a pixel, and whether other rays of it may meet more or less glass.
struct GlassSeen {
    cover: Cover,
    edge: bool,
}

/// The same along one ray: first the walls that look away from the eye, over them those that look at it.
fn glass_along(bits: u32, eye: u32, place: vec2<f32>, end: f32) -> GlassSeen {
    var edge = false;
    var far = Cover(vec3<f32>(0.0), 1.0);
    var near = far;
    let view = &frame.views[eye];
    let seen = seen_along(eye, place);
    let to_eye = -normalize(seen);
    for (var rest = bits & MARK_VESSELS; rest != 0u; rest &= rest - 1u) {
        let index = firstTrailingBit(rest);
        let m = frame.vessels[index].vessel_from_stage;
        let stage_from_vessel = transpose(mat3x3<f32>(m[0].xyz, m[1].xyz, m[2].xyz));
        let eye_place = (m * vec4<f32>((*view).eye, 1.0)).xyz;
        let direction = (m * vec4<f32>(seen, 0.0)).xyz;
        let middle = vec3<f32>(0.0, 0.5 * frame.vessels[index].rim, 0.0);
        let nearest = dot(middle - eye_place, direction) / dot(direction, direction);
        // An eye over a vessel or in it sees glass as far off as that is wide.
        let aside = FURTHEST_RAY * GLASS_SPREAD * max(abs(nearest), frame.vessels[index].outer) / (*view).focal;
        let ray = GlassRay(eye_place + nearest * direction, direction, nearest, end, aside);
        // Most rays of a tile pass beside the vessel.
        let outer = frame.vessels[index].outer + aside;
        let a = dot(direction.xz, direction.xz);
        let b = dot(ray.origin.xz, direction.xz);
        let passes = b * b < a * (dot(ray.origin.xz, ray.origin.xz) - outer * outer);
        let segments = select(frame.vessels[index].segments, vec2<u32>(0u), passes);

        // From the last segment, so that the outside comes first.
        var met: Meetings;
        for (var segment = segments.y; segment > segments.x; ) {
            segment -= 2u;
            let here = meets_segment(ray, outlines[segment]);
            edge = edge || here.edge;
            if (here.ways.y < 1e8) { met = put_in_front(met, here.ways.y, segment); }
            if (here.ways.x < 1e8) { met = put_in_front(met, here.ways.x, segment); }
        }
        // A broken edge is anywhere.
        edge = edge || (frame.vessels[index].piece != 0u && met.count > 0u);
        let across = (m * vec4<f32>((*view).across, 0.0)).xyz;
        let down = (m * vec4<f32>((*view).down, 0.0)).xyz;
        for (; met.count > 0u; met = without_front(met)) {
            let way = met.ways[0].x;
            let segment = u32(met.segments[0].x);
            let p = ray.origin + way * direction;
            let within = within_shard(index, p);
            if (within < 0.0) { continue; }
            let r = max(length(p.xz), 1e-9);
            let ends = outlines[segment];
            let normals = outlines[segment + 1u];
            let span = ends.zw - ends.xy;
            let along = saturate(dot(vec2<f32>(r, p.y) - ends.xy, span) / dot(span, span));
            let profile = normalize(mix(normals.xy, normals.zw, along));
            let outward = vec3<f32>(profile.x * p.x / r, profile.y, profile.x * p.z / r);
            let cosine = dot(outward, direction);
            let depth = nearest + way;
            // At a silhouette the cosine grows as the root of the way from it, over the radius.
            let grain = sqrt(depth / ((*view).focal * r));
            let normal = stage_from_vessel * (outward * select(1.0, -1.0, cosine > 0.0));
            let stage = (*view).eye + depth * seen;
            var layer = wall(stage, to_eye, normal, grain);
            if (profile.x < INNER && has_dew(index)) {
                let cover = dew_at(index, p);
                if (cover > 0.0) {
                    let dewy = dew_seen(cover, stage, to_eye, normal, max(dot(normal, to_eye), STEEPEST));
                    let veil = Cover(dewy.rgb, dewy.a);
                    // It is on the cavity's side of the wall.
                    if (cosine > 0.0) { layer = over(layer, veil); } else { layer = over(veil, layer); }
                }
            }
            // How far up the wall it is to the next pixel: the step in the picture, moved along the ray on to the wall.
            let height = abs(across.y - direction.y * dot(outward, across) / cosine)
                + abs(down.y - direction.y * dot(outward, down) / cosine);
            if (profile.x > 0.5) {
                let print = printed(index, p, cosine < 0.0, depth * height, normal, stage);
                edge = edge || print.open < 1.0;
                layer = over(Cover(print.colour, print.open), layer);
            }
            if (profile.y > 0.9 && p.y > frame.vessels[index].rim - 0.1 * frame.vessels[index].wall) {
                layer = over(Cover(EDGE_OPACITY * display(rim_light(index, eye)), 1.0 - EDGE_OPACITY), layer);
            }
            if (within < frame.vessels[index].wall) {
                layer = over(Cover(EDGE_OPACITY * display(frame.sky_level * BROKEN_EDGE), 1.0 - EDGE_OPACITY), layer);
            }
            if (cosine > 0.0) { far = over(layer, far); } else { near = over(layer, near); }
        }
    }
    return GlassSeen(over(near, far), edge);
}
