//! Texts of a lesson, in one language.

use std::collections::{BTreeMap, BTreeSet};

use serde::Deserialize;

use super::error::{Problems, listed};
use super::file::MOST;
use crate::language::Language;

/// Longest title, a line of the panel, characters; Chinese ones are twice as wide, so they have half of each limit.
const TITLE: usize = 60;
/// Longest text of a step or a rule, and longest hint.
const STEP: usize = 140;
/// Longest answer, a button of the panel's width.
const ANSWER: usize = 50;
/// Longest summary.
const SUMMARY: usize = 280;

/// Texts of a lesson.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LessonTexts {
    /// Its title: a line of the panel.
    pub title: String,
    /// What it is about, and what is to be done.
    pub summary: String,
    /// Texts of each step, by its id.
    #[serde(default)]
    pub step: BTreeMap<String, StepTexts>,
    /// Text of each rule, by its id: what must hold.
    #[serde(default)]
    pub rule: BTreeMap<String, String>,
}

/// Texts of a step.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StepTexts {
    /// What to do, or the question.
    pub text: String,
    /// How to do it, for a student who does not get on.
    pub hint: String,
    /// The same where mouse and keyboard move the hands; `None` where the hint fits both.
    #[serde(default)]
    pub hint_desk: Option<String>,
    /// The answers to the question, in the order of their numbers; none where nothing is asked.
    #[serde(default)]
    pub answers: Vec<String>,
}

impl LessonTexts {
    /// Puts the hints for mouse and keyboard in place of those for hands, where a step has them.
    pub(super) fn hint_at_desk(&mut self) {
        for step in self.step.values_mut() {
            if let Some(hint) = step.hint_desk.take() {
                step.hint = hint;
            }
        }
    }

    /// Checks that each of these steps, with so many answers, and rules has texts, that no other has, and that each text fits the panel.
    pub(super) fn check(
        &self,
        problems: &mut Problems,
        language: Language,
        (steps, rules): (&[(&str, usize)], &[&str]),
    ) {
        let field = format!("texts.{language}");
        let ids: Vec<&str> = steps.iter().map(|(id, _)| *id).collect();
        same_keys(problems, &format!("{field}.step"), self.step.keys(), &ids);
        same_keys(problems, &format!("{field}.rule"), self.rule.keys(), rules);
        let mut fits = |key: &str, text: &str, most: usize| {
            let most = match language {
                Language::Zh => most / 2,
                _ => most,
            };
            line(problems, &format!("{field}.{key}"), text, most);
        };
        fits("title", &self.title, TITLE);
        fits("summary", &self.summary, SUMMARY);
        for (id, step) in &self.step {
            fits(&format!("step.{id}.text"), &step.text, STEP);
            fits(&format!("step.{id}.hint"), &step.hint, STEP);
            if let Some(hint) = &step.hint_desk {
                fits(&format!("step.{id}.hint_desk"), hint, STEP);
            }
            for (nth, answer) in step.answers.iter().enumerate() {
                fits(&format!("step.{id}.answers[{nth}]"), answer, ANSWER);
            }
        }
        for (id, rule) in &self.rule {
            fits(&format!("rule.{id}"), rule, STEP);
        }
        for (id, needed) in steps {
            // Of a step without texts that is said already.
            let found = self.step.get(*id).map(|step| step.answers.len());
            if let Some(found) = found.filter(|found| found != needed) {
                let problem = problems.texts.answers.fill(&[
                    ("found", &found.to_string()),
                    ("needed", &needed.to_string()),
                ]);
                problems.add(format!("{field}.step.{id}.answers"), problem);
            }
        }
    }
}

fn same_keys<'a>(
    problems: &mut Problems,
    field: &str,
    found: impl Iterator<Item = &'a String>,
    needed: &[&str],
) {
    let found: BTreeSet<&str> = found.map(String::as_str).collect();
    for missing in needed.iter().filter(|id| !found.contains(*id)) {
        let problem = problems.texts.texts_missing.text();
        problems.add(format!("{field}.{missing}"), problem);
    }
    for other in found.iter().filter(|id| !needed.contains(id)).take(MOST) {
        let known = listed(&problems.texts, needed.iter().copied());
        let problem = problems.texts.texts_unknown.fill(&[("known", &known)]);
        problems.add(format!("{field}.{other}"), problem);
    }
}

fn line(problems: &mut Problems, field: &str, text: &str, most: usize) {
    let length = text.chars().count();
    let texts = &problems.texts;
    let problem = if text.trim().is_empty() {
        texts.empty.text()
    } else if length > most {
        let (length, most) = (length.to_string(), most.to_string());
        texts.long.fill(&[("length", &length), ("most", &most)])
    } else if text.chars().any(char::is_control) {
        texts.control.text()
    } else if text.contains(['{', '}']) {
        texts.brace.text()
    } else {
        return;
    };
    problems.add(field, problem);
}
