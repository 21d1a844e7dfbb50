//! What the room has beyond the table: tiles and paint, the window, benches along the wall, a shelf with bottles, a fume hood, signs.
//! All of it is flat rectangles, each over the ones behind it, whose edges are as soft as a pixel.
//!
//! None of it is in the way of anything: no hand or vessel touches it. Lengths in metres, in the stage.

//!include common/picture/bottles.wgsl
//!include common/picture/room_parts.wgsl
//!include common/picture/signs.wgsl
//!include common/picture/worktop.wgsl

const PAINT = vec3<f32>(0.62, 0.60, 0.56);
const FLOORING = vec3<f32>(0.20, 0.19, 0.18);
const TILE_WHITE = vec3<f32>(0.68, 0.69, 0.68);
const GROUT = vec3<f32>(0.40, 0.40, 0.39);
const OAK = vec3<f32>(0.44, 0.31, 0.18);
/// Cupboards' fronts are pale: they are what glass on the bench is seen before.
const MAPLE = vec3<f32>(0.50, 0.44, 0.36);
const RESIN = vec3<f32>(0.055, 0.060, 0.066);
const STEEL = vec3<f32>(0.42, 0.43, 0.44);
const HOOD = vec3<f32>(0.52, 0.54, 0.55);

/// The bench along the back wall: its top, and how far from the wall it and its fronts reach.
const COUNTER_TOP = 0.90;
const COUNTER = -1.10;
const FRONTS = -1.13;
/// The shelf: low and high corner of its front (x, y), its front's z, and the height of a board over the one below.
const SHELF_LOW = vec2<f32>(-0.46, 1.46);
const SHELF_HIGH = vec2<f32>(0.46, 2.242);
const SHELF_FRONT = -1.48;
const SHELF_STEP = 0.38;
const BOARD = 0.022;
/// The hood: corners of its front (x, y), its front's z, and corners of its opening.
const HOOD_LOW = vec2<f32>(0.84, 0.90);
const HOOD_HIGH = vec2<f32>(2.10, 2.48);
const HOOD_FRONT = -1.00;
const OPENING_LOW = vec2<f32>(0.93, 0.96);
const OPENING_HIGH = vec2<f32>(2.01, 1.92);
/// The height of its ceiling.
const HOOD_INNER_TOP = 2.15;
/// Its sash's lower edge.
const HOOD_SASH = 1.44;
/// The poster's lower left corner, the edge of its cells, and how many it has; the signs' middles and half their sizes.
const POSTER = vec2<f32>(-1.48, 1.52);
const POSTER_CELL = 0.046;
const POSTER_SIZE = vec2<f32>(20.0, 12.0);
const CORROSIVE = vec3<f32>(0.65, 1.92, 0.15);
const EYE_PROTECTION = vec3<f32>(0.65, 1.62, 0.11);
const EYE_WASH = vec3<f32>(0.65, 1.34, 0.10);
/// The ceiling's lamps.
const LAMP_LIGHT = vec3<f32>(2.6, 2.6, 2.5);
/// The lamp in the hood: what it gives to a surface right under it.
const HOOD_LAMP = vec3<f32>(1.0, 1.0, 0.95);

/// What is seen, gathered from the nearest on.
struct Far {
    light: vec3<f32>,
    /// How far it is, in lengths of the ray's direction.
    way: f32,
    /// The share of the pixel that is still to be filled.
    open: f32,
}

fn put_behind(before: Far, layer: Layer, light: vec3<f32>) -> Far {
    let left = before.open * (1.0 - layer.share);
    return Far(
        before.light + before.open * layer.share * light,
        select(before.way, layer.way, before.open > 0.5 && left <= 0.5),
        left,
    );
}

/// How much of the hemisphere's light gets to a wall's place: less in corners, where the next wall is `near` metres away.
fn corner_shade(near: f32) -> f32 {
    let far = near / 0.16;
    return 1.0 - 0.42 / (1.0 + far * far);
}

