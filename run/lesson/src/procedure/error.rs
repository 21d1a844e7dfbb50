//! What can be wrong with a lesson's file.

use std::fmt;

use crate::texts::TextsError;

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
    /// A new lesson cannot have that name.
    #[error(
        "lesson {name:?}: no name for a new one; take 1 to 40 of a to z, 0 to 9 and -, and none of the built-in {known}"
    )]
    NewName {
        /// The name that was asked for.
        name: String,
        /// The built-in names.
        known: String,
    },
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
    /// What is wrong with it and what would be right.
    pub problem: String,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: ", self.line)?;
        if !self.field.is_empty() {
            write!(f, "{}: ", counted_from_one(&self.field))?;
        }
        // A key of the file may have a line break; a fault is one line.
        f.write_str(&self.problem.replace(['\n', '\r'], " "))
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

/// The problems of a lesson.
#[derive(Debug, Default)]
pub(super) struct Problems(pub Vec<Problem>);

impl Problems {
    /// Adds a problem of a field.
    pub fn add(&mut self, field: impl Into<String>, problem: impl ToString) {
        self.0.push(Problem {
            field: field.into(),
            problem: problem.to_string(),
        });
    }

    /// Adds one where a value is not a number from `least` to `most`.
    pub fn within(&mut self, field: &str, value: f64, least: f64, most: f64) {
        if !value.is_finite() || !(least..=most).contains(&value) {
            self.add(field, format!("{value} is not from {least} to {most}"));
        }
    }
}

/// Formats names as a list in a message.
pub(super) fn listed<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let names: Vec<String> = names.into_iter().map(|name| format!("{name:?}")).collect();
    if names.is_empty() {
        return "none".to_owned();
    }
    names.join(", ")
}
