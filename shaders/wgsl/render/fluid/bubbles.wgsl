//! Puts the liquid's bubbles into the cells in which rays look for them.

//!include common/chemistry/bubble.wgsl
//!include common/picture/bubble_cells.wgsl

struct BubbleRun {
    /// Places of bubbles.
    count: u32,
    /// Entries at most.
    entries: u32,
    /// Side of a cell, in the scene's unit.
    cell: f32,
    /// Radius from which on a bubble is none, or of a solver that has failed, in the scene's unit.
    largest: f32,
}

var<immediate> run: BubbleRun;

@group(0) @binding(0) var<storage, read> bubbles: array<Bubble>;
/// For each place of the table its first entry, and one more; zero at first.
@group(0) @binding(1) var<storage, read_write> bubble_heads: array<atomic<u32>>;
@group(0) @binding(2) var<storage, read_write> bubble_entries: array<BubbleEntry>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x >= run.count) { return; }
    let bubble = bubbles[id.x];
    if !(is_there(bubble) && bubble.radius > 0.0 && bubble.radius < run.largest) { return; }
    let low = vec3<i32>(floor((bubble.position - bubble.radius) / run.cell));
    let high = vec3<i32>(floor((bubble.position + bubble.radius) / run.cell));
    for (var z = low.z; z <= high.z; z++) {
        for (var y = low.y; y <= high.y; y++) {
            for (var x = low.x; x <= high.x; x++) {
                // Beyond the last entry bubbles are left out.
                let entry = atomicAdd(&bubble_heads[BUBBLE_CELLS], 1u);
                if (entry >= run.entries) { return; }
                let before = atomicExchange(&bubble_heads[place_of_cell(vec3<i32>(x, y, z))], entry + 1u);
                bubble_entries[entry] = BubbleEntry(bubble.position, bubble.radius, before);
            }
        }
    }
}
