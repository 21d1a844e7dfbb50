// Line 18, where there are cavities: what of the density at each particle's prediction is theirs, for the multipliers and displacements
// of this substep. Between two steps of the bubbles a cavity goes and grows evenly.
//!include common/chemistry/bubble.wgsl
//!include common/chemistry/cavity.wgsl
//!include common/chemistry/live_places.wgsl
//!include common/liquid/cells_around.wgsl
//!include common/liquid/lane_sums.wgsl
//!include common/liquid/step.wgsl

@group(0) @binding(0) var<storage, read> position: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> trial: array<vec4<f32>>;
/// (membership, identity)
@group(0) @binding(2) var<storage, read> tags: array<vec2<u32>>;
@group(0) @binding(4) var<storage, read> cell_starts: array<u32>;
@group(0) @binding(8) var<storage, read> bubbles: array<Bubble>;
@group(0) @binding(19) var<storage, read> live: array<u32>;
@group(0) @binding(53) var<storage, read_write> cavities: array<atomic<i32>>;

/// h and how far a particle may be from where its cell has it, over h.
const REACH: f32 = 1.1;

fn add(word: u32, amount: f32) {
    atomicAdd(&cavities[word], i32(round(amount / CAVITY_QUANTUM)));
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    // The list of the step before: the next one's begins right before it.
    if (id.x / LANES >= live[SLOTS + 1u - set_of_step()]) { return; }
    let bubble = bubbles[step.before_bubbles + live[id.x / LANES]];
    let radius = mix(bubble.radius_before, bubble.radius, step.cavity);
    if (radius <= 0.0 || bubble.cavity <= 0.0) { return; }
    let centre = mix(bubble.position_before, bubble.position, step.cavity);
    let cells = clamp(i32(ceil((radius + REACH * SUPPORT) / CELL)), 1, CAVITY_CELLS);
    for (var n = id.x % LANES; n < count_around(cells); n += LANES) {
        let run = cell_within(centre, radius + SUPPORT, cells, n);
        for (var j = run.first; j < run.end; j++) {
            let x = trial[j].xyz;
            let offset = x - centre;
            let distance = length(offset);
            if (distance >= radius + SUPPORT || tags[j].x != bubble.membership) { continue; }
            let own = bubble.cavity * cavity_at(distance, radius);
            let gradient = own.y / max(distance, 1e-6) * offset;
            for (var axis = 0u; axis < 3u; axis++) { add(4u * j + axis, gradient[axis] * SUPPORT); }
            add(4u * j + 3u, own.x - dot(gradient, x - position[j].xyz));
        }
    }
}