/// How much of the pixel at that place of the window's wall is panes: (z, y) from the window's middle; `sharp` is one over a pixel's width, 1/m.
fn panes_at(at: vec2<f32>, sharp: f32) -> f32 {
    let place = abs(at);
    let inside = saturate((WINDOW_HALF - place) * sharp + 0.5);
    let bars = saturate((place - WINDOW_BAR) * sharp + 0.5);
    return inside.x * inside.y * bars.x * bars.y;
}

/// The wall itself, the floor or the ceiling, at `at`.
fn wall_light(ray: Sight, at: vec3<f32>, way: f32, normal: vec3<f32>) -> vec3<f32> {
    let low = frame.room_min * frame.metres_per_unit;
    let high = frame.room_max * frame.metres_per_unit;
    let beside = min(at - low, high - at) + 9.0 * abs(normal);
    let open = corner_shade(min(beside.x, min(beside.y, beside.z)));
    let cosine = clamp(abs(dot(normal, ray.direction)), 1e-3, 1.0);
    let sharp = cosine / (way * ray.fine + 1e-6);
    if (normal.y > 0.5) {
        let grout = max(lines(at.x, 1.0 / 0.6, 0.004, sharp), lines(at.z, 1.0 / 0.6, 0.004, sharp));
        return floor_light(at, FLOORING * (1.0 - 0.35 * grout), open);
    }
    if (normal.y < -0.5) {
        // Two rows of lamps along x.
        let lamps = in_rectangle(vec2<f32>(abs(at.x - 0.4), abs(at.z - 0.2)), vec2<f32>(0.15, 0.62), vec2<f32>(1.35, 0.86), sharp);
        let joints = max(lines(at.x - 0.4, 1.0 / 0.6, 0.006, sharp), lines(at.z - 0.2, 1.0 / 0.62, 0.006, sharp));
        return mix(lit(PAINT * (1.0 - 0.2 * joints), at, normal, open), frame.sky_level * LAMP_LIGHT, lamps);
    }
    if (normal.x > 0.5) {
        let place = vec2<f32>(at.z - WINDOW.z, at.y - WINDOW.y);
        let frame_ = in_rectangle(abs(place), vec2<f32>(-1.0), WINDOW_HALF + 0.06, sharp);
        let sill = in_rectangle(place, vec2<f32>(-WINDOW_HALF.x - 0.10, -WINDOW_HALF.y - 0.11), vec2<f32>(WINDOW_HALF.x + 0.10, -WINDOW_HALF.y - 0.06), sharp);
        let wall = lit(mix(PAINT, vec3<f32>(0.30, 0.31, 0.32), max(frame_, sill)), at, normal, open);
        return mix(wall, pane_light(), panes_at(place, sharp));
    }
    if (normal.x < -0.5) {
        // A door.
        let door = in_rectangle(at.zy, vec2<f32>(0.9, 0.0), vec2<f32>(1.85, 2.05), sharp);
        let leaf = in_rectangle(at.zy, vec2<f32>(0.95, 0.0), vec2<f32>(1.80, 2.0), sharp);
        return lit(mix(mix(PAINT, STEEL, door), OAK, leaf), at, normal, open);
    }
    if (normal.z < -0.5) { return lit(PAINT, at, normal, open); }
    return back_wall(at, normal, open, sharp);
}

