//! How a lesson is gone through.

use std::fmt;
use std::str::FromStr;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How a lesson is gone through.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, JsonSchema, Serialize, Deserialize,
)]
#[serde(rename_all = "kebab-case")]
pub enum Mode {
    /// Steps are shown one at a time, with hints that come by themselves; a step that fails is tried again.
    Guided,
    /// All steps are shown and done in any order that their `after` allows; hints are asked for; a step that fails is tried again.
    Free,
    /// As `free`, without hints; a step that fails is missed, and no result is shown before the end.
    Examination,
}

/// There is no such mode.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("mode {name:?}: not known; take one of guided, free, examination")]
pub struct ModeError {
    /// The name that was asked for.
    pub name: String,
}

impl Mode {
    /// All modes.
    pub const ALL: [Self; 3] = [Self::Guided, Self::Free, Self::Examination];

    /// Its name in options and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Guided => "guided",
            Self::Free => "free",
            Self::Examination => "examination",
        }
    }

    /// Whether one step is open at a time.
    pub fn one_at_a_time(self) -> bool {
        self == Self::Guided
    }

    /// Whether hints come by themselves.
    pub fn hints_come(self) -> bool {
        self == Self::Guided
    }

    /// Whether a hint may be asked for.
    pub fn hints_are_given(self) -> bool {
        self != Self::Examination
    }

    /// Whether a step that failed is tried again.
    pub fn tries_again(self) -> bool {
        self != Self::Examination
    }

    /// Whether the user sees before the end what is done and what failed.
    pub fn tells(self) -> bool {
        self != Self::Examination
    }
}

impl fmt::Display for Mode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Mode {
    type Err = ModeError;

    fn from_str(name: &str) -> Result<Self, ModeError> {
        let mut all = Self::ALL.into_iter();
        all.find(|it| it.name() == name).ok_or_else(|| ModeError {
            name: name.to_owned(),
        })
    }
}
