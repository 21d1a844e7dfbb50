//! Percentiles by nearest rank: each is a value that was measured.

use serde::Serialize;

/// Values in order.
#[derive(Debug)]
pub struct Ranks(Vec<f64>);

impl Ranks {
    /// Ranks values, which are given in any order.
    pub fn of(values: &[f64]) -> Self {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        Self(sorted)
    }

    /// The least value that at least this share of them (0 to 1) does not exceed; `None` of none.
    pub fn at(&self, share: f64) -> Option<f64> {
        let rank = (share * self.0.len() as f64).ceil() as usize;
        self.0.get(rank.saturating_sub(1)).copied()
    }
}

/// Median, 95th, 99th and 99.9th percentile and the greatest of measured values; each is one of them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// Median.
    pub p50: f64,
    /// 95th percentile.
    pub p95: f64,
    /// 99th percentile.
    pub p99: f64,
    /// 99.9th percentile.
    pub p999: f64,
    /// The greatest.
    pub max: f64,
}

impl Spread {
    /// Spread of `values` by nearest rank; `None` without values.
    pub fn of(values: &[f64]) -> Option<Self> {
        let ranks = Ranks::of(values);
        Some(Self {
            p50: ranks.at(0.5)?,
            p95: ranks.at(0.95)?,
            p99: ranks.at(0.99)?,
            p999: ranks.at(0.999)?,
            max: ranks.at(1.0)?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of 2,000 values by nearest rank: the 1,000th, 1,900th, 1,980th, 1,998th and last.
    #[test]
    fn a_spread_has_five_ranks() {
        let values: Vec<f64> = (1..=2000).map(f64::from).collect();
        let spread = Spread {
            p50: 1000.0,
            p95: 1900.0,
            p99: 1980.0,
            p999: 1998.0,
            max: 2000.0,
        };
        assert_eq!(Spread::of(&values), Some(spread));
    }

    #[test]
    fn percentiles_are_measured_values() {
        let values: Vec<f64> = (1..=100).rev().map(f64::from).collect();
        let ranks = Ranks::of(&values);
        for (share, value) in [
            (0.0, 1.0),
            (0.5, 50.0),
            (0.95, 95.0),
            (0.951, 96.0),
            (1.0, 100.0),
        ] {
            assert_eq!(ranks.at(share), Some(value), "{share}");
        }
        assert_eq!(Ranks::of(&[3.0]).at(0.5), Some(3.0));
        assert_eq!(Ranks::of(&[]).at(0.5), None);
    }
}