/// The floor: the table keeps the sky and the window from what is under it.
fn floor_light(at: vec3<f32>, albedo: vec3<f32>, open: f32) -> vec3<f32> {
    let low = frame.table_min * frame.metres_per_unit;
    let high = frame.table_max * frame.metres_per_unit;
    let rise = max(high.y - at.y, 1e-3);
    let key = key_light(at);
    let middle = 0.5 * (low.xz + high.xz);
    let half = 0.5 * (high.xz - low.xz);
    let blurs = rise * vec2<f32>(1.1, WINDOW_ANGLE * 2.0);
    let above = abs(at.xz - middle);
    let lit_through = abs(at.xz + key.direction.xz * (rise / max(key.direction.y, 0.05)) - middle);
    let under = 1.0 - smoothstep(half - blurs.x * 0.6, half + blurs.x * 0.6, above);
    let shaded = 1.0 - smoothstep(half - blurs.y, half + blurs.y, lit_through);
    let sky = open * (1.0 - 0.85 * under.x * under.y);
    return albedo * (sky * ambient_light(1.0) + max(key.direction.y, 0.0) * (1.0 - 0.9 * shaded.x * shaded.y) * key.light);
}

fn with_signs(wall: vec3<f32>, at: vec2<f32>, sharp: f32) -> vec3<f32> {
    var albedo = wall;
    let poster = (at - POSTER) / POSTER_CELL;
    let on_poster = in_rectangle(poster, vec2<f32>(0.0), POSTER_SIZE, sharp * POSTER_CELL);
    if (on_poster > 0.0) { albedo = mix(albedo, periodic_table(poster, sharp * POSTER_CELL), on_poster); }
    if (abs(at.x - CORROSIVE.x) < 0.2) {
        var sign = corrosive((at - CORROSIVE.xy) / CORROSIVE.z, sharp * CORROSIVE.z);
        if (at.y < 1.76) { sign = eye_protection((at - EYE_PROTECTION.xy) / EYE_PROTECTION.z, sharp * EYE_PROTECTION.z); }
        if (at.y < 1.47) { sign = eye_wash((at - EYE_WASH.xy) / EYE_WASH.z, sharp * EYE_WASH.z); }
        albedo = mix(albedo, sign.rgb, sign.a);
    }
    return albedo;
}

/// The wall that the user faces: tiles up to the shelf, paint, signs and a poster.
fn back_wall(at: vec3<f32>, normal: vec3<f32>, open: f32, sharp: f32) -> vec3<f32> {
    var albedo = PAINT;
    let tiled = saturate((SHELF_LOW.y - 0.02 - at.y) * sharp + 0.5);
    if (tiled > 0.0) {
        let grout = max(lines(at.x, 1.0 / 0.15, 0.003, sharp), lines(at.y - COUNTER_TOP, 1.0 / 0.15, 0.003, sharp));
        albedo = mix(albedo, mix(TILE_WHITE, GROUT, grout), tiled);
    }
    if (sees(SEES_FURNITURE)) { albedo = with_signs(albedo, at.xy, sharp); }
    // Less light over the counter, under the shelf and beside the hood.
    let under_shelf = max(abs(at.x) - SHELF_HIGH.x, 0.0) + max(SHELF_LOW.y - at.y, 0.0);
    let near = saturate(1.0 - vec3<f32>(3.5 * (at.y - COUNTER_TOP), 2.5 * (HOOD_LOW.x - at.x), 3.5 * under_shelf));
    let sky = open * (1.0 - 0.38 * min(dot(near, near), 1.0));
    return lit(albedo, at, normal, sky);
}

