//! How finely a tile is shaded: by how far it is seen from the fovea, the direction in which the picture is to be sharp.

//!include common/picture/frame.wgsl
//!include common/picture/panel.wgsl
//!include common/picture/tile_marks.wgsl

struct Fovea {
    /// Unit vector in the stage.
    towards: vec3<f32>,
    /// Cosine of the angle within which every pixel is shaded; less than -1 where all are.
    sharp: f32,
}

struct Foveae {
    of_views: array<Fovea, 2>,
    /// Cosine of the angle beyond which blocks of four by four pixels are shaded where nothing is but the room.
    quarter: f32,
}

var<immediate> foveae: Foveae;

/// Pixels beyond a tile whose colours its smoothed edges may take in: half of `SPAN` of `finish.wgsl`, the sampler's and its
/// neighbour's.
const SMOOTHED_OVER = 6.0;
/// What is seen by its edges: tiles of it are shaded in blocks of two by two at the least.
const MARK_OUTLINES = MARK_LIQUID | MARK_VESSELS | MARK_EDGE | MARK_HANDS | MARK_SPHERES;

/// Cosine of the angle between the fovea and the nearest place of an edge from `from_` to `from_ + along`, directions as seen.
fn nearest_on(towards: vec3<f32>, from_: vec3<f32>, along: vec3<f32>) -> f32 {
    let fa = dot(towards, from_);
    let fb = dot(towards, along);
    let aa = dot(from_, from_);
    let ab = dot(from_, along);
    let bb = dot(along, along);
    // Where the derivative of the cosine by the place is zero: on a line there is one such place.
    let below = fb * ab - fa * bb;
    let place = saturate((fa * ab - fb * aa) / select(below, -1e-20, below == 0.0));
    let there = normalize(from_ + place * along);
    return max(dot(towards, there), max(dot(towards, normalize(from_)), dot(towards, normalize(from_ + along))));
}

/// Cosine of the least angle between the fovea and what is seen between two places of the picture (pixels).
fn nearest_to_fovea(eye: u32, low: vec2<f32>, high: vec2<f32>) -> f32 {
    let towards = foveae.of_views[eye].towards;
    let view = &frame.views[eye];
    let corner = seen_along(eye, low);
    let across = (high.x - low.x) * (*view).across;
    let down = (high.y - low.y) * (*view).down;
    // The fovea's own place, in sides of the rectangle: the view's plane is at right angles to its axis.
    let axis = cross((*view).across, (*view).down);
    let ahead = dot(towards, axis) / dot(corner, axis);
    let aside = towards / select(ahead, 1e-20, ahead == 0.0) - corner;
    let at = vec2<f32>(dot(aside, across) / dot(across, across), dot(aside, down) / dot(down, down));
    if (ahead > 0.0 && all(at >= vec2<f32>(0.0)) && all(at <= vec2<f32>(1.0))) { return 1.0; }
    let upright = max(nearest_on(towards, corner, down), nearest_on(towards, corner + across, down));
    let level = max(nearest_on(towards, corner, across), nearest_on(towards, corner + down, across));
    return max(upright, level);
}

/// Whether something flat may be seen between two places of the picture: within the box around its corners.
fn may_show(face_from_stage: mat4x4<f32>, eye: u32, low: vec2<f32>, high: vec2<f32>) -> bool {
    let rows = transpose(face_from_stage);
    // Without one all of it is 0.
    if (dot(rows[0].xyz, rows[0].xyz) == 0.0) { return false; }
    var first = frame.extent;
    var last = vec2<f32>(0.0);
    var behind = 0u;
    for (var corner = 0u; corner < 4u; corner++) {
        let side = select(vec2<f32>(-REACHES), vec2<f32>(REACHES), (vec2<u32>(corner) & vec2<u32>(1u, 2u)) != vec2<u32>(0u));
        // The rows are at right angles to one another, each with its own length.
        var place = vec3<f32>(0.0);
        let wanted = vec3<f32>(side, 0.0);
        for (var axis = 0u; axis < 3u; axis++) {
            place += rows[axis].xyz * ((wanted[axis] - rows[axis].w) / dot(rows[axis].xyz, rows[axis].xyz));
        }
        let clip = frame.views[eye].clip_from_stage * vec4<f32>(place, 1.0);
        let near = clip.w < frame.views[eye].near;
        let at = (0.5 + 0.5 * clip.xy / max(clip.w, 1e-9)) * frame.extent;
        first = select(min(first, at), vec2<f32>(0.0), near);
        last = select(max(last, at), frame.extent, near);
        behind += select(0u, 1u, near);
    }
    return behind < 4u && all(first <= high) && all(last >= low);
}

/// Pixels along a block of a tile of which one is shaded: 1, 2 or 4.
fn block_side(eye: u32, low: vec2<u32>, high: vec2<u32>, marks: u32) -> u32 {
    if (foveae.of_views[eye].sharp < -1.0) { return 1u; }
    let first = vec2<f32>(low) - SMOOTHED_OVER;
    let last = vec2<f32>(high) + SMOOTHED_OVER;
    let nearest = nearest_to_fovea(eye, first, last);
    // Text is read wherever it is.
    let is_sharp = nearest >= foveae.of_views[eye].sharp
        || may_show(frame.panel_from_stage, eye, first, last)
        || may_show(frame.sign_from_stage, eye, first, last);
    if (is_sharp) { return 1u; }
    return select(4u, 2u, nearest >= foveae.quarter || (marks & MARK_OUTLINES) != 0u);
}
