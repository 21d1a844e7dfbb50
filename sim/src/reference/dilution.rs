//! Diffusion and heat of solution (Eqs 5 to 13; line 26).

use super::neighbours::Neighbours;
use crate::chemistry::exchange::Exchange;
use crate::chemistry::paper::{Diffusion, Dilution};
use crate::chemistry::thomsen;
use glam::DVec3;

/// Where particles are, for the sums of line 26: at committed positions.
#[derive(Clone, Copy, Debug)]
pub struct Pairs<'a> {
    /// Weights of pairs and their limit.
    pub exchange: &'a Exchange,
    /// x_i, stage, metres.
    pub positions: &'a [DVec3],
    /// Everything within h, and maybe more.
    pub neighbours: &'a Neighbours,
}

impl Pairs<'_> {
    /// Distance of two particles, metres.
    pub fn distance(&self, i: usize, j: usize) -> f64 {
        self.positions[i].distance(self.positions[j])
    }

    /// Σ_j of `term` for every particle. What is out of reach, and maybe not
    /// a number, is left out.
    pub fn sums<T: std::iter::Sum>(&self, term: impl Fn(usize, usize) -> T) -> Vec<T> {
        let sum = |i: usize| {
            let near = |&j: &usize| self.exchange.coefficient(self.distance(i, j)) > 0.0;
            self.neighbours.of(i).filter(near).map(|j| term(i, j)).sum()
        };
        (0..self.positions.len()).map(sum).collect()
    }
}

/// K_ij of Eq. 5 for the diffusivity `diffusivity` (m²/s), by the scheme and
/// the densities ρ/ρ₀ that the literal one takes.
#[derive(Clone, Copy, Debug)]
pub enum Weight<'a> {
    /// The weights of [`Diffusion::Conservative`].
    Conservative(f64),
    /// The weights of [`Diffusion::Literal`], with ρ_i/ρ₀ at committed positions.
    Literal(f64, &'a [f64]),
}

impl<'a> Weight<'a> {
    /// Weights of `scheme`.
    pub fn of(scheme: Diffusion, diffusivity: f64, densities: &'a [f64]) -> Self {
        match scheme {
            Diffusion::Conservative => Self::Conservative(diffusivity),
            Diffusion::Literal => Self::Literal(diffusivity, densities),
        }
    }

    fn share(&self, pairs: &Pairs, i: usize, j: usize) -> f64 {
        let distance = pairs.distance(i, j);
        match *self {
            Self::Conservative(diffusivity) => pairs.exchange.share(diffusivity, distance),
            Self::Literal(diffusivity, densities) => {
                let (own, other) = (densities[i], densities[j]);
                let skew = 2.0 * own / (other * (own + other));
                let share = pairs.exchange.unlimited(diffusivity, distance) * skew;
                pairs.exchange.limited(share)
            }
        }
    }
}

/// Eq. 5: the values after A_i ← A_i + Σ_j K_ij(A_j − A_i), all from the old
/// ones: in one loop, as lines 22–29 have it, they would hang on the
/// particles' order.
pub fn diffuse(pairs: &Pairs, weight: &Weight, values: &[f64]) -> Vec<f64> {
    let changes = pairs.sums(|i, j| weight.share(pairs, i, j) * (values[j] - values[i]));
    values
        .iter()
        .zip(changes)
        .map(|(a, b): (_, f64)| a + b)
        .collect()
}

/// Eqs 6 to 13: ΔT_i, K, of a diffusion step that took the acid fractions
/// from `before` to `after`.
pub fn heat_of_solution(
    pairs: &Pairs,
    weight: &Weight,
    dilution: &Dilution,
    before: &[f64],
    after: &[f64],
) -> Vec<f64> {
    let secants: Vec<_> = before
        .iter()
        .zip(after)
        .map(|(&before, &after)| thomsen::secant(before, after))
        .collect();
    pairs.sums(|i, j| {
        let change = weight.share(pairs, i, j) * (before[j] - before[i]);
        let heat = dilution.pair_heat((secants[i], secants[j]), change);
        dilution.warming(heat, before[i], before[j])
    })
}