/// The bench along the wall.
fn counter(before: Far, ray: Sight) -> Far {
    var seen = before;
    let low = frame.room_min * frame.metres_per_unit;
    let high = frame.room_max * frame.metres_per_unit;
    let up = vec3<f32>(0.0, 1.0, 0.0);
    let out = vec3<f32>(0.0, 0.0, 1.0);
    let front = on_z(ray, FRONTS, vec2<f32>(low.x, 0.0), vec2<f32>(high.x, COUNTER_TOP));
    if (front.share > 0.0) {
        let at = front.at;
        let sharp = front.sharp;
        let door = vec2<f32>((fract(at.x / 0.5 + 0.2) - 0.5) * 0.5, at.y);
        let grain = 0.92 + 0.16 * lot(u32(floor(at.x / 0.5 + 0.2) + 64.0) * 2u + select(0u, 1u, at.y > 0.66), 0u);
        var albedo = MAPLE * grain;
        let gaps = max(lines(at.x + 0.1, 2.0, 0.004, sharp), in_rectangle(at.xy, vec2<f32>(-9.0, 0.658), vec2<f32>(9.0, 0.662), sharp));
        albedo *= 1.0 - 0.7 * gaps;
        let handles = in_rectangle(vec2<f32>(door.x, abs(at.y - 0.665)), vec2<f32>(-0.06, 0.045), vec2<f32>(0.06, 0.057), sharp);
        albedo = mix(albedo, STEEL, handles);
        albedo = mix(albedo, vec3<f32>(0.06), saturate((0.10 - at.y) * sharp + 0.5));
        let lip = saturate((at.y - COUNTER_TOP + 0.03) * sharp + 0.5);
        let open = mix(corner_shade(max(COUNTER_TOP - 0.03 - at.y, 0.0) * 2.0) * corner_shade(at.y * 0.7), 1.0, lip);
        seen = put_behind(seen, front, lit(mix(albedo, 3.0 * RESIN, lip), at, out, open));
    }
    if (seen.open == 0.0) { return seen; }
    let top = on_y(ray, COUNTER_TOP, vec2<f32>(low.x, low.z), vec2<f32>(high.x, COUNTER + 0.002));
    if (top.share > 0.0 && ray.direction.y < 0.0) {
        let open = corner_shade(max(top.at.z - low.z, 0.0)) * (1.0 - 0.5 * saturate(4.0 * (top.at.x - HOOD_LOW.x) + 0.5));
        // Resin has a sheen of the wall behind it.
        let rest = 1.0 - saturate(abs(ray.direction.y) * inverseSqrt(dot(ray.direction, ray.direction)));
        let sheen = 0.04 + 0.6 * rest * rest * rest * rest * rest;
        seen = put_behind(seen, top, lit(RESIN, top.at, up, open) + sheen * open * lit(TILE_WHITE, top.at, out, 1.0));
    }
    return seen;
}

/// The shelf's front and what is in it.
fn shelf_front(ray: Sight, front: Layer) -> vec3<f32> {
    let low = frame.room_min.z * frame.metres_per_unit;
    let at = front.at;
    // The compartment behind, between two boards.
    let row = floor((at.y - SHELF_LOW.y - 0.5 * BOARD) / SHELF_STEP);
    let base = SHELF_LOW.y + row * SHELF_STEP + BOARD;
    let inner_low = vec3<f32>(SHELF_LOW.x + BOARD, base, low + 0.01);
    let inner_high = vec3<f32>(SHELF_HIGH.x - BOARD, base + SHELF_STEP - BOARD, SHELF_FRONT);
    let leaves = out_of_box(ray, at, inner_low, inner_high);
    let place = at + leaves.w * ray.direction;
    let beside = min(place - inner_low, vec3<f32>(inner_high.xy, 9.0) - place) + 9.0 * abs(leaves.xyz);
    let near = corner_shade(min(beside.x, beside.y)) * corner_shade(beside.z);
    // Deeper in it is darker.
    let open = (0.85 - 0.35 * saturate((SHELF_FRONT - place.z) * 4.5)) * near;
    var light = 0.85 * lit(MAPLE, place, leaves.xyz, open);
    let glass = on_z(ray, SHELF_FRONT - 0.11, SHELF_LOW, SHELF_HIGH);
    if (glass.way < front.way + leaves.w) {
        let bottle = bottles(glass.at.xy - SHELF_LOW - vec2<f32>(BOARD), SHELF_STEP, glass.at, glass.sharp);
        light = mix(light, bottle.rgb, bottle.a);
    }
    let across = at.y - base + BOARD;
    let boards = max(saturate((BOARD - across) * front.sharp + 0.5), saturate((across - SHELF_STEP) * front.sharp + 0.5));
    let sides = saturate((abs(at.x) - SHELF_HIGH.x + BOARD) * front.sharp + 0.5);
    return mix(light, lit(1.15 * MAPLE, at, vec3<f32>(0.0, 0.0, 1.0), 1.0), max(boards, sides));
}

