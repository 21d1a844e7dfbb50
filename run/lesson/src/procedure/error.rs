//! What can be wrong with a lesson's file.

use crate::texts::TextsError;

/// Why a lesson could not be loaded, or does not fit its scene. Each message names the file, the field in it and what would be
/// right.
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
    /// Not TOML, or a key that is missing, unknown or of the wrong type. The message has the line and the keys that are known there.
    #[error("{file}: {message}")]
    Syntax {
        /// The file.
        file: String,
        /// The parser's message.
        message: String,
    },
    /// A value that makes no sense, or does not fit the scene.
    #[error("{file}: {field}: {problem}")]
    Invalid {
        /// The file.
        file: String,
        /// Path of the field, such as `step[1].points`.
        field: String,
        /// What is wrong with it and what would be right.
        problem: String,
    },
    /// A string table that the program carries is damaged, which a test rules out.
    #[error(transparent)]
    Texts(#[from] TextsError),
}

/// A problem in a field, before the file's name is added to it.
#[derive(Debug)]
pub(super) struct Problem {
    field: String,
    problem: String,
}

impl Problem {
    pub fn new(field: impl Into<String>, problem: impl ToString) -> Self {
        Self {
            field: field.into(),
            problem: problem.to_string(),
        }
    }

    pub fn in_file(self, file: &str) -> LessonError {
        LessonError::Invalid {
            file: file.to_owned(),
            field: self.field,
            problem: self.problem,
        }
    }
}

/// Refuses a value that is not a number from `least` to `most`; `field` is its path in the message.
pub(super) fn within(field: &str, value: f64, least: f64, most: f64) -> Result<(), Problem> {
    if value.is_finite() && (least..=most).contains(&value) {
        return Ok(());
    }
    let problem = format!("{value} is not from {least} to {most}");
    Err(Problem::new(field, problem))
}

/// Formats names as a list in a message.
pub(super) fn listed<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let names: Vec<String> = names.into_iter().map(|name| format!("{name:?}")).collect();
    if names.is_empty() {
        return "none".to_owned();
    }
    names.join(", ")
}
