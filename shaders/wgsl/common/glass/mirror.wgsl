// What a wall gives a particle of the displacement by pressure, as if it mirrored the liquid before it.
//
// Across the wall, the image has the particle's own multiplier: (λ + λ)∇V. With λ alone, the gradient of the constraint,
// a layer at the wall bears the liquid above it only with twice the pressure, since ∫|∇V| ds = ½, and the layers above it
// alternate.
//
// Along the wall, the neighbours are the share 1 − V of a neighbourhood, and their sum that share of the pressure's
// gradient. The image has the rest. Without it, what touches the wall of a beaker weighs more than it is borne, sinks, and
// the whole beaker turns over at 9 cm/s: mirrored across alone, walls feed energy in.
//
// Boundary particles are the paper's: ψ makes up twice the density and the gradient of a half-space, so that the gradient
// of the constraint bears what is above it.
//!include common/glass/wall.wgsl

/// Least share of a neighbourhood that is liquid, as far as it is divided by: in a gap narrower than a particle.
const LEAST_OPEN: f32 = 0.3;

/// Line 19: the walls' part of a displacement, m, for that of the neighbours, the change of the multiplier (m²) and the record
/// `boundary`.
fn by_walls(by_liquid: vec3<f32>, change: f32, boundary: vec4<f32>) -> vec3<f32> {
    let gradient = wall_gradient(boundary);
    if (SOLIDS) { return change * gradient; }
    let across = 2.0 * change * gradient;
    let square = max(dot(gradient, gradient), 1e-12 / (SUPPORT * SUPPORT));
    let both = by_liquid + across;
    let along = both - gradient * (dot(both, gradient) / square);
    let open = max(1.0 - wall_volume(boundary), LEAST_OPEN);
    return across + along * (1.0 / open - 1.0);
}
