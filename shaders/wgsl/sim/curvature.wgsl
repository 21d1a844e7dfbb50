// Line 28, surface tension, 6 of 7: the derivative of the surface's energy by the volume that lies on each node, in σ over a
// node's distance: at a surface, its curvature. Leaves the nodes' volumes at 0.
//!include common/liquid/block_halo.wgsl
//!include common/liquid/surface_energy.wgsl

@group(0) @binding(44) var<storage, read_write> colour: array<u32>;
@group(0) @binding(46) var<storage, read> interface_stress: array<vec4<f32>>;
@group(0) @binding(47) var<storage, read> smooth_colour: array<vec4<f32>>;
/// By node.
@group(0) @binding(48) var<storage, read_write> curvature: array<f32>;

const CELLS: u32 = 7u;
const NODES: u32 = 6u;

var<workgroup> stress: array<vec4<f32>, 343>;
var<workgroup> unfiltered: array<f32, 216>;

/// Cells −2 to 4.
fn load_stress(local: u32) {
    for (var n = local; n < CELLS * CELLS * CELLS; n += BLOCK_NODES) {
        let place = place_around(node_at(n, CELLS, -2));
        var value = vec4<f32>(0.0);
        if (place != NO_BLOCK) { value = interface_stress[place]; }
        stress[n] = value;
    }
    workgroupBarrier();
}

/// Nodes −1 to 4: what the eight cells about a node have for it. The difference's transpose: −∇·, in the continuum.
fn gather_stress(local: u32) {
    for (var n = local; n < NODES * NODES * NODES; n += BLOCK_NODES) {
        let node = node_at(n, NODES, -1);
        var sum = 0.0;
        for (var corner = 0u; corner < 8u; corner++) {
            let far = vec3<i32>(vec3<u32>(corner & 1u, (corner >> 1u) & 1u, corner >> 2u));
            let cell = vec3<u32>(node - far + vec3<i32>(2));
            let value = stress[cell.x + CELLS * cell.y + CELLS * CELLS * cell.z];
            sum += dot(value.xyz, 0.25 * (2.0 * vec3<f32>(far) - 1.0)) + 0.125 * value.w;
        }
        let place = place_around(node);
        var space = 1.0;
        if (place != NO_BLOCK) { space = smooth_colour[place].w; }
        unfiltered[n] = sum * space;
    }
    workgroupBarrier();
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let slot = colour_used[group.x];
    find_around(slot, local);
    load_stress(local);
    gather_stress(local);
    let centre = node_of(local) + vec3<i32>(1);
    var sum = 0.0;
    for (var z = -1; z <= 1; z++) {
        for (var y = -1; y <= 1; y++) {
            for (var x = -1; x <= 1; x++) {
                let at = vec3<u32>(centre + vec3<i32>(x, y, z));
                sum += filter_weight(vec3<i32>(x, y, z)) * unfiltered[at.x + NODES * at.y + NODES * NODES * at.z];
            }
        }
    }
    curvature[slot * BLOCK_NODES + local] = sum;
    colour[slot * BLOCK_NODES + local] = 0u;
}
