//! Yu & Turk 2013, "Reconstructing surfaces of particle-based fluids using
//! anisotropic kernels", sections 4.1 and 4.2: each particle's smoothed centre
//! and the matrix G that stretches its kernel. Equation numbers are the
//! paper's.

use std::f64::consts::TAU;

use glam::{DMat3, DVec3};

use super::eigen::eigen_symmetric;
use super::grid::Grid;
use super::parallel;
use super::surroundings::Surroundings;

/// Steps of the quadrature over a particle's neighbourhood along its radius,
/// where a solid cuts it: 2,100 nodes.
const NODES: i32 = 8;

/// Share of R² that each eigenvalue of a full neighbourhood's covariance is:
/// ⅓∫r²w/∫w = ⅓ (1/5 − 1/8)/(1/3 − 1/6) with w = 1 − (r/R)³.
pub const FULL_COVARIANCE: f64 = 0.15;

/// Parameters of the anisotropy, lengths in the scene's unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Anisotropy {
    /// Particle spacing d; a particle's volume is d³.
    pub spacing: f64,
    /// R, within which particles are neighbours. The paper's 2h, so its h is
    /// half of this. The solver's neighbour list reaches so far and no farther.
    pub radius: f64,
    /// λ of Eq. 6: how far a centre goes to the mean of its neighbours.
    pub smoothing: f64,
    /// k_r of Eq. 15: no axis is shorter than the longest over this.
    pub ratio: f64,
    /// k_s of Eq. 15, for covariances in units of a full neighbourhood's: the
    /// paper's 1400 has the dimension 1/m² and fits one scene. With 1, kernels
    /// of a flat surface's outermost particles, which λ has moved in and the
    /// covariance flattened, end below that surface: no level of φ would be it.
    pub scale: f64,
    /// k_n of Eq. 15: the axes of a particle without neighbours, in units of h;
    /// such that its droplet has the particle's volume.
    pub lone: f64,
    /// Σ w of the neighbours, itself and solids not counted, over that of a full
    /// neighbourhood, between which a particle fades from a lone one's sphere in
    /// its place to the shape of its covariance. The paper switches at
    /// N_ε = 25, for neighbourhoods of another size; a switch would pop.
    pub fade: [f64; 2],
}

impl Anisotropy {
    /// For particles of spacing `spacing` and neighbours within `radius`.
    pub fn new(spacing: f64, radius: f64) -> Self {
        Self {
            spacing,
            radius,
            smoothing: 0.9,
            ratio: 4.0,
            scale: 1.5,
            lone: 0.41,
            fade: [0.10, 0.35],
        }
    }

    /// The paper's h, R/2.
    pub fn smoothing_length(&self) -> f64 {
        0.5 * self.radius
    }

    /// Eq. 7: w_ij at a distance.
    fn weight(&self, distance: f64) -> f64 {
        (1.0 - (distance / self.radius).powi(3)).max(0.0)
    }

    /// Each particle's shape.
    pub fn shapes(&self, positions: &[DVec3], surroundings: &dyn Surroundings) -> Vec<Shape> {
        let grid = Grid::new(positions, self.radius);
        let nodes = self.nodes();
        parallel::map(positions.len(), |i| {
            let mut sums = Sums::ZERO;
            grid.near(positions[i], self.radius, |j| {
                let offset = positions[j] - positions[i];
                if offset.length() < self.radius && !(i != j && surroundings.apart(i, j)) {
                    sums.add(offset, self.weight(offset.length()), 1.0);
                }
            });
            let liquid = sums.weight - 1.0;
            let side = surroundings.side(i);
            if surroundings.distance(side, positions[i]) < self.radius {
                // As many particles as the solid would hold if it were liquid.
                let each = (self.radius / f64::from(NODES) / self.spacing).powi(3);
                for &(offset, weight) in &nodes {
                    if surroundings.is_solid(side, positions[i] + offset) {
                        sums.add(offset, weight, each);
                    }
                }
            }
            self.shape(positions[i], &sums, liquid)
        })
    }

