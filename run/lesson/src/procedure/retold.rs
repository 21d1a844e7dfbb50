//! Verdicts of a lesson from the [`Progress`] that a recording stores.

use serde::{Deserialize, Serialize};

use super::file::Lesson;
use super::judge::Procedure;
use super::mode::Mode;
use super::progress::{Progress, Status, Verdict, VerdictLine, Why};
use super::record::StepRecord;

impl Verdict {
    /// One verdict for each time that the lesson was begun, in order. Each equals the [`Procedure::verdict`] of the session. Progress of
    /// steps that the lesson does not have is ignored.
    pub fn retold(lesson: &Lesson, mode: Mode, said: &[Progress]) -> Vec<Self> {
        let begins = |it: &Progress| matches!(it, Progress::Begun { .. });
        let first = said.iter().position(begins).unwrap_or(said.len());
        let runs = said[first..].chunk_by(|_, next| !begins(next));
        let verdict = |run: &[Progress]| {
            let mut procedure = Procedure::new(lesson.clone(), mode);
            run.iter().for_each(|it| procedure.retell(it));
            procedure.verdict()
        };
        runs.map(verdict).collect()
    }
}

impl Procedure {
    fn retell(&mut self, said: &Progress) {
        match said {
            Progress::Begun { .. } | Progress::Over { .. } => {}
            Progress::StepBegun { id, .. } => {
                if let Some(step) = self.step(id) {
                    step.status = Status::Open;
                }
            }
            Progress::StepDone { id, evidence_s, .. } => {
                if let Some(step) = self.step(id) {
                    (step.status, step.evidence) = (Status::Done, Some(*evidence_s));
                }
            }
            Progress::StepFailed {
                id,
                evidence_s,
                why,
                missed,
                ..
            } => {
                if let Some(step) = self.step(id) {
                    step.failures += 1;
                    step.why = Some(why.clone());
                    if *missed {
                        (step.status, step.evidence) = (Status::Missed, Some(*evidence_s));
                    }
                }
            }
            Progress::HintDue { id, .. } => {
                if let Some(step) = self.step(id) {
                    step.hints += 1;
                }
            }
            Progress::RuleBroken {
                id,
                evidence_s,
                why,
                ..
            } => {
                let at = self.lesson.rules.iter().position(|rule| rule.id == *id);
                if let Some(rule) = at.and_then(|at| self.rules.get_mut(at)) {
                    let broken = (*evidence_s, why.clone());
                    rule.broken.get_or_insert(broken);
                }
            }
        }
    }

    fn step(&mut self, id: &str) -> Option<&mut StepRecord> {
        let at = self.lesson.steps.iter().position(|step| step.id == id)?;
        self.steps.get_mut(at)
    }
}

/// Outcome of a step or a rule, in a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Became {
    /// A step was done.
    Done,
    /// Something went wrong in a step, and it was not done afterwards.
    Failed,
    /// A step was not done: left out, out of time, or never reached.
    Missed,
    /// A rule was kept.
    Kept,
    /// A rule was broken.
    Broken,
}

impl Became {
    /// The word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Done => "done",
            Self::Failed => "failed",
            Self::Missed => "missed",
            Self::Kept => "kept",
            Self::Broken => "broken",
        }
    }
}

impl VerdictLine {
    /// Outcome of the step or rule.
    pub fn became(&self) -> Became {
        // Leaving out a step, running out of time and ending the lesson are stored as the step's last failure.
        let given_up = |why: &Why| matches!(why, Why::Skipped | Why::NotDone | Why::TimeUp { .. });
        let given_up = u32::from(self.why.as_ref().is_some_and(given_up));
        match (self.rule, self.met) {
            (true, true) => Became::Kept,
            (true, false) => Became::Broken,
            (false, true) => Became::Done,
            (false, false) if self.failures > given_up => Became::Failed,
            (false, false) => Became::Missed,
        }
    }
}
