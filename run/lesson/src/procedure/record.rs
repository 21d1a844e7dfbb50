//! State of each step and each rule of a lesson.

use super::keeping::Keeping;
use super::progress::{Status, Why};
use super::watch::Watch;

/// State of a step.
#[derive(Clone, Debug, Default)]
pub(super) struct StepRecord {
    pub status: Status,
    /// Time from which on events count for it, s.
    pub began: f64,
    /// Time at which it was shown, s.
    pub shown: f64,
    /// Time from which on the delay of its hint runs, s.
    pub waits: f64,
    /// After a failure, earliest time at which a pour may begin, s.
    pub again: Option<f64>,
    pub watch: Watch,
    pub keeping: Vec<Keeping>,
    pub failures: u32,
    pub hints: u32,
    pub hint: bool,
    pub evidence: Option<f64>,
    pub why: Option<Why>,
}

/// State of a rule.
#[derive(Clone, Debug, Default)]
pub(super) struct RuleRecord {
    pub keeping: Keeping,
    pub broken: Option<(f64, Why)>,
}

impl StepRecord {
    /// Whether all its requirements hold now.
    pub fn keeps(&self) -> bool {
        !self.keeping.iter().any(|it| it.breached)
    }
}
