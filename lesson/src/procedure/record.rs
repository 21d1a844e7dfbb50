//! How each step and each rule of a lesson stands.

use super::keeping::Keeping;
use super::progress::{Status, Why};
use super::watch::Watch;

/// A step as it stands.
#[derive(Clone, Debug, Default)]
pub(super) struct StepRecord {
    pub status: Status,
    /// From when on what happens is of it, s.
    pub began: f64,
    /// From when on it was shown, s.
    pub shown: f64,
    /// From when on the time until the hint runs, s.
    pub waits: f64,
    /// From when on a pour may begin, s: after a failure.
    pub again: Option<f64>,
    pub watch: Watch,
    pub keeping: Vec<Keeping>,
    pub failures: u32,
    pub hints: u32,
    pub hint: bool,
    pub evidence: Option<f64>,
    pub why: Option<Why>,
}

/// A rule as it stands.
#[derive(Clone, Debug, Default)]
pub(super) struct RuleRecord {
    pub keeping: Keeping,
    pub broken: Option<(f64, Why)>,
}

impl StepRecord {
    /// Whether what it asks to be kept is so now.
    pub fn keeps(&self) -> bool {
        !self.keeping.iter().any(|it| it.breached)
    }
}
