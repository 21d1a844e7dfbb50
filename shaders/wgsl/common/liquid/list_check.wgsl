// When the neighbour list must be rebuilt.
//!include common/liquid/list_args.wgsl

/// Displacement since the list was built above which it is rebuilt, metres.
override LIST_SLACK: f32 = 0.0003;
/// Workgroups of a pass over particles, over cells, and of the list pass.
override PARTICLE_GROUPS: u32 = 1u;
override CELL_GROUPS: u32 = 1u;
override LIST_GROUPS: u32 = 1u;

/// Zero while the list serves.
@group(0) @binding(30) var<storage, read_write> list_args: array<atomic<u32>>;
/// Predicted positions at the last rebuild.
@group(0) @binding(31) var<storage, read> list_origin: array<vec4<f32>>;

/// Has the list rebuilt.
fn ask_for_list() {
    atomicStore(&list_args[PARTICLE_ARGS], PARTICLE_GROUPS);
    atomicStore(&list_args[CELL_ARGS], CELL_GROUPS);
    atomicStore(&list_args[LIST_ARGS], LIST_GROUPS);
}

fn check_list(i: u32, predicted: vec3<f32>) {
    let moved = predicted - list_origin[i].xyz;
    // Negated, so that a NaN asks for a rebuild too.
    if (!(dot(moved, moved) <= LIST_SLACK * LIST_SLACK)) { ask_for_list(); }
}
