// Line 10, counting sort: exclusive sums of the blocks' totals, by one workgroup.

/// Number of blocks.
override BLOCKS: u32 = 1u;

@group(0) @binding(0) var<storage, read_write> block_sums: array<u32>;

var<workgroup> sums: array<u32, 256>;

@compute @workgroup_size(256)
fn main(@builtin(local_invocation_index) local: u32) {
    var carried = 0u;
    for (var base = 0u; base < BLOCKS; base += 256u) {
        let at = base + local;
        var total = 0u;
        if (at < BLOCKS) { total = block_sums[at]; }
        sums[local] = total;
        workgroupBarrier();
        for (var reach = 1u; reach < 256u; reach <<= 1u) {
            var add = 0u;
            if (local >= reach) { add = sums[local - reach]; }
            workgroupBarrier();
            sums[local] += add;
            workgroupBarrier();
        }
        if (at < BLOCKS) { block_sums[at] = carried + sums[local] - total; }
        carried += sums[255];
        workgroupBarrier();
    }
}
