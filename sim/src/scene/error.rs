//! What can be wrong with a scene.

use thiserror::Error;

/// Why a scene could not be loaded. Every message names the file, the place
/// in it and what would be right.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SceneError {
    /// No built-in scene has this name.
    #[error("scene {name:?}: not built in; take one of {known}")]
    NotFound {
        /// What was asked for.
        name: String,
        /// The built-in names.
        known: String,
    },
    /// Not TOML, or a key that is missing, unknown or of the wrong type. The
    /// message has the line and the keys that are known there.
    #[error("{file}: {message}")]
    Syntax {
        /// The file.
        file: String,
        /// The parser's message.
        message: String,
    },
    /// A value that makes no sense.
    #[error("{file}: {field}: {problem}")]
    Invalid {
        /// The file.
        file: String,
        /// Path of the field, such as `flask[1].wall`.
        field: String,
        /// What is wrong with it and what would be right.
        problem: String,
    },
}

/// A problem in a field, before the file's name is known to it.
pub(super) struct Problem {
    pub field: String,
    pub problem: String,
}

impl Problem {
    pub fn new(field: impl Into<String>, problem: impl ToString) -> Self {
        Self {
            field: field.into(),
            problem: problem.to_string(),
        }
    }

    pub fn in_file(self, file: &str) -> SceneError {
        SceneError::Invalid {
            file: file.to_owned(),
            field: self.field,
            problem: self.problem,
        }
    }
}
