//! The lesson that a class is graded by: what a track holds on it, and how that agrees with what a simulation finds.

use serde::Serialize;
use vitriol_lesson::procedure::{Verdict, VerdictLine};
use vitriol_lesson::{Lesson, Mode, ReportTexts};

use super::agreement::{Agreement, Tolerance};
use super::beyond::{Beyond, Thing, Values};

/// A lesson's part of a line of the table.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct OfLesson {
    /// The lesson's name.
    pub name: String,
    /// Points.
    pub points: u32,
    /// Points that could be had.
    pub of: u32,
    /// By step, then by rule, in the order of the lesson's file.
    pub items: Vec<Item>,
}

/// The result of a step or a rule.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Item {
    /// Its id.
    pub id: String,
    /// Whether it is a rule.
    pub rule: bool,
    /// In a word: a step was done, failed or missed, a rule kept or broken.
    pub became: &'static str,
    /// Points.
    pub points: u32,
    /// Points that could be had.
    pub of: u32,
}

impl OfLesson {
    /// A verdict as a line of the table shows it.
    pub fn of(verdict: &Verdict) -> Self {
        let item = |line: &VerdictLine| Item {
            id: line.id.clone(),
            rule: line.rule,
            became: line.became().name(),
            points: line.points,
            of: line.of,
        };
        Self {
            name: verdict.lesson.clone(),
            points: verdict.points,
            of: verdict.of,
            items: verdict.lines.iter().map(item).collect(),
        }
    }

    /// What was not done or kept, in a few words; empty where all was.
    pub fn unmet(&self, texts: &ReportTexts) -> String {
        let bad = self.items.iter().filter_map(|it| {
            let became = match it.became {
                "failed" => &texts.failed,
                "missed" => &texts.missed,
                "broken" => &texts.broken,
                _ => return None,
            };
            Some(format!("{} {became}", it.id))
        });
        bad.collect::<Vec<_>>().join(", ")
    }
}

/// A lesson, and what it has columns for.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Columns {
    /// Its name.
    pub name: String,
    /// How it was to be gone through.
    pub mode: Mode,
    /// Ids of its steps, then of its rules.
    pub items: Vec<String>,
    /// How many of these are steps.
    pub steps: usize,
}

impl Columns {
    /// Those of a lesson.
    pub fn of(lesson: &Lesson, mode: Mode) -> Self {
        let steps = lesson.steps.iter().map(|step| step.id.clone());
        let rules = lesson.rules.iter().map(|rule| rule.id.clone());
        Self {
            name: lesson.name.clone(),
            mode,
            items: steps.chain(rules).collect(),
            steps: lesson.steps.len(),
        }
    }

    fn heads(&self) -> impl Iterator<Item = String> {
        let items = self.items.iter().enumerate();
        items.map(move |(at, id)| head(at >= self.steps, id))
    }
}

const NAME: &str = "lesson";
const POINTS: &str = "lesson [points]";
const OF: &str = "lesson of";

fn head(rule: bool, id: &str) -> String {
    let kind = if rule { "rule" } else { "step" };
    format!("{kind} {id}")
}

/// Heads of the columns of these lessons: a step or rule that several have is in one column.
pub fn heads(lessons: &[Columns]) -> Vec<String> {
    if lessons.is_empty() {
        return Vec::new();
    }
    let mut heads = [NAME, POINTS, OF].map(str::to_owned).to_vec();
    for head in lessons.iter().flat_map(Columns::heads) {
        if !heads.contains(&head) {
            heads.push(head);
        }
    }
    heads
}

/// A line's cells under these heads: empty where it has none.
pub fn cells(heads: &[String], line: Option<&OfLesson>) -> Vec<String> {
    let cell = |under: &String| {
        let Some(line) = line else {
            return String::new();
        };
        match under.as_str() {
            NAME => line.name.clone(),
            POINTS => line.points.to_string(),
            OF => line.of.to_string(),
            under => {
                let mut items = line.items.iter();
                let item = items.find(|it| head(it.rule, &it.id) == under);
                item.map_or_else(String::new, |it| it.became.to_owned())
            }
        }
    };
    heads.iter().map(cell).collect()
}

