// When the neighbour list must be rebuilt.
//!include common/liquid/awake.wgsl
//!include common/liquid/list_asked.wgsl

/// Displacement since the list was built above which it is rebuilt, metres.
override LIST_SLACK: f32 = 0.0003;
/// Predicted positions at the last rebuild.
@group(0) @binding(31) var<storage, read> list_origin: array<vec4<f32>>;

fn check_list(i: u32, predicted: vec3<f32>) {
    let moved = predicted - list_origin[i].xyz;
    // Negated, so that a NaN asks for a rebuild too.
    if (!(dot(moved, moved) <= LIST_SLACK * LIST_SLACK)) { ask_for_list(sorted_count()); }
}
