//! The scalar field whose level set is the surface, section 4 of Yu & Turk 2013.

use std::f64::consts::PI;

use glam::{DMat3, DVec3};

use super::anisotropy::Shape;
use super::buckets::Buckets;
use super::surroundings::Surroundings;

/// Level of φ on the surface.
///
/// Above a filled half-space's outermost particles, half a spacing below its
/// true surface, φ falls from 1 to 0 over about 1.5 spacings. Their centres
/// have moved into the liquid and their kernels are flat, so that the level at
/// the true height is well below ½. This is φ's mean there over jittered
/// lattices with the parameters of
/// [`Anisotropy::new`](super::Anisotropy::new)
/// (`a_half_space_ends_where_it_should`).
pub const SURFACE: f64 = 0.14;

/// How far into the liquid φ is evaluated to tell a wall from a free surface, particle spacings, and least value that it has there above
/// the surface's level: at a free surface φ rises by some thousandths over that way.
const WALL_STEP: f64 = 1e-3;
const WALL_RISE: f64 = 1.05;

/// A particle's kernel at its place.
#[derive(Clone, Copy, Debug)]
struct Placed {
    centre: DVec3,
    g: DMat3,
    /// V_j det(G_j), dimensionless.
    height: f64,
    /// Square of the distance beyond which it is 0: most of the candidates are
    /// turned away by it, before a matrix is multiplied.
    reach2: f64,
    /// Its particle's side of the glass, where it reaches into a solid.
    side: Option<usize>,
}

/// φ(x) = Σ_j V_j det(G_j) P(|G_j (x − x̄_j)|), Eqs 3 and 8: 1 in the depth of a
/// liquid, 0 outside. A kernel ends where there is a solid for its particle:
/// the kernels of a liquid at a wall are as wide as in its depth, and would
/// reach beyond the glass.
#[derive(Clone)]
pub struct Field<'a> {
    surroundings: &'a dyn Surroundings,
    kernels: Vec<Placed>,
    buckets: Buckets,
    spacing: f64,
    shortest: f64,
}

impl<'a> Field<'a> {
    /// Field of particles of these shapes and volumes (scene's unit cubed), as
    /// many of them, of spacing `spacing`. Shapes are those of particles of d³;
    /// the kernel of another volume is as much wider as that asks, so that
    /// a lone drop keeps the volume of its particle.
    pub fn new(
        shapes: &[Shape],
        volumes: &[f64],
        spacing: f64,
        surroundings: &'a dyn Surroundings,
    ) -> Self {
        let shapes: Vec<Shape> = shapes
            .iter()
            .zip(volumes)
            .map(|(shape, volume)| Shape {
                lengths: shape.lengths * (volume / spacing.powi(3)).cbrt(),
                ..*shape
            })
            .collect();
        let each = shapes.iter().zip(volumes).enumerate();
        let kernels = each.map(|(i, (shape, volume))| {
            let g = shape.g();
            let reach = SUPPORT * shape.lengths.max_element();
            let side = surroundings.side(i);
            Placed {
                centre: shape.centre,
                g,
                height: volume * g.determinant(),
                reach2: reach * reach,
                side: (surroundings.distance(side, shape.centre) < reach).then_some(side),
            }
        });
        let boxes: Vec<_> = shapes.iter().map(bounds).collect();
        let lengths = shapes.iter().map(|shape| shape.lengths.min_element());
        Self {
            surroundings,
            kernels: kernels.collect(),
            buckets: Buckets::new(&boxes, spacing),
            spacing,
            shortest: lengths.fold(f64::INFINITY, f64::min),
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
        // Kernels that lie together are mostly of one side.
        let mut looked_up = None;
        for kernel in self.around(at) {
            let offset = at - kernel.centre;
            // First what is cheap: most candidates are turned away by these.
            let near = offset.length_squared() < kernel.reach2;
            if !near || self.is_cut(kernel, at, &mut looked_up) {
                continue;
            }
            let q2 = (kernel.g * offset).length_squared();
            if q2 < SUPPORT * SUPPORT {
                sum += kernel.height * shape(q2.sqrt());
            }
        }
        sum
    }

    /// ∇φ at a place, one over the scene's unit.
    pub fn gradient(&self, at: DVec3) -> DVec3 {
        let mut sum = DVec3::ZERO;
        for kernel in self.around(at) {
            let stretched = kernel.g * (at - kernel.centre);
            let q = stretched.length();
            if q > 0.0 && q < SUPPORT {
                // G is symmetric: ∇|G x| = Gᵀ G x / |G x|.
                sum += kernel.g * stretched * (kernel.height * slope(q) / q);
            }
        }
        sum
    }

    /// Whether a kernel is cut off before a place; `looked_up` is the side that
    /// was asked for last, and the answer.
    fn is_cut(&self, kernel: &Placed, at: DVec3, looked_up: &mut Option<(usize, bool)>) -> bool {
        let Some(side) = kernel.side else {
            return false;
        };
        match *looked_up {
            Some((asked, solid)) if asked == side => solid,
            _ => {
                let solid = self.surroundings.is_solid(side, at);
                *looked_up = Some((side, solid));
                solid
            }
        }
    }

    /// Unit normal of the surface at a place on it that is seen along `ray`:
    /// −∇φ's direction, or, where the liquid ends at a solid, that of the
    /// solid's distance.
    pub fn normal(&self, at: DVec3, ray: DVec3) -> DVec3 {
        let step = WALL_STEP * self.spacing;
        let within = at + ray.normalize_or_zero() * step;
        let wall = (self.value(within) > WALL_RISE * SURFACE)
            .then(|| self.wall_at(at, step))
            .flatten();
        let Some(side) = wall else {
            return -self.gradient(at).normalize_or_zero();
        };
        let rise = |axis: DVec3| {
            let distance = |at: DVec3| self.surroundings.distance(side, at);
            distance(at + axis * step) - distance(at - axis * step)
        };
        -DVec3::new(rise(DVec3::X), rise(DVec3::Y), rise(DVec3::Z)).normalize_or_zero()
    }

    /// The side of a kernel in reach whose solid is within `tolerance`.
    fn wall_at(&self, at: DVec3, tolerance: f64) -> Option<usize> {
        self.around(at)
            .filter(|kernel| at.distance_squared(kernel.centre) < kernel.reach2)
            .filter_map(|kernel| kernel.side)
            .find(|&side| self.surroundings.distance(side, at).abs() < tolerance)
    }

    fn around(&self, at: DVec3) -> impl Iterator<Item = &Placed> {
        let near = self.buckets.around(at).iter();
        near.map(|&kernel| &self.kernels[kernel as usize])
    }

    /// A box beyond which φ is 0.
    pub fn bounds(&self) -> [DVec3; 2] {
        self.buckets.bounds()
    }

    /// A box around a place in which φ is 0, where there is one.
    pub fn empty_around(&self, at: DVec3) -> Option<[DVec3; 2]> {
        let empty = self.buckets.around(at).is_empty();
        empty.then(|| self.buckets.cell_of(at))
    }
}

/// Centre and half extent of the box around a kernel.
fn bounds(shape: &Shape) -> (DVec3, DVec3) {
    // The ellipsoid |G x| = 2 is R times a stretched sphere's points; along an
    // axis it reaches the root of that row's sum of squares.
    let stretched = shape.axes * DMat3::from_diagonal(SUPPORT * shape.lengths);
    let rows = stretched.transpose();
    let half = [rows.x_axis, rows.y_axis, rows.z_axis].map(DVec3::length);
    (shape.centre, DVec3::from_array(half))
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
