//! The languages that have a string table.

use std::fmt;
use std::str::FromStr;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A language of `run/lesson/texts`.
#[derive(
    Clone,
    Copy,
    Debug,
    Default,
    PartialEq,
    Eq,
    PartialOrd,
    Ord,
    Hash,
    JsonSchema,
    Serialize,
    Deserialize,
)]
#[serde(rename_all = "lowercase")]
pub enum Language {
    /// English, which stands in for a language that a lesson does not have, if the lesson has English.
    #[default]
    En,
    /// German.
    De,
    /// Spanish.
    Es,
    /// Chinese, simplified.
    Zh,
}

/// There is no string table for that language.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("language {name:?}: not known; take one of {}", Language::codes())]
pub struct LanguageError {
    /// The name that was asked for.
    pub name: String,
}

impl Language {
    /// All languages, English first.
    pub const ALL: [Self; 4] = [Self::En, Self::De, Self::Es, Self::Zh];

    /// Its code (ISO 639-1), which is the file name of its table.
    pub fn code(self) -> &'static str {
        match self {
            Self::En => "en",
            Self::De => "de",
            Self::Es => "es",
            Self::Zh => "zh",
        }
    }

    fn codes() -> String {
        Self::ALL.map(Self::code).join(", ")
    }
}

impl fmt::Display for Language {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.code())
    }
}

/// Parses a code, or a system's name of a locale, of which region and encoding are ignored: `de`, `de-AT`, `zh_CN.UTF-8`.
impl FromStr for Language {
    type Err = LanguageError;

    fn from_str(name: &str) -> Result<Self, LanguageError> {
        let first = name.split(['-', '_', '.', '@']).next().unwrap_or(name);
        let mut all = Self::ALL.into_iter();
        all.find(|it| it.code().eq_ignore_ascii_case(first))
            .ok_or_else(|| LanguageError {
                name: name.to_owned(),
            })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn a_language_has_its_code_and_the_names_of_its_locales() {
        for (name, language) in [
            ("en", Language::En),
            ("DE", Language::De),
            ("es-MX", Language::Es),
            ("zh_CN.UTF-8", Language::Zh),
        ] {
            assert_eq!(name.parse(), Ok(language));
        }
        for language in Language::ALL {
            assert_eq!(language.to_string().parse(), Ok(language));
        }
        for wrong in ["", "e", "english", "fr", "C.UTF-8"] {
            let error = wrong.parse::<Language>().unwrap_err().to_string();
            assert!(error.contains("en, de, es, zh"), "{error}");
        }
    }
}
