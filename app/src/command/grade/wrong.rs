//! What went wrong first in an attempt, in a sentence.

use vitriol_lesson::procedure::{Verdict, VerdictLine};
use vitriol_lesson::{Evidence, Language, Lesson, Texts};
use vitriol_run::texts::GradesTexts;
use vitriol_run::{Blame, Failure};

use super::graded::Scored;

/// What the table says, in the teacher's language.
#[derive(Debug)]
pub struct Words {
    /// The language.
    pub language: Language,
    /// Texts on attempts.
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
            language,
            texts: Texts::of(language).other()?,
            grades: vitriol_run::texts::Texts::of(language)?.grades,
        })
    }

    /// What went wrong first: an incident, a step or rule of the lesson, or what caps the points. Of one moment the first of these.
    pub fn first_wrong(
        &self,
        scored: &Scored,
        lesson: Option<(&Lesson, &Verdict)>,
    ) -> Option<Evidence> {
        let attempt = &scored.attempt;
        let incidents = attempt.incidents.iter().map(|it| Evidence {
            t_s: Some(it.t_s),
            text: self.texts.wrong(attempt, it),
        });
        let lines = lesson
            .into_iter()
            .flat_map(|(lesson, verdict)| verdict.lines.iter().map(move |line| (lesson, line)));
        let lines = lines.filter_map(|(lesson, line)| self.unmet(lesson, line));
        let caps = scored.score.caps.iter().map(|it| Evidence {
            t_s: it.t_s(),
            text: it.text.clone(),
        });
        let moment = |it: &Evidence| it.t_s.unwrap_or(f64::INFINITY);
        let all = incidents.chain(lines).chain(caps);
        all.min_by(|a, b| moment(a).total_cmp(&moment(b)))
    }

    /// A step that was not done, or a rule that was broken: what was asked, and why it is not met.
    fn unmet(&self, lesson: &Lesson, line: &VerdictLine) -> Option<Evidence> {
        let why = line.why.as_ref().filter(|_| !line.met)?;
        let texts = lesson.texts(self.language);
        let asked = match line.rule {
            true => texts.rule.get(&line.id),
            false => texts.step.get(&line.id).map(|it| &it.text),
        };
        let asked = asked.unwrap_or(&line.id);
        Some(Evidence {
            t_s: line.evidence_s,
            text: format!("{asked} {}", self.texts.why(why)),
        })
    }

    /// A sentence with its moment, if it has one.
    pub fn told(&self, said: &Evidence) -> String {
        match said.t_s {
            Some(t_s) => self.grades.at(t_s, &said.text),
            None => said.text.clone(),
        }
    }
}
