//! What every pass of the picture knows of its frame. Lengths are in the scene's unit, of which
//! `metres_per_unit` says how long it is drawn; clip space has y down and depth reversed
//! (near / distance: 1 at the near plane, 0 at infinity).

/// One eye.
struct View {
    /// Projection times the inverse of the eye's pose.
    clip_from_stage: mat4x4<f32>,
    /// Where the eye is in the stage, in the scene's unit.
    eye: vec3<f32>,
    /// Distance of the near plane, in the scene's unit.
    near: f32,
    /// The inverse projection, of a frustum that need not be symmetric, as three vectors in the
    /// stage: what is seen at pixel (x, y) at the view depth z (along the eye's axis) lies at
    /// eye + z (corner + x across + y down).
    corner: vec3<f32>,
    /// Pixels that a length across takes up at a view depth of one.
    focal: f32,
    /// To the next pixel of a row, at a view depth of one.
    across: vec3<f32>,
    /// To the next row, at a view depth of one.
    down: vec3<f32>,
    /// Where the view lies in the eye's own picture, of which it may be a part: its upper left corner, and its width and height, over
    /// the picture's.
    in_picture: vec4<f32>,
}

/// A capsule that keeps daylight from the bench: a vessel, roughly.
struct Blocker {
    /// Centre of the lower end's sphere.
    foot: vec3<f32>,
    /// Radius of both spheres.
    radius: f32,
    /// Centre of the upper end's sphere.
    top: vec3<f32>,
    /// Share of the daylight that it keeps away, 0 to 1.
    opacity: f32,
}

/// A vessel as rays meet it: the inner surface of revolution, about the y axis of its frame.
struct Vessel {
    /// From the stage; rigid.
    vessel_from_stage: mat4x4<f32>,
    /// Inner radii at 16 even heights from the inner floor to the rim.
    radii: array<vec4<f32>, 4>,
    /// Height of the inner floor.
    inner_floor: f32,
    /// Height of the rim.
    rim: f32,
    /// Largest radius of the outer surface.
    outer: f32,
    /// Thickness of the wall's glass, half-way up.
    wall: f32,
    /// The first of its outline's segments in `common/picture/glass_light.wgsl`'s table, and the one after its last.
    segments: vec2<u32>,
    /// Likewise its graduation marks.
    marks: vec2<u32>,
    /// 0 of a whole vessel; of a shard one more than its number, see `common/picture/shard.wgsl`.
    piece: u32,
    /// Height up to which the base of a broken vessel goes.
    base: f32,
    /// The first row of its label in the same table, and 0 without one.
    label: u32,
}

/// The uniforms of one frame.
struct Frame {
    /// One or two eyes.
    views: array<View, 2>,
    /// Colours of the chosen attribute, linear, evenly spaced over its range.
    colour_map: array<vec4<f32>, 17>,
    /// The first `blocker_count` count.
    blockers: array<Blocker, 8>,
    /// Whole ones, as many as there are blockers and in the same order, and then shards: `glass_count` in all.
    vessels: array<Vessel, 24>,
    /// Hot plates in the table's top: x and z of a middle and its radius, in the scene's unit; those behind the last one have no radius.
    plates: array<vec4<f32>, 8>,
    /// Low corner of the table; its high corner is no higher where there is none.
    table_min: vec3<f32>,
    /// How many blockers there are.
    blocker_count: u32,
    /// High corner of the table.
    table_max: vec3<f32>,
    /// Length of the scene's unit as drawn, metres.
    metres_per_unit: f32,
    /// Low corner of the room, seen from within.
    room_min: vec3<f32>,
    /// Particle spacing d of the liquid, in the scene's unit.
    spacing: f32,
    /// High corner of the room.
    room_max: vec3<f32>,
    /// Tiles in a row of the picture, and rows of tiles.
    tile_columns: u32,
    /// Width and height of a view as drawn, pixels.
    extent: vec2<f32>,
    /// The same of the images and arrays that hold it, in whose upper left corner it is.
    held: vec2<f32>,
    /// Rows of tiles of a view.
    tile_rows: u32,
    /// How many vessels and shards there are.
    glass_count: u32,
    /// How many eyes there are.
    view_count: u32,
    /// Whether the lenses hide a part of the picture.
    hides: u32,
    /// What water absorbs of red, green and blue light, 1/m.
    water: vec3<f32>,
    /// Side of a cell in which rays look for bubbles, in the scene's unit.
    bubble_cell: f32,
    /// What pure acid absorbs, 1/m.
    acid: vec3<f32>,
    /// Share of the light that is shown: less where the picture fades.
    shown: f32,
    /// How much acid is on the user's goggles, 0 to 1.
    goggles: f32,
    /// The window's light, and that of ceiling and floor, over those of `daylight.wgsl`.
    window_level: f32,
    sky_level: f32,
    /// What light is multiplied by before it is tone mapped.
    exposure: f32,
    /// Whether there is more in the room than table and window.
    furnished: u32,
    /// To the panel's frame: right, up and out of its face, over half its width and height and in the scene's unit; 0 where there
    /// is none.
    panel_from_stage: mat4x4<f32>,
    /// The same of a sign.
    sign_from_stage: mat4x4<f32>,
    /// The same of a pane of glass.
    pane_from_stage: mat4x4<f32>,
}

@group(0) @binding(0) var<uniform> frame: Frame;

/// Direction to what is seen at a place of the picture (pixels), of view depth 1.
fn seen_along(eye: u32, pixel: vec2<f32>) -> vec3<f32> {
    let view = &frame.views[eye];
    return (*view).corner + pixel.x * (*view).across + pixel.y * (*view).down;
}

/// Where a pixel is in arrays of all eyes' pixels, row by row, eye by eye.
fn pixel_index(pixel: vec2<i32>, eye: u32) -> u32 {
    let held = vec2<u32>(frame.held);
    return (eye * held.y + u32(pixel.y)) * held.x + u32(pixel.x);
}

/// The nearest pixel of the picture.
fn within_picture(pixel: vec2<i32>) -> vec2<i32> {
    return clamp(pixel, vec2<i32>(0), vec2<i32>(frame.extent) - 1);
}
