// Line 10, counting sort: exclusive sums of the counts, a workgroup a block of cells. The blocks before are summed up by each
// workgroup, which saves a pass between.
//!include common/liquid/cells.wgsl
//!include common/liquid/particle.wgsl

/// As in `common/liquid/awake.wgsl`.
override SLEEP: bool = false;

@group(0) @binding(0) var<storage, read> cell_counts: array<u32>;
@group(0) @binding(1) var<storage, read_write> cell_starts: array<u32>;
@group(0) @binding(2) var<storage, read> block_counts: array<u32>;
@group(0) @binding(3) var<storage, read_write> long_lists: array<u32>;
/// See `common/liquid/awake.wgsl`.
@group(0) @binding(59) var<storage, read_write> sleep: array<u32>;
/// Sizes of the dispatches over particles that do not sleep, as `solver/sleep.rs` reads them: in workgroups of `GROUP`, and of 64.
@group(0) @binding(4) var<storage, read_write> awake_args: array<u32>;

/// Notes how many particles do not sleep. One workgroup runs in any case, as some passes have more to do.
fn note_awake(count: u32) {
    sleep[0] = count;
    awake_args[0] = max((count * LANES + GROUP - 1u) / GROUP, 1u);
    awake_args[4] = max((count * LANES + 63u) / 64u, 1u);
}

/// By thread: number of particles in its cells, and in those of its share of the blocks before; then how many of its run are before it.
var<workgroup> sums: array<u32, 256>;
var<workgroup> earlier: array<u32, 256>;
/// By run of 16 threads. A barrier costs more than that many sums.
var<workgroup> runs: array<u32, 16>;
var<workgroup> earlier_runs: array<u32, 16>;

/// Sums up one run of threads.
fn sum_run(run: u32) {
    var sum = 0u;
    var before = 0u;
    for (var n = 0u; n < 16u; n++) {
        let thread = 16u * run + n;
        let own = sums[thread];
        sums[thread] = sum;
        sum += own;
        before += earlier[thread];
    }
    runs[run] = sum;
    earlier_runs[run] = before;
}

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    if (group.x == 0u && local == 0u) { long_lists[0] = 0u; }
    let first = group.x * SCAN_BLOCK + local * 4u;
    let a = cell_counts[first];
    let b = a + cell_counts[first + 1u];
    let c = b + cell_counts[first + 2u];
    let total = c + cell_counts[first + 3u];
    var of_blocks = 0u;
    for (var block = local; block < group.x; block += 256u) { of_blocks += block_counts[block]; }
    sums[local] = total;
    earlier[local] = of_blocks;
    workgroupBarrier();
    if (local < 16u) { sum_run(local); }
    workgroupBarrier();
    var before = sums[local];
    for (var run = 0u; run < 16u; run++) { before += earlier_runs[run] + select(0u, runs[run], run < local / 16u); }
    // What comes before the second half is awake.
    if (SLEEP && first == 1u << (CELL_BITS_X + CELL_BITS_Y + CELL_BITS_Z)) { note_awake(before); }
    cell_starts[first] = before;
    cell_starts[first + 1u] = before + a;
    cell_starts[first + 2u] = before + b;
    cell_starts[first + 3u] = before + c;
}
