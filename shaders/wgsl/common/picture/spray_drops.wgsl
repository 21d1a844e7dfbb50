// Drops that bubbles threw up, as they are drawn: what the solver follows as one flight is several drops, of the radius that the law of
// its burst gives them (`common/chemistry/spray_laws.wgsl`).

//!include common/maths/lot.wgsl

/// A flight.
struct Flight {
    /// Of its first drop, in the stage, in the scene's unit.
    position: vec3<f32>,
    /// Of each drop, in the scene's unit.
    radius: f32,
    /// In which it flies, of length 1; 0 for one at rest.
    direction: vec3<f32>,
    /// How many drops it has; 0 for none.
    drops: u32,
    /// How far about its place they lie, in the scene's unit; 0 of a jet's, which lie behind one another.
    about: f32,
    /// Acid fraction of its drops.
    acid: f32,
}

/// Most drops that are drawn of a flight: a jet has seven at most.
const MOST_DROPS = 8u;
/// Places of flights are mostly empty. So a list says which are not: workgroups along x, y and z of a dispatch over it, an invocation a drop and view; how many
/// are listed; and from `FLYING` on their numbers, in any order.
const FLYING = 4u;
const FLIGHTS_GROUP = 64u;
/// Most drops that lie where they came to rest: they are flights of one drop, behind those of the bubbles' places. All of them are listed,
/// also those that there are not.
const RESTING = 160u;
/// From drop to drop of a jet, in their radii: it breaks up 9.01 of its own radii apart, and a drop has 1.89 (Rayleigh 1878).
const JET_STEP = 4.77;

/// How unevenly a jet breaks up: along it, over a step; and beside it, in radii. Chosen: waves of other lengths grow nearly as fast.
const UNEVEN_STEP = 0.2;
const UNEVEN_SIDE = 1.5;

/// Where drop k of a flight is.
fn drop_place(flight: Flight, number: u32, k: u32) -> vec3<f32> {
    let seed = 3u * (number * MOST_DROPS + k);
    let lots = 2.0 * vec3<f32>(lot(seed, 1u), lot(seed + 1u, 1u), lot(seed + 2u, 1u)) - 1.0;
    if (flight.about > 0.0) { return flight.position + flight.about * lots; }
    if (k == 0u) { return flight.position; }
    let aside = lots - dot(lots, flight.direction) * flight.direction;
    let back = (f32(k) + UNEVEN_STEP * lots.x) * JET_STEP;
    return flight.position + flight.radius * (UNEVEN_SIDE * aside - back * flight.direction);
}

/// Least radius of a drop in the picture, pixels: such that it covers the middle of a pixel.
const LEAST_DRAWN = 0.75;

/// The radius that a drop is drawn with at a view depth, in the scene's unit, and the share of what is behind that it hides: together its own area,
/// up to the 31 steps of a share. So what is finer than a tenth of a pixel is not seen.
fn drawn_drop(radius: f32, depth: f32, focal: f32) -> vec2<f32> {
    let drawn = max(radius, LEAST_DRAWN * max(depth, 1e-6) / focal);
    return vec2<f32>(drawn, (radius / drawn) * (radius / drawn));
}
