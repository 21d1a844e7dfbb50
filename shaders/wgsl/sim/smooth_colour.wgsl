// Line 28, surface tension, 4 of 7: the colour of what is not solid, filtered.
//!include common/liquid/block_halo.wgsl
//!include common/liquid/surface_energy.wgsl

@group(0) @binding(44) var<storage, read_write> colour: array<u32>;
@group(0) @binding(45) var<storage, read> colour_solid: array<vec2<f32>>;
/// By node: colour, S, S·cos θ, and 1 over the share that is not solid.
@group(0) @binding(47) var<storage, read_write> smooth_colour: array<vec4<f32>>;

const RAW: u32 = 6u;

/// Nodes of a block along an axis.
const OWN: u32 = 4u;

/// Colour, S and S·cos θ: of nodes −1 to 4, then, where it begins, filtered along z. Filtered along y too, it lies before.
var<workgroup> values: array<vec3<f32>, 360>;
const BY_Z: u32 = 216u;

/// Filters six values, `stride` apart from `first` on, into four from `to` on, as far apart.
fn filter_line(first: u32, to: u32, stride: u32) {
    var before = values[first];
    var here = values[first + stride];
    for (var n = 0u; n < OWN; n++) {
        let after = values[first + (n + 2u) * stride];
        values[to + n * stride] = 0.25 * (before + after) + 0.5 * here;
        before = here;
        here = after;
    }
}

/// 1 over the share of a node that is not solid; 0 where that is too little.
fn space_of(solid: f32) -> f32 {
    let space = 1.0 - solid;
    return select(0.0, 1.0 / space, space > LEAST_SPACE);
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let slot = colour_used[group.x];
    if (!is_near_colour(slot)) {
        smooth_colour[slot * BLOCK_NODES + local] = vec4<f32>(0.0, 0.0, 0.0, 1.0);
        return;
    }
    find_around(slot, local);
    for (var n = local; n < RAW * RAW * RAW; n += BLOCK_NODES) {
        let place = place_around(node_at(n, RAW, -1));
        var value = vec3<f32>(0.0);
        if (place != NO_BLOCK) { value = vec3<f32>(f32(colour[place]) / COLOUR_FULL, colour_solid[place]); }
        values[n] = value;
    }
    workgroupBarrier();
    if (local < RAW * RAW) { filter_line(local, BY_Z + local, RAW * RAW); }
    workgroupBarrier();
    if (local < RAW * OWN) {
        let x = local % RAW;
        let z = local / RAW;
        filter_line(BY_Z + x + RAW * RAW * z, x + RAW * OWN * z, RAW);
    }
    workgroupBarrier();
    let at = vec3<u32>(node_of(local));
    let first = at.x + RAW * at.y + RAW * OWN * at.z;
    let sum = 0.25 * (values[first] + values[first + 2u]) + 0.5 * values[first + 1u];
    let space = space_of(sum.y);
    smooth_colour[slot * BLOCK_NODES + local] = vec4<f32>(sum.x * space, sum.yz, space);
}