    /// The shape of a particle at `position` whose neighbourhood, itself and
    /// solids included, has these sums; `liquid` is Σ w without these two.
    pub fn shape(&self, position: DVec3, sums: &Sums, liquid: f64) -> Shape {
        // Eq. 10 less x_i, and with it Eq. 6.
        let mean = sums.first / sums.weight;
        // Eq. 9 by the moments about x_i.
        let covariance = sums.second * (1.0 / sums.weight) - outer(mean);
        // Eq. 11, C = R Σ Rᵀ, in units of a full neighbourhood's.
        let full = FULL_COVARIANCE * self.radius.powi(2);
        let (sigma, axes) = eigen_symmetric(covariance * (1.0 / full));
        // Eq. 15, faded.
        let stretched = self.scale * sigma.max(DVec3::splat(sigma.x / self.ratio));
        let [few, enough] = self.fade;
        let full = TAU / 3.0 * (self.radius / self.spacing).powi(3);
        let t = ((liquid / full - few) / (enough - few)).clamp(0.0, 1.0);
        let trust = t * t * (3.0 - 2.0 * t);
        let lengths = DVec3::splat(self.lone).lerp(stretched, trust);
        Shape {
            centre: position + trust * self.smoothing * mean,
            lengths: lengths * self.smoothing_length(),
            axes,
        }
    }

    /// Offsets within R, at the middles of small cubes, and their weights.
    fn nodes(&self) -> Vec<(DVec3, f64)> {
        let step = self.radius / f64::from(NODES);
        let middle = |n: i32| (f64::from(n) + 0.5) * step;
        let range = || -NODES..NODES;
        range()
            .flat_map(|x| range().flat_map(move |y| range().map(move |z| [x, y, z])))
            .map(|at| DVec3::from_array(at.map(middle)))
            .map(|offset| (offset, self.weight(offset.length())))
            .filter(|(_, weight)| *weight > 0.0)
            .collect()
    }
}

/// Moments of a particle's neighbourhood about the particle.
#[derive(Clone, Copy, Debug)]
pub struct Sums {
    /// Σ w.
    pub weight: f64,
    /// Σ w (x_j − x_i), scene's unit.
    pub first: DVec3,
    /// Σ w (x_j − x_i)(x_j − x_i)ᵀ, its square.
    pub second: DMat3,
}

impl Sums {
    /// Of nothing.
    pub const ZERO: Self = Self {
        weight: 0.0,
        first: DVec3::ZERO,
        second: DMat3::ZERO,
    };

    /// Adds `number` neighbours at `offset` that weigh `weight` each.
    pub fn add(&mut self, offset: DVec3, weight: f64, number: f64) {
        let weight = weight * number;
        self.weight += weight;
        self.first += weight * offset;
        self.second += outer(offset) * weight;
    }
}

/// v vᵀ.
fn outer(v: DVec3) -> DMat3 {
    DMat3::from_cols(v * v.x, v * v.y, v * v.z)
}

/// A particle's stretched kernel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape {
    /// x̄ of Eq. 6, scene's unit.
    pub centre: DVec3,
    /// h Σ̃: the kernel's smoothing length along each axis, the longest first,
    /// scene's unit.
    pub lengths: DVec3,
    /// R: the axes as columns.
    pub axes: DMat3,
}

impl Shape {
    /// G = (1/h) R Σ̃⁻¹ Rᵀ, Eq. 16, one over the scene's unit.
    pub fn g(&self) -> DMat3 {
        self.axes * DMat3::from_diagonal(1.0 / self.lengths) * self.axes.transpose()
    }
}

#[cfg(test)]
#[path = "tests/anisotropy.rs"]
mod tests;
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
use super::*;
use crate::reference::Nothing;

/// Unit spacing, and the solver's h/d = 2.
fn parameters() -> Anisotropy {
    Anisotropy::new(1.0, 2.0)
}

/// A cubic lattice with steps smaller than a particle, which is nearly a
/// continuum.
fn dense(inside: impl Fn(DVec3) -> bool) -> Sums {
    let p = parameters();
    let mut sums = Sums::ZERO;
    for (offset, weight) in p.nodes() {
        if inside(offset) {
            sums.add(offset, weight, (p.radius / f64::from(NODES)).powi(3));
        }
    }
    sums
}

#[test]
fn a_full_neighbourhood_is_a_sphere() {
    let p = parameters();
    let shape = p.shape(DVec3::ONE, &dense(|_| true), f64::INFINITY);
    // The midpoint rule over cubes of R/8.
    assert!((shape.lengths / p.smoothing_length() - p.scale).length() < 0.01 * p.scale);
    assert!((shape.centre - DVec3::ONE).length() < 1e-12);
}

