//! What is solid around a liquid.

use glam::DVec3;

/// What the reference asks of glass, table and floor.
pub trait Surroundings: Sync {
    /// Signed distance from `at` to the nearest of what is solid for that
    /// particle, scene's unit; negative in it. A lower bound of the magnitude
    /// does.
    ///
    /// For a particle in a vessel all below the rim that is not the vessel's
    /// liquid space is solid, however thin the glass: what lies beyond it must
    /// not show through.
    fn distance(&self, particle: usize, at: DVec3) -> f64;

    /// Whether glass lies between two particles, so that they are no
    /// neighbours.
    fn apart(&self, a: usize, b: usize) -> bool;
}

/// Nothing around.
#[derive(Clone, Copy, Debug)]
pub struct Nothing;

impl Surroundings for Nothing {
    fn distance(&self, _particle: usize, _at: DVec3) -> f64 {
        f64::INFINITY
    }

    fn apart(&self, _a: usize, _b: usize) -> bool {
        false
    }
}
