//! What went wrong first in an attempt, in a sentence.

use vitriol_lesson::procedure::{Verdict, VerdictLine};
use vitriol_lesson::{Evidence, Language, Texts};
use vitriol_run::texts::GradesTexts;
use vitriol_run::{Blame, Failure};

use super::graded::Scored;

/// What the table says, in the teacher's language.
#[derive(Debug)]
pub struct Words {
    /// Texts on attempts, and of the lessons that they have [learnt](Texts::learn).
    pub texts: Texts,
    /// Texts of the table.
    pub grades: GradesTexts,
}

impl Words {
    /// Those of a language.
    ///
    /// # Errors
    /// [`Failure::Other`] where a text is missing, which a test rules out.
    pub fn of(language: Language) -> Result<Self, Failure> {
        Ok(Self {
            texts: Texts::of(language).other()?,
            grades: vitriol_run::texts::Texts::of(language)?.grades,
        })
    }

    /// What went wrong first: an incident, a step or rule of the lesson, or what caps the points. Of one moment the first of these.
    pub fn first_wrong(&self, scored: &Scored, verdict: Option<&Verdict>) -> Option<Evidence> {
        let attempt = &scored.attempt;
        let incidents = attempt.incidents.iter().map(|it| Evidence {
            t_s: Some(it.t_s),
            text: self.texts.wrong(attempt, it),
        });
        let lines = verdict.into_iter().flat_map(|verdict| {
            let lines = verdict.lines.iter();
            lines.filter_map(move |line| self.unmet(&verdict.lesson, line))
        });
        let caps = scored.score.caps.iter().map(|it| Evidence {
            t_s: it.t_s(),
            text: it.text.clone(),
        });
        let moment = |it: &Evidence| it.t_s.unwrap_or(f64::INFINITY);
        let all = incidents.chain(lines).chain(caps);
        all.min_by(|a, b| moment(a).total_cmp(&moment(b)))
    }

    /// A step that was not done, or a rule that was broken: what was asked, and why it is not met.
    fn unmet(&self, lesson: &str, line: &VerdictLine) -> Option<Evidence> {
        let why = line.why.as_ref().filter(|_| !line.met)?;
        let asked = self.texts.asked(lesson, &line.id);
        Some(Evidence {
            t_s: line.evidence_s,
            text: format!("{asked} {}", self.texts.why(why)),
        })
    }
}
