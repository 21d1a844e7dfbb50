// Line 10, counting sort: exclusive sums of the counts within a block of
// cells, and the block's total.
//!include common/liquid/cells.wgsl

@group(0) @binding(0) var<storage, read> cell_counts: array<u32>;
@group(0) @binding(1) var<storage, read_write> cell_starts: array<u32>;
@group(0) @binding(2) var<storage, read_write> block_sums: array<u32>;

var<workgroup> sums: array<u32, 256>;

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let first = group.x * SCAN_BLOCK + local * 4u;
    let a = cell_counts[first];
    let b = a + cell_counts[first + 1u];
    let c = b + cell_counts[first + 2u];
    let total = c + cell_counts[first + 3u];
    sums[local] = total;
    workgroupBarrier();
    for (var reach = 1u; reach < 256u; reach <<= 1u) {
        var add = 0u;
        if (local >= reach) { add = sums[local - reach]; }
        workgroupBarrier();
        sums[local] += add;
        workgroupBarrier();
    }
    let before = sums[local] - total;
    cell_starts[first] = before;
    cell_starts[first + 1u] = before + a;
    cell_starts[first + 2u] = before + b;
    cell_starts[first + 3u] = before + c;
    if (local == 255u) { block_sums[group.x] = before + total; }
}
