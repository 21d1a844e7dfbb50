//! The silhouette of an ellipsoid, and where a pixel's ray meets it.
//!
//! M⁻¹ takes the ellipsoid to the unit sphere, and rays to rays. With the eye at o in the sphere's
//! space, a ray w from there passes the centre at |o × w|/|w|, and enters the sphere at
//! (o² − 1)/(√(w² − |o × w|²) − o·w) of w. Both o × w and w are linear in the pixel, so a pixel costs
//! three dot products and a root. (The discriminant as (o·w)² − w²(o² − 1) would lose all its digits: o is
//! hundreds of radii.)

//!include common/picture/ellipsoid.wgsl
//!include common/picture/frame.wgsl

struct Silhouette {
    /// The pixels that it may cover: from the first to before the second.
    low: vec2<i32>,
    high: vec2<i32>,
    /// The place that the rest is relative to, pixels.
    middle: vec2<f32>,
    /// M⁻¹ times the ray there, of view depth 1, and what a pixel to the right and down adds.
    ray: vec3<f32>,
    across: vec3<f32>,
    down: vec3<f32>,
    /// o, and o² − 1.
    o: vec3<f32>,
    beyond: f32,
    determinant: f32,
}

/// A row of the projection, of a homogeneous coordinate: its part on the centre, and on M's
/// columns.
fn extent_of(row: vec4<f32>, m: mat3x3<f32>, centre: vec3<f32>) -> vec4<f32> {
    return vec4<f32>(m * row.xyz, dot(row.xyz, centre) + row.w);
}

/// Middle and half length along one axis of the picture, in clip space, of a body of half axes `at`
/// and `depth` (as `extent_of` gives them), relative to where its centre is seen: by its dual conic.
fn bounds(at: vec3<f32>, depth: vec4<f32>) -> vec2<f32> {
    let xx = dot(at, at);
    let xw = dot(at, depth.xyz);
    let ww = dot(depth.xyz, depth.xyz) - depth.w * depth.w;
    return vec2<f32>(-xw, sqrt(max(xw * xw - xx * ww, 0.0))) / -ww;
}

/// The silhouette of e for an eye; of no pixels for an eye within it, or where none of it is beyond the
/// near plane.
fn silhouette_of(e: Ellipsoid, eye: u32) -> Silhouette {
    var none: Silhouette;
    let m = mat3x3<f32>(
        vec3<f32>(e.diagonal.x, e.others.x, e.others.y),
        vec3<f32>(e.others.x, e.diagonal.y, e.others.z),
        vec3<f32>(e.others.y, e.others.z, e.diagonal.z),
    );
    // M⁻¹ by its adjugate, whose columns are cross products of M's.
    let c0 = cross(m[1], m[2]);
    let c1 = cross(m[2], m[0]);
    let c2 = cross(m[0], m[1]);
    let determinant = dot(m[0], c0);
    let inverse = transpose(mat3x3<f32>(c0, c1, c2)) * (1.0 / determinant);
    let o = inverse * (frame.views[eye].eye - e.centre);
    let distance_squared = dot(o, o);
    let clip = transpose(frame.views[eye].clip_from_stage);
    let depth = extent_of(clip[3], m, e.centre);
    let x = extent_of(clip[0], m, e.centre);
    let y = extent_of(clip[1], m, e.centre);
    // Half of its length along the eye's axis and across it, in clip space.
    let reach = vec3<f32>(length(x.xyz), length(y.xyz), length(depth.xyz));
    let near = frame.views[eye].near;
    let far = depth.w + reach.z;
    // The comparisons fail for NaN, for a shape without volume and for what lies absurdly far.
    if !(distance_squared > 1.0 && distance_squared < 1e12 && determinant > 0.0) || far < near {
        return none;
    }
    // Of what crosses the eye's plane, or nearly, only what is beyond the near plane is seen: a box
    // around that. A conic's bounds would be the whole picture.
    let crosses = reach.z >= 0.99 * abs(depth.w);
    let least = vec2<f32>(x.w, y.w) - reach.xy;
    let most = vec2<f32>(x.w, y.w) + reach.xy;
    let seen = select(vec2<f32>(x.w, y.w) / depth.w, vec2<f32>(0.0), crosses);
    let over_x = bounds(x.xyz - seen.x * depth.xyz, depth);
    let over_y = bounds(y.xyz - seen.y * depth.xyz, depth);
    let ndc = seen + vec2<f32>(over_x.x, over_y.x);
    let half_length = vec2<f32>(over_x.y, over_y.y);
    let first = select(ndc - half_length, min(least / near, least / far), crosses);
    let last = select(ndc + half_length, max(most / near, most / far), crosses);
    let low = (0.5 + 0.5 * first) * frame.extent;
    let high = (0.5 + 0.5 * last) * frame.extent;
    let middle = (0.5 + 0.5 * seen) * frame.extent;
    return Silhouette(
        vec2<i32>(clamp(low, vec2<f32>(0.0), frame.extent)),
        vec2<i32>(clamp(ceil(high), vec2<f32>(0.0), frame.extent)),
        middle,
        inverse * seen_along(eye, middle),
        inverse * frame.views[eye].across,
        inverse * frame.views[eye].down,
        o,
        distance_squared - 1.0,
        determinant,
    );
}

/// A ray in the sphere's space.
struct SphereRay {
    /// w².
    squared: f32,
    /// |o × w|².
    miss: f32,
    /// −o·w: positive towards the centre.
    towards: f32,
}

fn ray_at(s: Silhouette, place: vec2<f32>) -> SphereRay {
    let aside = place - s.middle;
    let w = s.ray + aside.x * s.across + aside.y * s.down;
    let miss = cross(s.o, w);
    return SphereRay(dot(w, w), dot(miss, miss), -dot(s.o, w));
}

/// Reversed depth where a ray enters the ellipsoid; 0 where it passes by, or enters behind the eye or before the
/// near plane.
fn entered_at(s: Silhouette, place: vec2<f32>, near: f32) -> f32 {
    let ray = ray_at(s, place);
    let inside = ray.squared - ray.miss;
    let reversed = near * (sqrt(max(inside, 0.0)) + ray.towards) / s.beyond;
    return select(0.0, reversed, inside > 0.0 && ray.towards > 0.0 && reversed < 1.0);
}
