//! The silhouette of an ellipsoid in one covering triangle.
//!
//! M⁻¹ takes the ellipsoid to the unit sphere, and rays to rays; so all that is known of spheres
//! (`render/particles.wgsl`) holds there, and only the corners come back through M. With the eye
//! at o in the sphere's space and κ = 1/|o|, the lines from the eye that touch the sphere do so
//! on a circle of radius √(1 − κ²) at κ from the centre. In units of that circle's radius a
//! ray's place (u, v) has ρ² = u² + v², and with q = √(1 − ρ²) it enters the sphere at 1/(1 + κq)
//! of its way to the circle's plane, and leaves at 1/(1 − κq).
//!
//! The triangle lies in the plane that touches the sphere where it is nearest to the eye, at
//! 1/(1 + κ) of the way: so what is hit is never nearer than the triangle, and a driver may leave
//! out what lies behind before it runs the fragment. No bounds in clip space are needed, so
//! asymmetric frusta and the picture's edge are nothing special.

//!include common/frame.wgsl
//!include common/ellipsoid.wgsl

@group(0) @binding(1) var<storage, read> ellipsoids: array<Ellipsoid>;

/// Corners of an equilateral triangle around the unit circle.
const CORNERS = array<vec2<f32>, 3>(
    vec2<f32>(0.0, 2.0),
    vec2<f32>(-1.7320508, -1.0),
    vec2<f32>(1.7320508, -1.0),
);

/// A triangle of three of these has no area. (Outside the frustum it would have to be clipped, and
/// Mesa 22.3's llvmpipe draws some of what it clips for one eye into the other's picture.)
const NOWHERE = vec4<f32>(0.0, 0.0, 0.0, 1.0);

/// A corner of the covering triangle.
struct Corner {
    clip: vec4<f32>,
    /// Its place (u, v).
    place: vec2<f32>,
    kappa: f32,
    /// det M.
    determinant: f32,
}

/// Corner `index` of the ellipsoid's triangle for an eye; nowhere for an eye within it.
fn corner_of(e: Ellipsoid, eye: u32, index: u32) -> Corner {
    let m = mat3x3<f32>(
        vec3<f32>(e.diagonal.x, e.others.x, e.others.y),
        vec3<f32>(e.others.x, e.diagonal.y, e.others.z),
        vec3<f32>(e.others.y, e.others.z, e.diagonal.z),
    );
    let from_centre = frame.views[eye].eye - e.centre;
    // M⁻¹ by its adjugate, whose columns are cross products of M's.
    let c0 = cross(m[1], m[2]);
    let c1 = cross(m[2], m[0]);
    let c2 = cross(m[0], m[1]);
    let determinant = dot(m[0], c0);
    let scaled = vec3<f32>(dot(c0, from_centre), dot(c1, from_centre), dot(c2, from_centre));
    let o = scaled / determinant;
    let distance_squared = dot(o, o);
    // The comparisons fail for NaN, for a shape without volume and for what lies absurdly far.
    if !(distance_squared > 1.0 && distance_squared < 1e12 && determinant > 0.0) {
        return Corner(NOWHERE, vec2<f32>(2.0), 0.0, 0.0);
    }
    // Wholly to the side or behind the eye; the trace bounds the greatest half axis, and 3 the
    // covering triangle's size and what perspective adds, up to a field of 120°.
    let middle = frame.views[eye].clip_from_stage * vec4<f32>(e.centre, 1.0);
    let reach = 3.0 * dot(e.diagonal, vec3<f32>(1.0));
    let scale = 2.0 * frame.views[eye].focal / frame.extent;
    let beside = abs(middle.xy) - middle.w > reach * (1.0 + scale);
    if (any(beside) || middle.w < -reach) {
        return Corner(NOWHERE, vec2<f32>(2.0), 0.0, 0.0);
    }
    let kappa = inverseSqrt(distance_squared);
    let to_eye = o * kappa;
    let s = select(-1.0, 1.0, to_eye.z >= 0.0);
    let a = -1.0 / (s + to_eye.z);
    let x_axis = vec3<f32>(1.0 + s * to_eye.x * to_eye.x * a, s * to_eye.x * to_eye.y * a, -s * to_eye.x);
    let y_axis = cross(to_eye, x_axis);
    let place = CORNERS[index];
    let radius = sqrt((1.0 - kappa) / (1.0 + kappa));
    let on_plane = to_eye + radius * (place.x * x_axis + place.y * y_axis);
    let clip = frame.views[eye].clip_from_stage * vec4<f32>(e.centre + m * on_plane, 1.0);
    return Corner(clip, place, kappa, determinant);
}
