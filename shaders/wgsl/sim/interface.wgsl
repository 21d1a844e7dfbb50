// Line 28, surface tension, 3 of 5: the derivative of the surface's energy by the colour's gradient and by the colour, on
// cells between nodes.
//!include common/liquid/block_halo.wgsl
//!include common/liquid/surface_energy.wgsl

/// The energy of a flat surface on this grid: 1, less what is too faint to count.
override FLAT: f32 = 1.0;

@group(0) @binding(44) var<storage, read> colour: array<u32>;
@group(0) @binding(45) var<storage, read> colour_solid: array<vec2<f32>>;
/// By cell: ∂/∂∇c, and ∂/∂c.
@group(0) @binding(46) var<storage, read_write> interface_stress: array<vec4<f32>>;
/// By node: 1 over the share that is not solid.
@group(0) @binding(47) var<storage, read_write> node_space: array<f32>;

const RAW: u32 = 7u;
const FILTERED: u32 = 5u;

/// Colour, S and S·cos θ; once filtered, colour is that of what is not solid.
var<workgroup> raw: array<vec3<f32>, 343>;
var<workgroup> filtered: array<vec3<f32>, 125>;

/// Nodes −1 to 5.
fn load_raw(local: u32) {
    for (var n = local; n < RAW * RAW * RAW; n += BLOCK_NODES) {
        let place = place_around(node_at(n, RAW, -1));
        var value = vec3<f32>(0.0);
        if (place != NO_BLOCK) { value = vec3<f32>(f32(colour[place]) / COLOUR_FULL, colour_solid[place]); }
        raw[n] = value;
    }
    workgroupBarrier();
}

/// 1 over the share of a node that is not solid; 0 where that is too little.
fn space_of(solid: f32) -> f32 {
    let space = 1.0 - solid;
    return select(0.0, 1.0 / space, space > LEAST_SPACE);
}

/// Nodes 0 to 4.
fn filter_raw(local: u32) {
    for (var n = local; n < FILTERED * FILTERED * FILTERED; n += BLOCK_NODES) {
        let centre = vec3<i32>(node_at(n, FILTERED, 1));
        var sum = vec3<f32>(0.0);
        for (var z = -1; z <= 1; z++) {
            for (var y = -1; y <= 1; y++) {
                for (var x = -1; x <= 1; x++) {
                    let at = centre + vec3<i32>(x, y, z);
                    let place = u32(at.x) + RAW * u32(at.y) + RAW * RAW * u32(at.z);
                    sum += filter_weight(vec3<i32>(x, y, z)) * raw[place];
                }
            }
        }
        sum.x *= space_of(sum.y);
        filtered[n] = sum;
    }
    workgroupBarrier();
}

/// The corner `corner` (bits x, y, z) of the cell whose first node is `node`.
fn corner_of(node: vec3<u32>, corner: u32) -> vec3<f32> {
    let at = node + vec3<u32>(corner & 1u, (corner >> 1u) & 1u, corner >> 2u);
    return filtered[at.x + FILTERED * at.y + FILTERED * FILTERED * at.z];
}

/// ±¼ for the far and the near corners along each axis.
fn corner_sign(corner: u32) -> vec3<f32> {
    return 0.25 * (2.0 * vec3<f32>(vec3<u32>(corner & 1u, (corner >> 1u) & 1u, corner >> 2u)) - 1.0);
}

fn stress_of(node: vec3<u32>) -> vec4<f32> {
    var gradient = vec3<f32>(0.0);
    var solid_gradient = vec3<f32>(0.0);
    var mean = vec3<f32>(0.0);
    var most_solid = 0.0;
    for (var corner = 0u; corner < 8u; corner++) {
        let value = corner_of(node, corner);
        gradient += value.x * corner_sign(corner);
        solid_gradient += value.y * corner_sign(corner);
        mean += 0.125 * value;
        most_solid = max(most_solid, value.y);
    }
    if (1.0 - most_solid <= LEAST_SPACE) { return vec4<f32>(0.0); }
    let size = sqrt(dot(gradient, gradient) + FAINTEST * FAINTEST);
    let space = 1.0 - mean.y;
    let weight = space * outermost(mean.x);
    var by_colour = space * outermost_slope(mean.x) * (size - FAINTEST);
    let wall = length(solid_gradient);
    if (wall > 0.0) {
        by_colour -= mean.z / mean.y * FLAT * outermost(mean.x) * wall;
    }
    return vec4<f32>(weight * gradient / size, by_colour);
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let slot = colour_used[group.x];
    find_around(slot, local);
    load_raw(local);
    filter_raw(local);
    let node = vec3<u32>(node_of(local));
    interface_stress[slot * BLOCK_NODES + local] = stress_of(node);
    let solid = filtered[node.x + FILTERED * node.y + FILTERED * FILTERED * node.z].y;
    node_space[slot * BLOCK_NODES + local] = space_of(solid);
}
