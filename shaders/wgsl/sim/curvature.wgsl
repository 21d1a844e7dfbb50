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
/// Nodes of a block along an axis.
const OWN: u32 = 4u;

/// Of cells −2 to 4, x running fastest; then of nodes −1 to 4 along z and along y, by cells along x.
var<workgroup> stress: array<vec4<f32>, 343>;
/// Of those nodes along z, by cells along x and y.
var<workgroup> by_z: array<vec3<f32>, 294>;
/// Of nodes −1 to 4, then, where it begins, filtered along z. Filtered along y too, it lies before.
var<workgroup> unfiltered: array<f32, 360>;
const BY_Z: u32 = 216u;

fn load_stress(local: u32) {
    for (var n = local; n < CELLS * CELLS * CELLS; n += BLOCK_NODES) {
        let place = place_around(node_at(n, CELLS, -2));
        var value = vec4<f32>(0.0);
        if (place != NO_BLOCK) { value = interface_stress[place]; }
        stress[n] = value;
    }
    workgroupBarrier();
}

/// What the eight cells about a node have for it: the difference's transpose, −∇· in the continuum. Axis by axis, since what is
/// not along a slope's axis is only summed.
fn gather_stress(local: u32) {
    let layer = CELLS * CELLS;
    if (local < layer) {
        var before = stress[local];
        for (var n = 0u; n < NODES; n++) {
            let after = stress[local + (n + 1u) * layer];
            let sum = before + after;
            by_z[local + n * layer] = vec3<f32>(sum.xy, 0.25 * (before.z - after.z) + 0.125 * sum.w);
            before = after;
        }
    }
    workgroupBarrier();
    if (local < CELLS * NODES) {
        let first = local % CELLS + layer * (local / CELLS);
        var before = by_z[first];
        for (var n = 0u; n < NODES; n++) {
            let after = by_z[first + (n + 1u) * CELLS];
            let rest = 0.25 * (before.y - after.y) + before.z + after.z;
            stress[first + n * CELLS] = vec4<f32>(before.x + after.x, rest, 0.0, 0.0);
            before = after;
        }
    }
    workgroupBarrier();
    for (var n = local; n < NODES * NODES * NODES; n += BLOCK_NODES) {
        let first = n % NODES + CELLS * ((n / NODES) % NODES) + layer * (n / (NODES * NODES));
        let before = stress[first];
        let after = stress[first + 1u];
        let place = place_around(node_at(n, NODES, -1));
        var space = 1.0;
        if (place != NO_BLOCK) { space = smooth_colour[place].w; }
        unfiltered[n] = (0.25 * (before.x - after.x) + before.y + after.y) * space;
    }
    workgroupBarrier();
}

/// Filters six values, `stride` apart from `first` on, into four from `to` on, as far apart.
fn filter_line(first: u32, to: u32, stride: u32) {
    var before = unfiltered[first];
    var here = unfiltered[first + stride];
    for (var n = 0u; n < OWN; n++) {
        let after = unfiltered[first + (n + 2u) * stride];
        unfiltered[to + n * stride] = 0.25 * (before + after) + 0.5 * here;
        before = here;
        here = after;
    }
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let slot = colour_used[group.x];
    find_around(slot, local);
    load_stress(local);
    gather_stress(local);
    if (local < NODES * NODES) { filter_line(local, BY_Z + local, NODES * NODES); }
    workgroupBarrier();
    if (local < NODES * OWN) {
        let x = local % NODES;
        let z = local / NODES;
        filter_line(BY_Z + x + NODES * NODES * z, x + NODES * OWN * z, NODES);
    }
    workgroupBarrier();
    let at = vec3<u32>(node_of(local));
    let first = at.x + NODES * at.y + NODES * OWN * at.z;
    curvature[slot * BLOCK_NODES + local] = 0.25 * (unfiltered[first] + unfiltered[first + 2u]) + 0.5 * unfiltered[first + 1u];
    colour[slot * BLOCK_NODES + local] = 0u;
}
