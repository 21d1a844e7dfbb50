// What of the drops that bubbles threw up flies against a pane stays before it.
//!include common/chemistry/drops.wgsl
//!include common/glass/pane.wgsl

@group(0) @binding(14) var<storage, read_write> drops: array<Drops>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let n = id.x;
    if (n >= arrayLength(&drops) || drops[n].mass <= 0.0) { return; }
    drops[n].velocity = stopped(drops[n].position, drops[n].velocity, pane.half + drops[n].radius);
}