#[test]
fn on_a_plane_it_is_flat_by_the_integral() {
    let p = parameters();
    let normal = DVec3::new(2.0, -1.0, 0.5).normalize();
    let shape = p.shape(
        DVec3::ZERO,
        &dense(|offset| offset.dot(normal) < 0.0),
        f64::INFINITY,
    );
    // Over a half ball with w = 1 − (r/R)³ the mean lies ½(1/4 − 1/7)/(1/3 − 1/6) R
    // deep, the variance across is 0.15 R² less its square.
    let deep = 0.5 * (0.25 - 1.0 / 7.0) / (1.0 / 3.0 - 1.0 / 6.0);
    let across = (FULL_COVARIANCE - deep * deep) / FULL_COVARIANCE;
    let expected = DVec3::new(1.0, 1.0, across) * p.scale * p.smoothing_length();
    assert!(
        (shape.lengths - expected).length() < 0.02,
        "{} {expected}",
        shape.lengths
    );
    assert!(shape.axes.z_axis.dot(normal).abs() > 0.9999);
    let centre = -normal * (p.smoothing * deep * p.radius);
    assert!((shape.centre - centre).length() < 0.01, "{}", shape.centre);
    // G undoes the stretch.
    assert!((shape.g() * normal * shape.lengths.z - normal).length() < 1e-3);
}

#[test]
fn one_particle_is_a_small_sphere_where_it_is() {
    let p = parameters();
    let at = DVec3::new(0.3, 5.0, -2.0);
    let shape = p.shapes(&[at], &Nothing)[0];
    assert_eq!(shape.centre, at);
    assert!((shape.lengths - p.lone * p.smoothing_length()).length() < 1e-12);
}

#[test]
fn two_particles_are_long() {
    // Trusted at once, for the covariance of two to show.
    let p = Anisotropy {
        fade: [-2.0, -1.0],
        ..parameters()
    };
    let apart = DVec3::new(0.0, 1.2, 0.0);
    let shapes = p.shapes(&[DVec3::ZERO, apart], &Nothing);
    let w = 1.0 - 0.6_f64.powi(3);
    let along = w / (1.0 + w).powi(2) * 1.2 * 1.2 / (FULL_COVARIANCE * 4.0);
    let expected = p.scale * along * DVec3::new(1.0, 0.25, 0.25);
    assert!(
        (shapes[0].lengths - expected).length() < 1e-12,
        "{}",
        shapes[0].lengths
    );
    assert!(shapes[0].axes.x_axis.y.abs() > 1.0 - 1e-12);
    let moved = p.smoothing * w / (1.0 + w) * apart;
    assert!((shapes[0].centre - moved).length() < 1e-12);
}

/// A floor at y = 0.
struct FloorBelow;

impl Surroundings for FloorBelow {
    fn side(&self, _: usize) -> usize {
        0
    }

    fn distance(&self, _: usize, at: DVec3) -> f64 {
        at.y
    }

    fn apart(&self, a: usize, b: usize) -> bool {
        a + b == 1
    }
}

#[test]
fn a_wall_is_as_good_as_liquid() {
    // A lattice on a floor: its lowest layer half a spacing above.
    let p = parameters();
    let row = -4..=4;
    let lattice: Vec<DVec3> = row
        .clone()
        .flat_map(|x| (0..6).map(move |y| (x, y)))
        .flat_map(|(x, y)| row.clone().map(move |z| (x, y, z)))
        .map(|(x, y, z)| DVec3::new(x.into(), f64::from(y) + 0.5, z.into()))
        .collect();
    let centre = lattice
        .iter()
        .position(|&at| at == DVec3::new(0.0, 0.5, 0.0));
    let standing = p.shapes(&lattice, &FloorBelow)[centre.unwrap()];
    let floating = p.shapes(&lattice, &Nothing)[centre.unwrap()];
    // The continuum in the solid against a lattice above.
    assert!(
        (standing.lengths - p.scale).abs().max_element() < 0.12,
        "{standing:?}"
    );
    assert!((standing.centre.y - 0.5).abs() < 0.03, "{standing:?}");
    assert!(floating.lengths.z < 0.5 * p.scale, "{floating:?}");
    assert!(floating.centre.y > 0.8, "{floating:?}");
}

#[test]
fn glass_between_particles_parts_them() {
    let p = Anisotropy {
        fade: [-2.0, -1.0],
        ..parameters()
    };
    let positions = [DVec3::Y * 9.0, DVec3::Y * 9.5];
    let shapes = p.shapes(&positions, &FloorBelow);
    assert_eq!(shapes[0].centre, positions[0]);
}
