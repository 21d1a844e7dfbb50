//! Measurements of a state.

/// max(0, ρ/ρ₀ − 1) over all particles.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DensityError {
    /// Mean, 0 without particles.
    pub mean: f64,
    /// 99th percentile: the value that at most 1 % of the particles exceed.
    pub p99: f64,
}

impl DensityError {
    /// Error of the `densities` ρ/ρ₀.
    ///
    /// A free surface lacks neighbours and is allowed to (Eq. 2), so a density
    /// below ρ₀ counts as no error.
    pub fn of(densities: &[f64]) -> Self {
        let mut errors: Vec<_> = densities
            .iter()
            .map(|density| (density - 1.0).max(0.0))
            .collect();
        errors.sort_unstable_by(f64::total_cmp);
        let rank = (errors.len() * 99).div_ceil(100).max(1) - 1;
        Self {
            mean: errors.iter().sum::<f64>() / errors.len().max(1) as f64,
            p99: errors.get(rank).copied().unwrap_or_default(),
        }
    }
}
