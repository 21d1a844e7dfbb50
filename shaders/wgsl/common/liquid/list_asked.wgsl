// A rebuild of the neighbour list.
//!include common/liquid/list_args.wgsl

/// Workgroups of a pass over cells.
override CELL_GROUPS: u32 = 1u;
/// Invocations that search one particle's neighbours.
override LIST_LANES: u32 = 1u;

/// Zero while the list serves.
@group(0) @binding(30) var<storage, read_write> list_args: array<atomic<u32>>;

/// Has the lists of the first `count` particles made anew.
fn ask_for_list(count: u32) {
    atomicStore(&list_args[PARTICLE_ARGS], (count + 63u) / 64u);
    atomicStore(&list_args[CELL_ARGS], CELL_GROUPS);
    atomicStore(&list_args[LIST_ARGS], (count * LIST_LANES + 63u) / 64u);
}
