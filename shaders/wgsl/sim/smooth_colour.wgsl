// Line 28, surface tension, 4 of 7: the colour of what is not solid, filtered.
//!include common/liquid/block_halo.wgsl
//!include common/liquid/surface_energy.wgsl

@group(0) @binding(44) var<storage, read_write> colour: array<u32>;
@group(0) @binding(45) var<storage, read> colour_solid: array<vec2<f32>>;
/// By node: colour, S, S·cos θ, and 1 over the share that is not solid.
@group(0) @binding(47) var<storage, read_write> smooth_colour: array<vec4<f32>>;

const RAW: u32 = 6u;

/// Colour, S and S·cos θ of nodes −1 to 4.
var<workgroup> raw: array<vec3<f32>, 216>;

/// 1 over the share of a node that is not solid; 0 where that is too little.
fn space_of(solid: f32) -> f32 {
    let space = 1.0 - solid;
    return select(0.0, 1.0 / space, space > LEAST_SPACE);
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let slot = colour_used[group.x];
    find_around(slot, local);
    for (var n = local; n < RAW * RAW * RAW; n += BLOCK_NODES) {
        let place = place_around(node_at(n, RAW, -1));
        var value = vec3<f32>(0.0);
        if (place != NO_BLOCK) { value = vec3<f32>(f32(colour[place]) / COLOUR_FULL, colour_solid[place]); }
        raw[n] = value;
    }
    workgroupBarrier();
    let centre = node_of(local) + vec3<i32>(1);
    var sum = vec3<f32>(0.0);
    for (var z = -1; z <= 1; z++) {
        for (var y = -1; y <= 1; y++) {
            for (var x = -1; x <= 1; x++) {
                let at = vec3<u32>(centre + vec3<i32>(x, y, z));
                sum += filter_weight(vec3<i32>(x, y, z)) * raw[at.x + RAW * at.y + RAW * RAW * at.z];
            }
        }
    }
    let space = space_of(sum.y);
    smooth_colour[slot * BLOCK_NODES + local] = vec4<f32>(sum.x * space, sum.yz, space);
}
