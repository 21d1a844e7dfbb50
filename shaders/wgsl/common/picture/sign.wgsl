//! A sign as rays meet it: a disc that shows the middle of an image. Its back is not seen, and no layer shows it a second time.

//!include common/picture/panel.wgsl

/// sRGB-encoded.
@group(0) @binding(14) var sign_image: texture_2d_array<f32>;

/// Whether the frame has one; the same for all pixels, so that without one they do no more than this.
fn has_sign() -> bool {
    return frame.sign_from_stage[3].w != 0.0;
}

fn meets_sign(origin: vec3<f32>, direction: vec3<f32>) -> OnPanel {
    return meets_face(frame.sign_from_stage, origin, direction);
}

fn is_on_sign(at: vec2<f32>) -> bool {
    return dot(at, at) <= 1.0;
}

/// Its light, as displayed.
fn sign_light(at: vec2<f32>) -> vec3<f32> {
    let place = vec2<f32>(0.5, 0.5) + vec2<f32>(0.5, -0.5) * at;
    return decoded(textureSampleLevel(sign_image, between, place, 0u, 0.0).rgb);
}

/// What of the pixel with its middle at `place` the sign takes, where it is nearer than view depth `end`.
fn sign_seen(eye: u32, place: vec2<f32>, end: f32) -> PanelSeen {
    var seen = PanelSeen(vec3<f32>(0.0), 0.0, 1e9, false);
    if (!has_sign()) { return seen; }
    let origin = frame.views[eye].eye;
    let middle = meets_sign(origin, seen_along(eye, place));
    seen.depth = middle.way;
    if (middle.way >= end || !is_on_panel(middle.at, REACHES)) { return seen; }
    for (var n = 0u; n < 4u; n++) {
        let on = meets_sign(origin, seen_along(eye, place + TAPS[n]));
        if (on.way < 1e9 && is_on_sign(on.at)) {
            seen.light += sign_light(on.at);
            seen.share += 0.25;
        }
    }
    seen.light *= 0.25 / max(seen.share, 0.25);
    return seen;
}