impl Agreement {
    /// Adds how the lesson's results in a recording agree with those that were found.
    pub fn with_lesson(
        mut self,
        recorded: &[Verdict],
        found: &[Verdict],
        tolerance: Tolerance,
    ) -> Self {
        let [a, b] = [recorded, found].map(<[Verdict]>::len);
        if a != b {
            self.beyond.push(Beyond::Lessons([a, b]));
        }
        for (attempt, (recorded, found)) in (1..).zip(recorded.iter().zip(found)) {
            for (recorded, found) in recorded.lines.iter().zip(&found.lines) {
                self.compare_line(attempt, recorded, found, tolerance);
            }
        }
        self
    }

    fn compare_line(
        &mut self,
        attempt: u32,
        recorded: &VerdictLine,
        found: &VerdictLine,
        tolerance: Tolerance,
    ) {
        let both = [recorded, found];
        let mut beyond = |values: Values| {
            let id = recorded.id.clone();
            let thing = match recorded.rule {
                true => Thing::Rule(id),
                false => Thing::Step(id),
            };
            self.beyond.push(Beyond::Thing {
                attempt,
                thing,
                values,
            });
        };
        let became = both.map(VerdictLine::became);
        if became[0] != became[1] {
            beyond(Values::Outcomes(became));
            return;
        }
        let [a, b] = both.map(|it| it.points);
        // A rule's are a share of the steps'.
        if a != b && !recorded.rule {
            beyond(Values::Points([a, b]));
            return;
        }
        if let [Some(a), Some(b)] = both.map(|it| it.evidence_s) {
            let within = (a - b).abs() <= tolerance.time_s;
            if !within {
                beyond(Values::Moments([a, b]));
            }
            self.time_s = self.time_s.max((a - b).abs());
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::wrong::Words;
    use super::*;
    use vitriol_lesson::Language;

    fn verdict(change: &dyn Fn(&mut VerdictLine)) -> Vec<Verdict> {
        let mut line = VerdictLine {
            id: "pour".into(),
            rule: false,
            met: true,
            evidence_s: Some(5.0),
            why: None,
            failures: 0,
            hints: 0,
            points: 10,
            of: 10,
        };
        change(&mut line);
        vec![Verdict {
            lesson: "own".into(),
            mode: Mode::Free,
            points: line.points,
            of: 10,
            lines: vec![line],
        }]
    }

    #[test]
    fn what_a_lesson_came_to_agrees_or_not() {
        let said = verdict(&|_| {});
        let agreement = |found: &[Verdict]| {
            Agreement::default().with_lesson(&said, found, Tolerance::default())
        };
        let later = agreement(&verdict(&|it| it.evidence_s = Some(5.15)));
        assert!(later.beyond.is_empty() && (later.time_s - 0.15).abs() < 1e-9);
        let english = Words::of(Language::En).unwrap();
        let beyond = |change: &dyn Fn(&mut VerdictLine)| {
            let agreement = agreement(&verdict(change));
            assert_eq!(agreement.beyond.len(), 1, "{agreement:?}");
            agreement.text(&english)
        };
        let text = beyond(&|it| it.evidence_s = Some(5.5));
        assert_eq!(
            text,
            "attempt 1, step pour: at 5.00 s in the recording, at 5.50 s found"
        );
        let points = beyond(&|it| it.points = 5);
        assert!(points.ends_with("points of step pour: 10 in the recording, 5 found"));
        assert!(beyond(&|it| it.met = false).ends_with("done in the recording, missed found"));
        let never = agreement(&[]).text(&english);
        assert!(
            never.ends_with("begun: 1 in the recording, 0 found"),
            "{never}"
        );
    }
}
