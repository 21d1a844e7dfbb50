//! The picture without smooth edges: what of the room, the liquid, the hands and the coloured particles is nearest at
//! each pixel, in its light, and the glass over it.
//!
//! Bench, floor and walls are boxes that each ray is traced against, as those that liquid refracts are. Alpha is 0 where nothing is
//! before the panel (`common/picture/panel.wgsl`).

//!include common/picture/coarse_blocks.wgsl
//!include common/picture/encode.wgsl
//!include common/picture/glass_light.wgsl
//!include common/picture/goggles.wgsl
//!include common/picture/hidden_area.wgsl
//!include common/picture/liquid_light.wgsl
//!include common/picture/packed_light.wgsl
//!include common/picture/pane.wgsl
//!include common/picture/panel.wgsl
//!include common/picture/sign.wgsl
//!include common/picture/tile_pixels.wgsl

/// Whether the class's tiles may have glass, liquid, and a panel, a sign or a pane.
override GLASS: bool = false;
override LIQUID: bool = false;
override SHEETS: bool = false;

/// Marks of the tiles.
@group(0) @binding(6) var<storage, read> tiles: array<u32>;
/// The light of the nearest hand or coloured sphere, and its reversed depth, 0 where there is none; in tiles that are
/// marked for them.
@group(0) @binding(7) var<storage, read> solid_light: array<u32>;
@group(0) @binding(8) var<storage, read> solid_depths: array<f32>;
@group(0) @binding(9) var drawn: texture_storage_2d_array<rgba8unorm, write>;
/// The same where no edges are to be smoothed.
@group(0) @binding(10) var finished: texture_storage_2d_array<rgba8unorm, write>;
/// Reversed depth of what is not glass.
@group(0) @binding(11) var<storage, read_write> depths: array<f32>;

/// Where there is nothing: the walls' own colour, roughly.
const BACKGROUND = vec3<f32>(0.38, 0.37, 0.35);
/// How much nearer the liquid is taken to be: before the glass that it wets, whose outline is traced
/// finer than the one that cuts it.
const BEFORE_GLASS = 1.0007;
/// How much further than glass what it stands on is taken to be: a foot lies in the bench's own plane.
const BEHIND_GLASS = 1.0002;

struct Seen {
    /// sRGB, and alpha.
    colour: vec4<f32>,
    /// Reversed depth.
    depth: f32,
}