fn shelf(before: Far, ray: Sight) -> Far {
    var seen = before;
    let low = frame.room_min.z * frame.metres_per_unit;
    let front = on_z(ray, SHELF_FRONT, SHELF_LOW, SHELF_HIGH);
    if (front.share > 0.0) { seen = put_behind(seen, front, shelf_front(ray, front)); }
    if (seen.open == 0.0) { return seen; }
    let left = ray.origin.x < SHELF_LOW.x;
    if (left || ray.origin.x > SHELF_HIGH.x) {
        let side = on_x(ray, select(SHELF_HIGH.x, SHELF_LOW.x, left), vec2<f32>(SHELF_LOW.y, low), vec2<f32>(SHELF_HIGH.y, SHELF_FRONT + 0.002));
        if (side.share > 0.0) {
            seen = put_behind(seen, side, lit(MAPLE, side.at, vec3<f32>(select(1.0, -1.0, left), 0.0, 0.0), corner_shade(side.at.z - low)));
        }
    }
    if (ray.origin.y < SHELF_LOW.y) {
        let under = on_y(ray, SHELF_LOW.y, vec2<f32>(SHELF_LOW.x, low), vec2<f32>(SHELF_HIGH.x, SHELF_FRONT + 0.002));
        if (under.share > 0.0) { seen = put_behind(seen, under, lit(MAPLE, under.at, vec3<f32>(0.0, -1.0, 0.0), 0.8)); }
    }
    return seen;
}

/// The hood's front, and what is in it.
fn hood_front(ray: Sight, front: Layer) -> vec3<f32> {
    let low = frame.room_min.z * frame.metres_per_unit;
    let at = front.at;
    let sharp = front.sharp;
    let out = vec3<f32>(0.0, 0.0, 1.0);
    // The frame, a strip of slots above, a display on its right post.
    let slots = lines(at.y, 1.0 / 0.022, 0.008, sharp) * in_rectangle(at.xy, vec2<f32>(1.15, 2.20), vec2<f32>(1.79, 2.38), sharp);
    var light = lit(mix(HOOD, vec3<f32>(0.05), slots), at, out, corner_shade((at.y - COUNTER_TOP) * 2.0));
    let rail = in_rectangle(at.xy, OPENING_LOW - 0.012, OPENING_HIGH + 0.012, sharp);
    light = mix(light, lit(0.5 * STEEL, at, out, 1.0), rail);
    let display_ = in_rectangle(at.xy, vec2<f32>(2.035, 1.50), vec2<f32>(2.085, 1.56), sharp);
    light = mix(light, vec3<f32>(0.05, 0.55, 0.22), display_);
    let opening = in_rectangle(at.xy, OPENING_LOW, OPENING_HIGH, sharp);
    if (opening > 0.0) {
        let room_low = vec3<f32>(OPENING_LOW.x - 0.04, OPENING_LOW.y - 0.02, low + 0.06);
        let room_high = vec3<f32>(OPENING_HIGH.x + 0.04, HOOD_INNER_TOP, HOOD_FRONT);
        let leaves = out_of_box(ray, at, room_low, room_high);
        let place = at + leaves.w * ray.direction;
        let slit = in_rectangle(place.xy, vec2<f32>(0.98, 1.20), vec2<f32>(1.96, 1.215), sharp) + in_rectangle(place.xy, vec2<f32>(0.98, 1.70), vec2<f32>(1.96, 1.715), sharp);
        let albedo = mix(vec3<f32>(0.50, 0.51, 0.50), 1.5 * RESIN, saturate(leaves.y)) * (1.0 - 0.85 * select(0.0, slit, leaves.z > 0.5));
        let under = HOOD_INNER_TOP - place.y;
        let corner = min(place - room_low, room_high - place) + 9.0 * abs(leaves.xyz);
        let lamp = corner_shade(min(corner.x, corner.z)) * HOOD_LAMP / (1.0 + 1.5 * under * under);
        var inner = albedo * (0.75 * lamp + 0.35 * lit(vec3<f32>(1.0), place, out, 0.6));
        // The sash: glass, and a bar to pull.
        let glass = saturate((at.y - HOOD_SASH) * sharp + 0.5);
        let glint = 0.05 + 0.10 * saturate((at.y - HOOD_SASH) * 1.2) * saturate(1.0 - abs(at.x - at.y * 0.4 - 0.55) * 3.0);
        inner = mix(inner, 0.86 * inner + glint * vec3<f32>(0.9, 1.0, 1.0), glass);
        let bar = in_rectangle(at.xy, vec2<f32>(0.0, HOOD_SASH - 0.03), vec2<f32>(9.0, HOOD_SASH), sharp);
        inner = mix(inner, lit(1.2 * STEEL, at, out, 1.0) + 0.15 * saturate(1.0 - abs(at.y - HOOD_SASH + 0.012) * 120.0), bar);
        light = mix(light, inner, opening);
    }
    return light;
}

