//! Yu & Turk 2013, "Reconstructing surfaces of particle-based fluids using
//! anisotropic kernels", sections 4.1 and 4.2: each particle's smoothed centre
//! and the matrix G that stretches its kernel. Equation numbers are the
//! paper's.

use std::f64::consts::TAU;

use glam::{DMat3, DVec3};

use super::buckets::Buckets;
use super::eigen::eigen_symmetric;
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
    /// Parameters for particles of spacing `spacing` and neighbours within `radius`.
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
        let grid = Buckets::of_points(positions, self.radius);
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
    /// Moments of an empty neighbourhood.
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
