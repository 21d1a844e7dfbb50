//! A vessel's glass, blended over the finished picture: first the faces that look away from the
//! eye, then those that look at it.

//!include common/frame.wgsl
//!include common/mesh.wgsl
//!include common/daylight.wgsl

struct VesselDraw {
    /// From the vessel's frame; rigid.
    stage_from_vessel: mat4x4<f32>,
}

var<immediate> vessel: VesselDraw;

struct Varyings {
    @builtin(position) clip: vec4<f32>,
    @location(0) from_eye: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) across: f32,
    @location(3) @interpolate(flat) material: u32,
}

const MATERIAL_ENAMEL = 1u;
/// Reflectance of white enamel.
const ENAMEL = 0.8;

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(view_index) eye: u32) -> Varyings {
    let corner = vertices[index];
    let position = vessel.stage_from_vessel * vec4<f32>(corner.position, 1.0);
    var clip = frame.views[eye].clip_from_stage * position;
    // A foot lies in the bench's own plane: nearer by 0.02 % it does not fight with it.
    clip.z *= 1.0002;
    return Varyings(
        clip,
        position.xyz - frame.views[eye].eye,
        (vessel.stage_from_vessel * vec4<f32>(corner.normal, 0.0)).xyz,
        corner.across,
        corner.material,
    );
}

/// Reflectance of borosilicate glass (n = 1.47) at normal incidence, ((n−1)/(n+1))².
const NORMAL_REFLECTANCE = 0.036;
/// What one wall seen at right angles takes from the light; a slanting path takes more.
const WALL_ABSORPTION = 0.05;
/// Light that the wall's inside scatters to the eye: the greenish edge of clear glass.
const EDGE = vec3<f32>(0.06, 0.095, 0.09);

/// Colour premultiplied by its opacity.
@fragment
fn fragment(in: Varyings, @builtin(view_index) eye: u32) -> @location(0) vec4<f32> {
    let to_eye = -normalize(in.from_eye);
    let outward = normalize(in.normal);
    let normal = select(-outward, outward, dot(outward, to_eye) > 0.0);
    // No steeper than a pixel can show: a silhouette thinner than that would break into dots.
    let cosine = dot(normal, to_eye);
    let facing = max(max(cosine, fwidth(cosine)), 0.18);
    let rest = 1.0 - facing;
    let rest_squared = rest * rest;
    let reflectance =
        NORMAL_REFLECTANCE + (1.0 - NORMAL_REFLECTANCE) * rest_squared * rest_squared * rest;
    let mirrored = surroundings(reflect(-to_eye, normal));
    let absorbed = 1.0 - exp(-WALL_ABSORPTION / facing);
    // The rays that miss the eye are missing mostly at the edges, which look dark.
    let opacity = reflectance + (1.0 - reflectance) * absorbed;
    let light = reflectance * mirrored + (1.0 - reflectance) * absorbed * EDGE;
    if in.material == MATERIAL_ENAMEL {
        // Half of the strip is the line; a pixel wider than that has its share of it.
        let width = max(fwidth(in.across), 1e-6);
        let covered = saturate((0.5 - abs(in.across)) / width + 0.5) * min(1.0, 1.0 / width);
        let key = key_light((in.from_eye + frame.views[eye].eye) * frame.metres_per_unit);
        let lit = ENAMEL * (ambient_light(normal.y) + max(dot(normal, key.direction), 0.0) * key.light);
        return vec4<f32>(display(lit) * covered, covered);
    }
    // Tone mapping bends, so it is for the colour as if opaque; the opacity goes on after.
    return vec4<f32>(display(light / opacity) * opacity, opacity);
}
