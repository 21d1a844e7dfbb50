//! The scalar field whose level set is the surface, section 4 of Yu & Turk 2013.

use std::f64::consts::PI;

use glam::{DMat3, DVec3};

use super::anisotropy::{Anisotropy, Shape};
use super::grid::Grid;

/// Level of φ on the surface.
///
/// Above a filled half-space's outermost particles, half a spacing below its
/// true surface, φ falls from 1 to 0 over about 1.5 spacings. Their centres
/// have moved into the liquid and their kernels are flat, so that the level at
/// the true height is well below ½. This is φ's mean there over jittered
/// lattices with the parameters of [`Anisotropy::new`]
/// (`a_half_space_ends_where_it_should`).
pub const SURFACE: f64 = 0.14;

/// A kernel in place.
#[derive(Clone, Copy, Debug)]
struct Placed {
    centre: DVec3,
    g: DMat3,
    /// V det(G), dimensionless.
    height: f64,
    /// Square of the distance beyond which it is 0: most of the candidates are
    /// turned away by it, before a matrix is multiplied.
    reach2: f64,
}

/// φ(x) = Σ_j V det(G_j) P(|G_j (x − x̄_j)|), Eqs 3 and 8: 1 in the depth of a
/// liquid, 0 outside.
#[derive(Clone, Debug)]
pub struct Field {
    kernels: Vec<Placed>,
    grid: Grid,
    /// No kernel reaches farther from its centre.
    reach: f64,
    spacing: f64,
    shortest: f64,
}

impl Field {
    /// Field of particles of these shapes.
    pub fn new(shapes: &[Shape], parameters: &Anisotropy) -> Self {
        let kernels = shapes.iter().map(|shape| {
            let g = shape.g();
            Placed {
                centre: shape.centre,
                g,
                height: parameters.spacing.powi(3) * g.determinant(),
                reach2: (SUPPORT * shape.lengths.max_element()).powi(2),
            }
        });
        let centres: Vec<DVec3> = shapes.iter().map(|shape| shape.centre).collect();
        let lengths = || shapes.iter().map(|shape| shape.lengths);
        let longest = lengths().map(DVec3::max_element).fold(0.0, f64::max);
        let shortest = lengths()
            .map(DVec3::min_element)
            .fold(f64::INFINITY, f64::min);
        Self {
            kernels: kernels.collect(),
            grid: Grid::new(&centres, 0.5 * longest),
            reach: SUPPORT * longest,
            spacing: parameters.spacing,
            shortest,
        }
    }

    /// Particle spacing d, scene's unit.
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// Half-width of the sharpest kernel: over less than this φ has no second
    /// hump, scene's unit.
    pub fn shortest(&self) -> f64 {
        self.shortest
    }

    /// φ at a place.
    pub fn value(&self, at: DVec3) -> f64 {
        let mut sum = 0.0;
        self.grid.near(at, self.reach, |j| {
            let kernel = &self.kernels[j];
            let offset = at - kernel.centre;
            if offset.length_squared() > kernel.reach2 {
                return;
            }
            let q2 = (kernel.g * offset).length_squared();
            if q2 < SUPPORT * SUPPORT {
                sum += kernel.height * shape(q2.sqrt());
            }
        });
        sum
    }

    /// ∇φ at a place, one over the scene's unit.
    pub fn gradient(&self, at: DVec3) -> DVec3 {
        let mut sum = DVec3::ZERO;
        self.grid.near(at, self.reach, |j| {
            let kernel = &self.kernels[j];
            let stretched = kernel.g * (at - kernel.centre);
            let q = stretched.length();
            if q > 0.0 && q < SUPPORT {
                // G is symmetric: ∇|G x| = Gᵀ G x / |G x|.
                sum += kernel.g * stretched * (kernel.height * slope(q) / q);
            }
        });
        sum
    }

    /// A box beyond which φ is 0.
    pub fn bounds(&self) -> [DVec3; 2] {
        let centres = || self.kernels.iter().map(|kernel| kernel.centre);
        [
            centres().fold(DVec3::INFINITY, DVec3::min) - self.reach,
            centres().fold(DVec3::NEG_INFINITY, DVec3::max) + self.reach,
        ]
    }

    /// Whether there is no kernel within `radius` of a place.
    pub fn is_empty(&self, at: DVec3, radius: f64) -> bool {
        let mut empty = true;
        self.grid.near(at, radius + self.reach, |_| empty = false);
        empty
    }
}

/// Where P ends.
const SUPPORT: f64 = 2.0;

/// P: the cubic spline, ∫P(|x|) dx = 1 (Monaghan 1992).
fn shape(q: f64) -> f64 {
    let p = if q < 1.0 {
        1.0 + q * q * (0.75 * q - 1.5)
    } else {
        0.25 * (2.0 - q).max(0.0).powi(3)
    };
    p / PI
}

/// dP/dq.
fn slope(q: f64) -> f64 {
    let p = if q < 1.0 {
        q * (2.25 * q - 3.0)
    } else {
        -0.75 * (2.0 - q).max(0.0).powi(2)
    };
    p / PI
}

#[cfg(test)]
#[path = "tests/field.rs"]
mod tests;
