//! The name under which a student's attempts are kept.

use std::fmt;
use std::str::FromStr;

/// Longest pseudonym, characters. Our choice: fits a column of a table.
const LONGEST: usize = 32;

/// Stands for a student in all that is kept and sent. The list of students' names is not part of this program's data.
///
/// Letters, digits, `-` and `_` of ASCII, so that it is one word in a command line, a file's name and a table.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Pseudonym(String);

/// Why a text is no pseudonym.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PseudonymError {
    /// The text is empty.
    #[error("a pseudonym is missing: {RIGHT}")]
    Empty,
    /// An address names a person.
    #[error("'{0}' looks like an e-mail address, which names a person: {RIGHT}")]
    Address(String),
    /// Several words may be a person's name.
    #[error("'{0}' has a space in it and may be a person's name: {RIGHT}")]
    Space(String),
    /// It has a character that is not allowed.
    #[error("'{0}' has '{1}' in it: {RIGHT}")]
    Character(String, char),
    /// It begins like a flag.
    #[error("'{0}' begins with '-' or '_': {RIGHT}")]
    Beginning(String),
    /// It is too long: its length, characters.
    #[error("the pseudonym has {0} characters: {RIGHT}")]
    Long(usize),
}

/// Remedy for messages.
const RIGHT: &str =
    "a pseudonym is one word of at most 32 letters (a to z), digits, '-' and '_', such as p07";

impl Pseudonym {
    /// The pseudonym as text.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl FromStr for Pseudonym {
    type Err = PseudonymError;

    fn from_str(text: &str) -> Result<Self, PseudonymError> {
        let length = text.chars().count();
        if text.is_empty() {
            return Err(PseudonymError::Empty);
        }
        // Checked first, since the other messages repeat the text.
        if length > LONGEST {
            return Err(PseudonymError::Long(length));
        }
        if text.contains('@') {
            return Err(PseudonymError::Address(text.into()));
        }
        if text.contains(char::is_whitespace) {
            return Err(PseudonymError::Space(text.into()));
        }
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
        if let Some(other) = text.chars().find(|&c| !plain(c)) {
            return Err(PseudonymError::Character(text.into(), other));
        }
        if text.starts_with(['-', '_']) {
            return Err(PseudonymError::Beginning(text.into()));
        }
        Ok(Self(text.into()))
    }
}

impl fmt::Display for Pseudonym {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn words_are_pseudonyms_and_names_are_not() {
        let longest = "x".repeat(LONGEST);
        for word in ["p07", "7", "group-3_b", "Otter", &longest] {
            assert_eq!(word.parse::<Pseudonym>().unwrap().as_str(), word);
        }
        let parse = |text: &str| text.parse::<Pseudonym>().unwrap_err();
        let of = String::from;
        assert_eq!(parse(""), PseudonymError::Empty);
        assert_eq!(parse("a@b.org"), PseudonymError::Address(of("a@b.org")));
        for names in ["Ada Lovelace", "p07 ", "p\u{a0}7", "a\nb"] {
            assert_eq!(parse(names), PseudonymError::Space(of(names)));
        }
        for (text, other) in [("zoë", 'ë'), ("a.b", '.'), ("../p", '.'), ("p\0", '\0')] {
            assert_eq!(parse(text), PseudonymError::Character(of(text), other));
        }
        assert_eq!(parse("--json"), PseudonymError::Beginning(of("--json")));
        assert_eq!(parse(&"x".repeat(33)), PseudonymError::Long(33));
        assert!(parse("a@b.org").to_string().contains("such as p07"));
        assert!(RIGHT.contains(&LONGEST.to_string()));
    }
}