fn seen_at_place(place: Place, hidden: bool) -> Seen {
    let eye = place.eye;
    let at = vec2<f32>(place.pixel) + 0.5;
    let near = frame.views[eye].near;
    var colour = vec3<f32>(0.0);
    var reversed = 1.0;
    var alpha = 1.0;
    if (!hidden) {
        // Of view depth 1, so that ways along it are depths.
        var origin = frame.views[eye].eye;
        var direction = seen_along(eye, at);
        var met = room_meets(origin, direction);
        let room = met.way > near;
        reversed = select(0.0, near / met.way, room);
        var kept = vec3<f32>(1.0);
        var mirrored = vec3<f32>(0.0);
        var wet = false;
        var through = Through(NO_VESSEL, 1.0);
        var inside: Inside;
        inside.vessel = frame.blocker_count;
        if (GLASS) {
            let end = select(1e9, near / reversed, reversed > 0.0);
            inside = inside_of_wall(tiles[place.tile], eye, at, end);
        }
        let walled = inside.vessel < frame.blocker_count;
        if (LIQUID) {
            let here = seen_at(place.pixel, eye);
            var entry: Entry;
            if (walled) { entry = behind_wall(inside, eye); }
            // Drops before the glass are nearer.
            if (here.w > 0.0 && (entry.depth == 0.0 || here.w < -entry.depth - 2.0 * frame.spacing)) { entry = at_surface(place.pixel, eye, here); }
            let liquid = BEFORE_GLASS * near / abs(entry.depth);
            if (entry.depth != 0.0 && liquid > reversed) {
                let ray = liquid_light(entry, eye);
                wet = true;
                through = ray.through;
                reversed = liquid;
                origin = ray.origin;
                direction = ray.direction;
                kept = ray.kept;
                mirrored = ray.mirrored;
                met = room_meets(origin, direction);
            }
        }
        let empty = walled && !wet && !inside.base;
        var fine = 1.0 / frame.views[eye].focal;
        if (empty) {
            let passed = out_of_vessel(inside);
            if (any(passed.direction != vec3<f32>(0.0))) {
                origin = passed.point;
                direction = passed.direction;
                met = room_meets(origin, direction);
                // A pixel is as wide at the vessel as without it, and wider behind that.
                fine *= passed.spread + inside.depth / max(met.way, 1e-3);
            }
        }
        let seen = room_light(origin, direction, met, through, fine);
        // A bent ray's way is no view depth.
        if (room && !wet && !empty) { reversed = near / seen.way; }
        colour = display(kept * seen.light + mirrored);
        if (!wet && met.way <= select(near, 0.0, empty)) { colour = BACKGROUND; }
        if (wet) {
            // Liquid shows them where it stands before them. They are no things of the room: where it mirrors or bends light of elsewhere
            // they would be dark blocks in it.
            let straight = seen_along(eye, at);
            let behind = meets_panel(origin, direction);
            let beyond = meets_panel(frame.views[eye].eye, straight);
            var end = select(met.way, 1e9, met.way == 0.0);
            if (behind.way < end && is_on_panel(behind.at, 1.0) && beyond.way < 1e9 && is_on_panel(beyond.at, 1.0)) {
                colour = kept * panel_light(behind.at) + display(mirrored);
                end = behind.way;
            }
            if (has_sign()) {
                let sign = meets_sign(origin, direction);
                let beyond_sign = meets_sign(frame.views[eye].eye, straight);
                if (sign.way < end && is_on_sign(sign.at) && beyond_sign.way < 1e9 && is_on_sign(beyond_sign.at)) {
                    colour = kept * sign_light(sign.at) + display(mirrored);
                }
            }
        } else if (SHEETS) {
            let panel = panel_seen(eye, at, near / max(reversed, 1e-9));
            if (panel.share > 0.0) {
                colour = mix(colour, panel.light, panel.share);
                reversed = near / panel.depth;
                alpha = select(1.0, 0.0, panel.see_through);
            }
        }
        if (SHEETS) {
            let sign = sign_seen(eye, at, near / max(reversed, 1e-9));
            if (sign.share > 0.0) {
                colour = mix(colour, sign.light, sign.share);
                reversed = near / sign.depth;
                alpha = 1.0;
            }
        }
        if ((tiles[place.tile] & (MARK_SPHERES | MARK_HANDS)) != 0u) {
            let index = pixel_index(place.pixel, eye);
            let solid = solid_depths[index];
            if (solid > reversed) {
                let over = unpacked(solid_light[index]);
                colour = mix(colour, over.rgb, over.a);
                // A drop finer than a pixel is not what is there.
                reversed = select(reversed, solid, over.a > 0.5);
                alpha = 1.0;
            }
        }
        var pane = PaneSeen(vec3<f32>(0.0), vec3<f32>(1.0), 1e9);
        if (SHEETS) { pane = pane_over(eye, at, select(near / reversed, 1e9, reversed == 0.0)); }
        if (pane.way < 1e9) { alpha = 1.0; }
        var before_pane = false;
        if (GLASS) {
            // Vessels are before it or behind it as their middles are.
            before_pane = pane.way < 1e9 && nearest_vessel(tiles[place.tile], eye) < pane.way;
            if (before_pane) { colour = pane.light + pane.open * colour; }
            let end = select(BEHIND_GLASS * near / reversed, 1e9, reversed == 0.0);
            let cover = glass_over(tiles[place.tile], eye, at, end);
            colour = cover.colour + cover.open * colour;
            if (cover.open < 1.0) { alpha = 1.0; }
        }
        if (!before_pane) { colour = pane.light + pane.open * colour; }
        // What has no slow gradient needs no noise.
        let goggles = through_goggles(eye, at);
        // What is behind the picture would be seen as if they were clean.
        if (any(goggles < vec3<f32>(1.0))) { alpha = 1.0; }
        colour = encoded(frame.shown * goggles * colour) + select(0.0, dither(at), room);
    }
    return Seen(vec4<f32>(colour, alpha), reversed);
}

@compute @workgroup_size(32, 8)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    // Invocations in step have a block of pixels: edges are in fewer of these than of rows.
    let block = lane / 32u;
    let place = place_of(group, vec3<u32>(8u * (block % 4u) + lane % 8u, 4u * (block / 4u) + lane / 8u % 4u, 0u));
    if (!place.inside) { return; }
    let seen = seen_at_place(place, is_hidden(place.pixel, place.eye));
    depths[pixel_index(place.pixel, place.eye)] = seen.depth;
    textureStore(drawn, place.pixel, place.eye, seen.colour);
    textureStore(finished, place.pixel, place.eye, seen.colour);
}

/// What a workgroup saw of its blocks.
var<workgroup> seen_blocks: array<Seen, 64>;

/// The same of blocks; `spread.wgsl` finishes them. A workgroup writes its pixels row by row, since writes beside one another are one.
@compute @workgroup_size(8, 8)
fn coarse(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let block = block_of(group, local);
    let eye = block.place.eye;
    if (block.place.inside) { seen_blocks[lane] = seen_at_place(block.place, is_block_hidden(block)); }
    workgroupBarrier();
    let first = block.low - block.side * vec2<i32>(local.xy);
    let width = 8 * block.side;
    let end = select(0, width * width, has_blocks(block.side, group));
    for (var n = i32(lane); n < end; n += 64) {
        let at = vec2<i32>(n % width, n / width);
        let pixel = first + at;
        if (any(pixel >= vec2<i32>(frame.extent))) { continue; }
        let seen = seen_blocks[8 * (at.y / block.side) + at.x / block.side];
        // As hidden pixels are elsewhere.
        let hidden = frame.hides != 0u && is_hidden(pixel, eye);
        depths[pixel_index(pixel, eye)] = select(seen.depth, 1.0, hidden);
        textureStore(drawn, pixel, eye, seen.colour);
    }
}
