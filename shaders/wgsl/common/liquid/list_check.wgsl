// When the neighbour list must be rebuilt.

/// Displacement since the list was built above which it is rebuilt, metres.
override LIST_SLACK: f32 = 0.0002;
/// Workgroups of a pass over particles, over cells, and of the list pass.
override PARTICLE_GROUPS: u32 = 1u;
override CELL_GROUPS: u32 = 1u;
override LIST_GROUPS: u32 = 1u;

/// Sizes of the rebuild's dispatches: particles at 0, cells at 4, list at 8, one workgroup at
/// 12. Zero while the list serves.
@group(0) @binding(30) var<storage, read_write> list_args: array<atomic<u32>>;
/// Predicted positions at the last rebuild.
@group(0) @binding(31) var<storage, read> list_origin: array<vec4<f32>>;

fn check_list(i: u32, predicted: vec3<f32>) {
    let moved = predicted - list_origin[i].xyz;
    // Negated, so that a NaN asks for a rebuild too.
    if (!(dot(moved, moved) <= LIST_SLACK * LIST_SLACK)) {
        atomicStore(&list_args[0], PARTICLE_GROUPS);
        atomicStore(&list_args[4], CELL_GROUPS);
        atomicStore(&list_args[8], LIST_GROUPS);
        atomicStore(&list_args[12], 1u);
    }
}