fn hood(before: Far, ray: Sight) -> Far {
    var seen = before;
    let low = frame.room_min.z * frame.metres_per_unit;
    let front = on_z(ray, HOOD_FRONT, HOOD_LOW, HOOD_HIGH);
    if (front.share > 0.0) { seen = put_behind(seen, front, hood_front(ray, front)); }
    if (seen.open == 0.0) { return seen; }
    let left = ray.origin.x < HOOD_LOW.x;
    if (left || ray.origin.x > HOOD_HIGH.x) {
        // A little further than its edge, which the front covers.
        let side = on_x(ray, select(HOOD_HIGH.x, HOOD_LOW.x, left), vec2<f32>(HOOD_LOW.y, low), vec2<f32>(HOOD_HIGH.y, HOOD_FRONT + 0.004));
        if (side.share > 0.0) {
            let normal = vec3<f32>(select(1.0, -1.0, left), 0.0, 0.0);
            let open = corner_shade(side.at.z - low) * corner_shade((side.at.y - COUNTER_TOP) * 1.5);
            seen = put_behind(seen, side, lit(0.85 * HOOD, side.at, normal, open));
        }
    }
    return seen;
}

/// What stands under the table's top.
fn pedestal(before: Far, ray: Sight) -> Far {
    var seen = before;
    let low = frame.table_min * frame.metres_per_unit;
    let high = frame.table_max * frame.metres_per_unit;
    // A low table stands on the floor.
    if (low.y < 0.3) { return seen; }
    let a = vec3<f32>(low.x + 0.07, 0.0, low.z + 0.06);
    let b = vec3<f32>(high.x - 0.07, low.y, high.z - 0.10);
    if (ray.origin.z > b.z) {
        let front = on_z(ray, b.z, a.xy, b.xy);
        if (front.share > 0.0) {
            let at = front.at;
            let third = (b.x - a.x) / 3.0;
            let gaps = max(lines(at.x - a.x, 1.0 / third, 0.006, front.sharp), in_rectangle(at.xy, vec2<f32>(-9.0, 0.517), vec2<f32>(9.0, 0.523), front.sharp));
            let u = (fract((at.x - a.x) / third) - 0.5) * third;
            let handles = in_rectangle(vec2<f32>(u, abs(at.y - 0.52)), vec2<f32>(-0.06, 0.045), vec2<f32>(0.06, 0.057), front.sharp);
            var albedo = mix(MAPLE * (1.0 - 0.8 * gaps), STEEL, handles);
            albedo = mix(albedo, vec3<f32>(0.03), saturate((0.09 - at.y) * front.sharp + 0.5));
            let open = corner_shade(at.y) * (0.25 + 0.75 * saturate(2.0 * (b.y - at.y)));
            seen = put_behind(seen, front, 0.85 * lit(albedo, at, vec3<f32>(0.0, 0.0, 1.0), open));
        }
    }
    if (seen.open == 0.0) { return seen; }
    let left = ray.origin.x < a.x;
    if (left || ray.origin.x > b.x) {
        let side = on_x(ray, select(b.x, a.x, left), vec2<f32>(a.y, a.z), vec2<f32>(b.y, b.z + 0.003));
        if (side.share > 0.0) {
            let normal = vec3<f32>(select(1.0, -1.0, left), 0.0, 0.0);
            let open = corner_shade(side.at.y) * (0.3 + 0.7 * saturate(2.0 * (b.y - side.at.y)));
            seen = put_behind(seen, side, 0.8 * lit(MAPLE, side.at, normal, open));
        }
    }
    return seen;
}

