// Line 28, surface tension, 5 of 8: the derivative of the surface's energy by the colour's gradient and by the colour, on
// cells between nodes. And how strongly walls hold the line at which the surface ends on them.
//!include common/liquid/blocks_around.wgsl
//!include common/liquid/find_block.wgsl
//!include common/liquid/surface_energy.wgsl

/// The energy of a flat surface on this grid: 1, less what is too faint to count.
override FLAT: f32 = 1.0;
/// What of σ·sin θ holds a line: the sine of half of the difference between the advancing and the receding contact angle, over the
/// share of it that comes to particles.
override HYSTERESIS: f32 = 0.0;

/// By cell: ∂/∂∇c, and ∂/∂c.
@group(0) @binding(46) var<storage, read_write> interface_stress: array<vec4<f32>>;
/// By node: colour of what is not solid, S, S·cos θ, and 1 over the share that is not solid.
@group(0) @binding(47) var<storage, read> smooth_colour: array<vec4<f32>>;
/// By cell: what a wall can hold liquid back with, across the line, over σ/(ρ0·node²).
@group(0) @binding(49) var<storage, read_write> line_hold: array<vec4<f32>>;

/// Colour, S and S·cos θ of a node of the block, or around it.
fn value_at(slot: u32, node: vec3<i32>) -> vec3<f32> {
    let place = place_around(slot, node);
    if (place == NO_BLOCK) { return vec3<f32>(0.0); }
    return smooth_colour[place].xyz;
}

/// The corner `corner` (bits x, y, z) of the cell whose first node is `node`.
fn corner_of(slot: u32, node: vec3<i32>, corner: u32) -> vec3<f32> {
    return value_at(slot, node + vec3<i32>(vec3<u32>(corner & 1u, (corner >> 1u) & 1u, corner >> 2u)));
}

/// ±¼ for the far and the near corners along each axis.
fn corner_sign(corner: u32) -> vec3<f32> {
    return 0.25 * (2.0 * vec3<f32>(vec3<u32>(corner & 1u, (corner >> 1u) & 1u, corner >> 2u)) - 1.0);
}

/// The core's colour: of the nodes nearest to the cell's middle and to places up the gradient, as far as the blocks around
/// have them.
fn core_of(slot: u32, node: vec3<i32>, colour: f32, gradient: vec3<f32>) -> f32 {
    let inward = gradient / max(length(gradient), 1e-6);
    let nearest = vec3<f32>(node) + 1.0;
    var fullest = colour;
    for (var k = 1; k <= CORE_STEPS; k++) {
        let to = clamp(nearest + CORE_STRIDE * f32(k) * inward, vec3<f32>(-4.0), vec3<f32>(7.5));
        fullest = max(fullest, value_at(slot, vec3<i32>(floor(to))).x);
    }
    return core_for(fullest);
}

/// What a wall holds the liquid's line with, for its gradient of S and the colour's. A line stays where it is as long as its angle is
/// between the receding and the advancing one, so up to σ(cos θ_r − cos θ_a)/2 = σ sin θ sin(Δθ/2) a length. By 2c of each level:
/// the force is over the mass that is there, so c is not in it.
fn hold_of(solid_gradient: vec3<f32>, wall: f32, gradient: vec3<f32>, wetting: f32, mass: f32) -> vec3<f32> {
    let normal = solid_gradient / wall;
    let along = gradient - normal * dot(gradient, normal);
    return 2.0 * FLAT * HYSTERESIS * sqrt(max(1.0 - wetting * wetting, 0.0)) * wall / mass * along;
}

/// Of the cell whose first node is `node`.
struct Interface {
    stress: vec4<f32>,
    hold: vec3<f32>,
}

fn interface_of(slot: u32, node: vec3<i32>) -> Interface {
    var gradient = vec3<f32>(0.0);
    var solid_gradient = vec3<f32>(0.0);
    var mean = vec3<f32>(0.0);
    var most_solid = 0.0;
    for (var corner = 0u; corner < 8u; corner++) {
        let value = corner_of(slot, node, corner);
        gradient += value.x * corner_sign(corner);
        solid_gradient += value.y * corner_sign(corner);
        mean += 0.125 * value;
        most_solid = max(most_solid, value.y);
    }
    if (1.0 - most_solid <= LEAST_SPACE) { return Interface(vec4<f32>(0.0), vec3<f32>(0.0)); }
    let core = core_of(slot, node, mean.x, gradient);
    let thickness = thickness_for(core);
    let colour = mean.x / core;
    gradient /= core;
    let size = sqrt(dot(gradient, gradient) + FAINTEST * FAINTEST);
    let space = 1.0 - mean.y;
    let pull = outermost(colour, thickness);
    var by_colour = space * outermost_slope(colour, thickness) * (size - FAINTEST);
    let wall = length(solid_gradient);
    var hold = vec3<f32>(0.0);
    if (wall > 0.0) {
        let wetting = mean.z / mean.y;
        by_colour -= wetting * FLAT * wetted(colour, mean.z, pull) * wall;
        if (HYSTERESIS > 0.0 && colour < 1.0) { hold = hold_of(solid_gradient, wall, gradient, wetting, core * space); }
    }
    return Interface(vec4<f32>(space * pull * gradient / size, by_colour) / core, hold);
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let slot = colour_used[group.x];
    let cell = slot * BLOCK_NODES + local;
    if (!is_near_colour(slot)) {
        interface_stress[cell] = vec4<f32>(0.0);
        if (HYSTERESIS > 0.0) { line_hold[cell] = vec4<f32>(0.0); }
        return;
    }
    let found = interface_of(slot, node_of(local));
    interface_stress[cell] = found.stress;
    if (HYSTERESIS > 0.0) { line_hold[cell] = vec4<f32>(found.hold, 0.0); }
}
