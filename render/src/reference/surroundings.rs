//! Solids around a liquid.

use glam::DVec3;

/// Queries of the reference about glass, table and floor.
pub trait Surroundings: Sync {
    /// On which side of the glass a particle is: those of one side, a vessel's
    /// or the outside's, have the same solids.
    fn side(&self, particle: usize) -> usize;

    /// Signed distance from `at` to the nearest of what is solid for that side,
    /// scene's unit; negative in it.
    ///
    /// For a particle in a vessel all below the rim that is not the vessel's
    /// liquid space is solid, however thin the glass: what lies beyond it must
    /// not show through.
    fn distance(&self, side: usize, at: DVec3) -> f64;

    /// Whether [`Surroundings::distance`] is negative; where that is dear, this
    /// is not.
    fn is_solid(&self, side: usize, at: DVec3) -> bool {
        self.distance(side, at) < 0.0
    }

    /// Whether glass lies between two particles, so that they are no
    /// neighbours.
    fn apart(&self, a: usize, b: usize) -> bool;
}

/// Surroundings without any solid.
#[derive(Clone, Copy, Debug)]
pub struct Nothing;

impl Surroundings for Nothing {
    fn side(&self, _particle: usize) -> usize {
        0
    }

    fn distance(&self, _side: usize, _at: DVec3) -> f64 {
        f64::INFINITY
    }

    fn apart(&self, _a: usize, _b: usize) -> bool {
        false
    }
}
