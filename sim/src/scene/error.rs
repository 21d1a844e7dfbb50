//! Errors of a scene.

use thiserror::Error;

/// Why a scene could not be loaded. Every message names the file, the place
/// in it and a valid alternative.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SceneError {
    /// No built-in scene has this name.
    #[error("scene {name:?}: not built in; take one of {known}")]
    NotFound {
        /// The name that was given.
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
        /// What is wrong with it and which values are valid.
        problem: String,
    },
}

/// A problem in a field, without the file's name yet.
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
