//! What can be wrong with a lesson's file.

use std::fmt;

use crate::texts::{FaultTexts, TextsError};

/// Why a lesson could not be loaded, or does not fit its scene. Each message names the file, its line and field, and what would be right.
#[derive(Debug, thiserror::Error)]
pub enum LessonError {
    /// No built-in lesson has this name.
    #[error("lesson {name:?}: not built in; take a file, or one of {known}")]
    NotFound {
        /// The name that was asked for.
        name: String,
        /// The built-in names.
        known: String,
    },
    /// A new lesson cannot have that name: says so in the language that was asked for.
    #[error("{0}")]
    NewName(String),
    /// Not TOML, a key that is missing or unknown, or a value that makes no sense or does not fit the scene: a line for each.
    #[error("{}", lines(.file, .faults))]
    Faulty {
        /// The file.
        file: String,
        /// Its faults, by their lines.
        faults: Vec<Fault>,
    },
    /// A string table that the program carries is damaged, which a test rules out.
    #[error(transparent)]
    Texts(#[from] TextsError),
}

/// A fault of a lesson's file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Its line, counted from 1.
    pub line: usize,
    /// Path of the field, such as `step[1].points`, with indices from 0; empty where the text is no TOML.
    pub field: String,
    /// In a line, in the language that was asked for: where it is, what is wrong and what would be right.
    pub text: String,
}

impl Fault {
    /// The fault of a field of that line.
    pub(super) fn new(texts: &FaultTexts, line: usize, field: &str, problem: &str) -> Self {
        let template = match field {
            "" => &texts.line,
            _ => &texts.field,
        };
        let text = template.fill(&[
            ("line", &line.to_string()),
            ("field", &counted_from_one(field)),
            ("problem", problem),
        ]);
        Self {
            line,
            field: field.to_owned(),
            // A key of the file may have a line break; a fault is one line.
            text: text.replace(['\n', '\r'], " "),
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// The path in a teacher's words, who counts from 1: `step[0].points` is `step 1, points`.
fn counted_from_one(field: &str) -> String {
    let (mut path, mut rest) = (String::new(), field);
    while let Some((before, (index, behind))) = next_index(rest) {
        path += &format!("{before} {}", index.saturating_add(1));
        rest = behind.strip_prefix('.').unwrap_or(behind);
        if !rest.is_empty() {
            path += ", ";
        }
    }
    path + rest
}

/// What stands before the first `[index]` of a path, and the index with what stands behind it.
fn next_index(path: &str) -> Option<(&str, (usize, &str))> {
    let (before, rest) = path.split_once('[')?;
    let (index, behind) = rest.split_once(']')?;
    Some((before, (index.parse().ok()?, behind)))
}

/// A line for each fault, each with the file's name: editors open such lines.
fn lines(file: &str, faults: &[Fault]) -> String {
    let lines = faults.iter().map(|fault| format!("{file}: {fault}"));
    lines.collect::<Vec<_>>().join("\n")
}

/// A problem in a field, before its line is looked for.
#[derive(Debug)]
pub(super) struct Problem {
    pub field: String,
    pub problem: String,
}

/// The problems of a lesson, and the sentences that say them.
#[derive(Debug)]
pub(super) struct Problems {
    pub texts: FaultTexts,
    pub found: Vec<Problem>,
}

impl Problems {
    /// None so far.
    pub fn new(texts: FaultTexts) -> Self {
        Self {
            texts,
            found: Vec::new(),
        }
    }

    /// Adds a problem of a field.
    pub fn add(&mut self, field: impl Into<String>, problem: String) {
        self.found.push(Problem {
            field: field.into(),
            problem,
        });
    }

    /// Adds one where a value is not a number from `least` to `most`.
    pub fn within(&mut self, field: &str, value: f64, least: f64, most: f64) {
        if !value.is_finite() || !(least..=most).contains(&value) {
            let problem = self.texts.range.fill(&[
                ("value", &value.to_string()),
                ("least", &least.to_string()),
                ("most", &most.to_string()),
            ]);
            self.add(field, problem);
        }
    }
}

/// Formats names as a list in a message.
pub(super) fn listed<'a>(texts: &FaultTexts, names: impl IntoIterator<Item = &'a str>) -> String {
    let names: Vec<String> = names.into_iter().map(|name| format!("{name:?}")).collect();
    if names.is_empty() {
        return texts.none.text();
    }
    names.join(", ")
}
