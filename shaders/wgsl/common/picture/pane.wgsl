//! A flat pane of glass over what is behind it, from either side: the sash of a fume hood. Its sides are parallel, so it bends nothing.

//!include common/picture/fresnel.wgsl
//!include common/picture/room.wgsl

/// Of soda-lime glass.
const PANE_INDEX = 1.52;
/// Share of the light that 6 mm of it take, of red, green and blue: float glass of 6 mm lets some 88 % through, of which 8 % are
/// mirrored (EN 410 gives 0.88 to 0.89).
const PANE_TAKES = vec3<f32>(0.05, 0.03, 0.04);

/// What of the pixel with its middle at `place` is seen of the pane, and how much of what is behind, where the pane is nearer than view depth `end`: `light`
/// as displayed.
struct PaneSeen {
    light: vec3<f32>,
    open: vec3<f32>,
    /// View depth; 1e9 where it is not seen.
    way: f32,
}

fn pane_over(eye: u32, place: vec2<f32>, end: f32) -> PaneSeen {
    let none = PaneSeen(vec3<f32>(0.0), vec3<f32>(1.0), 1e9);
    // The same for all pixels: without one they do no more than this.
    if (frame.pane_from_stage[3].w == 0.0) { return none; }
    let direction = seen_along(eye, place);
    let from_ = (frame.pane_from_stage * vec4<f32>(frame.views[eye].eye, 1.0)).xyz;
    let along = (frame.pane_from_stage * vec4<f32>(direction, 0.0)).xyz;
    let way = -from_.z / select(along.z, 1e-9, abs(along.z) < 1e-9);
    let at = from_.xy + way * along.xy;
    if (way <= frame.views[eye].near || way >= end || any(abs(at) > vec2<f32>(1.0))) { return none; }
    // Its rows are the pane's axes over their lengths.
    let rows = transpose(frame.pane_from_stage);
    let normal = normalize(rows[2].xyz);
    let sight = normalize(direction);
    let face = fresnel(abs(dot(sight, normal)), PANE_INDEX);
    // Both faces, and what goes to and fro between them.
    let mirrored = 2.0 * face / (1.0 + face);
    let light = mirrored * mirrored_light(frame.views[eye].eye + way * direction, reflect(sight, normal));
    return PaneSeen(display(light), (1.0 - mirrored) * (1.0 - PANE_TAKES), way);
}
