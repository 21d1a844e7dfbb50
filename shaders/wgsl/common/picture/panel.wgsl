//! The panel as rays meet it: a rectangle with an image on its face. Its back is not seen.
//!
//! A runtime may show the same image in a layer of its own under the picture, and sample it once, where the picture's samples are
//! sampled again. So `see_through` says where that layer is to be seen in place of the picture.

//!include common/picture/frame.wgsl
//!include common/picture/panel_light.wgsl

/// Share of its half sides that the panel is seen through to the layer under it: what filters and moves the picture takes in
/// some pixels around, and beyond the layer's edge there is nothing.
const SEEN_THROUGH = 0.985;
/// Beyond half sides, up to which a pixel may have a part of it.
const REACHES = 1.1;

/// Where a ray meets a panel's plane.
struct OnPanel {
    /// In lengths of the ray's direction; 1e9 where it does not meet the face of it.
    way: f32,
    /// From the middle to the right and up, over half the sides.
    at: vec2<f32>,
}

fn meets_face(face_from_stage: mat4x4<f32>, origin: vec3<f32>, direction: vec3<f32>) -> OnPanel {
    let from_ = (face_from_stage * vec4<f32>(origin, 1.0)).xyz;
    let along = (face_from_stage * vec4<f32>(direction, 0.0)).xyz;
    // Without a panel all of it is 0.
    let faces = from_.z > 0.0 && along.z < 0.0;
    let way = select(1e9, -from_.z / along.z, faces);
    return OnPanel(way, from_.xy + way * along.xy);
}

fn meets_panel(origin: vec3<f32>, direction: vec3<f32>) -> OnPanel {
    return meets_face(frame.panel_from_stage, origin, direction);
}

fn is_on_panel(at: vec2<f32>, half: f32) -> bool {
    return all(abs(at) <= vec2<f32>(half));
}

/// What of a pixel the panel takes.
struct PanelSeen {
    /// Its light, as displayed.
    light: vec3<f32>,
    /// The share of the pixel.
    share: f32,
    /// View depth in the pixel's middle.
    depth: f32,
    /// Whether a layer under the picture may be seen in its place.
    see_through: bool,
}

/// What of the pixel with its middle at `place` the panel takes, where it is nearer than view depth `end`.
fn panel_seen(eye: u32, place: vec2<f32>, end: f32) -> PanelSeen {
    let origin = frame.views[eye].eye;
    let middle = meets_panel(origin, seen_along(eye, place));
    var seen = PanelSeen(vec3<f32>(0.0), 0.0, middle.way, false);
    if (middle.way >= end || !is_on_panel(middle.at, REACHES)) { return seen; }
    for (var n = 0u; n < 4u; n++) {
        let on = meets_panel(origin, seen_along(eye, place + TAPS[n]));
        if (on.way < 1e9 && is_on_panel(on.at, 1.0)) {
            seen.light += panel_light(on.at);
            seen.share += 0.25;
        }
    }
    seen.light *= 0.25 / max(seen.share, 0.25);
    seen.see_through = is_on_panel(middle.at, SEEN_THROUGH);
    return seen;
}
