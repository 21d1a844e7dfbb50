//! Points of a lesson.

use super::file::Lesson;
use super::mode::Mode;
use super::progress::{Status, Verdict, VerdictLine};
use super::record::{RuleRecord, StepRecord};

/// A step earns its points if it was done at the first try, half of them, rounded down, if it was done later. A rule that was kept earns
/// the same share of its points as the steps earned of theirs, rounded down: clean work on a third of a lesson is a third of clean work,
/// and a student who does nothing has kept nothing.
pub(super) fn of(
    lesson: &Lesson,
    mode: Mode,
    steps: &[StepRecord],
    rules: &[RuleRecord],
) -> Verdict {
    let mut lines = Vec::new();
    for (step, tried) in lesson.steps.iter().zip(steps) {
        let met = tried.status == Status::Done;
        lines.push(VerdictLine {
            id: step.id.clone(),
            rule: false,
            met,
            evidence_s: tried.evidence,
            why: tried.why.clone(),
            failures: tried.failures,
            hints: tried.hints,
            points: points(tried, step.points),
            of: step.points,
        });
    }
    let earned: u32 = lines.iter().map(|line| line.points).sum();
    let all: u32 = lines.iter().map(|line| line.of).sum();
    for (rule, kept) in lesson.rules.iter().zip(rules) {
        let met = kept.broken.is_none();
        let share = rule.points * earned / all.max(1);
        lines.push(VerdictLine {
            id: rule.id.clone(),
            rule: true,
            met,
            evidence_s: kept.broken.as_ref().map(|(evidence_s, _)| *evidence_s),
            why: kept.broken.as_ref().map(|(_, why)| why.clone()),
            failures: u32::from(!met),
            hints: 0,
            points: if met { share } else { 0 },
            of: rule.points,
        });
    }
    Verdict {
        lesson: lesson.name.clone(),
        mode,
        points: lines.iter().map(|line| line.points).sum(),
        of: lines.iter().map(|line| line.of).sum(),
        lines,
    }
}

fn points(tried: &StepRecord, of: u32) -> u32 {
    match (tried.status, tried.failures) {
        (Status::Done, 0) => of,
        (Status::Done, _) => of / 2,
        (Status::Waiting | Status::Open | Status::Missed, _) => 0,
    }
}