/// A wall, the floor or the ceiling of a room that has nothing but its window.
fn bare_wall(at: vec3<f32>, normal: vec3<f32>) -> vec3<f32> {
    let light = lit(select(PAINT, FLOORING, normal.y > 0.5), at, normal, 1.0);
    if (normal.x < 0.5) { return light; }
    return mix(light, pane_light(), panes_at(at.zy - WINDOW.zy, 0.5 / WINDOW_EDGE));
}

/// What a ray that misses the table sees of the room, whose walls it meets after `way`, at a wall with that normal.
fn laboratory(ray: Sight, way: f32, normal: vec3<f32>) -> Far {
    let at = ray.origin + way * ray.direction;
    if (frame.furnished == 0u) { return Far(bare_wall(at, normal), way, 0.0); }
    var seen = Far(vec3<f32>(0.0), way, 1.0);
    if (sees(SEES_FITTINGS) && has_fittings()) {
        let metal = tap(ray, way);
        seen = put_behind(seen, Layer(metal.share, metal.way, vec3<f32>(0.0), 0.0), metal.light);
    }
    if (at.y < 0.75) { seen = pedestal(seen, ray); }
    // Furniture stands along the back wall: of a ray the part before that.
    if (at.z < HOOD_FRONT && ray.origin.z > HOOD_FRONT) {
        let lowest = min(at.y, ray.origin.y);
        if (sees(SEES_FURNITURE) && max(at.x, ray.origin.x) > HOOD_LOW.x && max(at.y, ray.origin.y) > HOOD_LOW.y) { seen = hood(seen, ray); }
        if (seen.open > 0.0 && lowest < COUNTER_TOP) { seen = counter(seen, ray); }
        if (sees(SEES_FURNITURE) && seen.open > 0.0 && max(at.y, ray.origin.y) > SHELF_LOW.y && lowest < SHELF_HIGH.y) { seen = shelf(seen, ray); }
    }
    if (seen.open > 0.0) { seen.light += seen.open * wall_light(ray, at, way, normal); }
    return seen;
}

/// The same as a mirror shows it, without what is small: furniture is as flat as the wall that it stands at.
fn mirrored_laboratory(at: vec3<f32>, normal: vec3<f32>) -> vec3<f32> {
    if (frame.furnished == 0u) { return bare_wall(at, normal); }
    if (normal.x > 0.5) {
        let panes = panes_at(at.zy - WINDOW.zy, 0.5 / WINDOW_EDGE);
        return mix(lit(PAINT, at, normal, 0.9), pane_light(), panes);
    }
    var albedo = select(PAINT, FLOORING, normal.y > 0.5);
    if (normal.z > 0.5) {
        if (at.y < COUNTER_TOP) { albedo = MAPLE; }
        if (at.x > HOOD_LOW.x && at.y > COUNTER_TOP) { albedo = 0.5 * HOOD; }
    }
    return lit(albedo, at, normal, 0.9);
}
