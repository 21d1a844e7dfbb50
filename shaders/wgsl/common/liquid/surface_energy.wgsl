// The energy of a liquid's surface, over σ, as an integral over space:
//
//   ∫ (1 − S) F(c)·|∇c| dV − cos θ ∫ G(c)·|∇S| dV,   G(0) = 0, G(1) = 1, ∫F = 1,
//
// with the share S of space that is solid and the colour c of what is not, over its core's. Each level of c counts |∇c|, its
// area; F gives most weight to the outermost, so that what the surface pulls with falls towards the inside and a liquid that
// can only push bears it. It is 1.5 (1 − c²) where liquid is thick, so that the surface lies where the particles end, and
// 2 (1 − c) where it is thin: a level's pull is F over its radius, and in a drop of less than 100 particles the former grows
// too slowly outwards, which drives the outermost away. The second term is Young's: a wetted wall costs cos θ less than a dry one.
// Where it is wetted, G′ = 6 c (1 − c) pulls the levels in between: with G′ = F it would pull the outermost most, away from the
// others, and below 40° a drop ends as a layer one particle thick. What is repelled is pressed together, and has G′ = F.
//
// The core's colour is the fullest up the gradient: 1 in what is thick, 0.7 within two layers of particles, 0.4 within one.
// It is no part of the slope, as if it were given: then a sheet pulls with 2σ however thin it is. With c alone it pulls with
// 2σ c³, so what is thinner pulls less, is stretched, and tears.

/// |∇c| below which a gradient has no direction, over one per node: a lone particle has 0.02.
const FAINTEST: f32 = 0.002;
/// Least share of a node that is not solid, as far as it is divided by.
const LEAST_SPACE: f32 = 0.05;

/// Nodes from a cell's middle to each of the places where its core is looked for. All four reach what is full from where a
/// thick liquid's colour begins; further, a sheet's bulging rim would count as the core of the sheet behind it.
const CORE_STRIDE: f32 = 1.05;
const CORE_STEPS: i32 = 4;
/// Colour up to which a core is one of a sheet, and from which it is taken to be full: liquid that moves is not quite full.
const CORE_THIN: f32 = 0.75;
const CORE_THICK: f32 = 0.85;
/// Core's colour from which F is that of a thick liquid.
const THICK_PULL: f32 = 0.9;
/// Least colour of a core: a lone particle's is 0.15.
const LEAST_CORE: f32 = 0.25;

/// What colours are divided by, for the fullest that was found.
fn core_for(fullest: f32) -> f32 {
    return max(mix(fullest, 1.0, smoothstep(CORE_THIN, CORE_THICK, fullest)), LEAST_CORE);
}

/// How much of F is that of a thick liquid, for a core's colour.
fn thickness_for(core: f32) -> f32 {
    return smoothstep(CORE_THIN, THICK_PULL, core);
}

/// F, 0 where it is more than full.
fn outermost(colour: f32, thickness: f32) -> f32 {
    let full = clamp(colour, 0.0, 1.0);
    return (1.0 - full) * mix(2.0, 1.5 * (1.0 + full), thickness);
}

/// F′.
fn outermost_slope(colour: f32, thickness: f32) -> f32 {
    return select(0.0, mix(-2.0, -3.0 * max(colour, 0.0), thickness), colour < 1.0);
}

/// G′ of a wall, where F of the surface is `pull`.
fn wetted(colour: f32, wetting: f32, pull: f32) -> f32 {
    let full = clamp(colour, 0.0, 1.0);
    return select(pull, 6.0 * full * (1.0 - full), wetting > 0.0);
}
