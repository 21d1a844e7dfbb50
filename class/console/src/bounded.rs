//! Text and lists of limited length: input from a network is refused where it is longer, and this program's own is cut.

use std::ops::Deref;

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Characters of a message to a student. Our choice: what a panel shows in a few lines.
pub const MESSAGE: usize = 200;

/// One line of at most `MOST` characters, none of them a control character.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Text<const MOST: usize>(String);

impl<const MOST: usize> Text<MOST> {
    /// As much of `text` as fits. A control character becomes a space.
    #[must_use]
    pub fn clipped(text: &str) -> Self {
        let plain = |c: char| if c.is_control() { ' ' } else { c };
        Self(text.chars().map(plain).take(MOST).collect())
    }
}

impl<const MOST: usize> Deref for Text<MOST> {
    type Target = str;

    fn deref(&self) -> &str {
        &self.0
    }
}

impl<const MOST: usize> Serialize for Text<MOST> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.0)
    }
}

impl<'de, const MOST: usize> Deserialize<'de> for Text<MOST> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        if text.chars().count() > MOST {
            return Err(D::Error::custom(format_args!(
                "a text has more than {MOST} characters"
            )));
        }
        if text.chars().any(char::is_control) {
            return Err(D::Error::custom("a text has a control character"));
        }
        Ok(Self(text))
    }
}

/// A list of at most `MOST` items.
#[derive(Clone, Debug, PartialEq)]
pub struct List<T, const MOST: usize>(Vec<T>);

impl<T, const MOST: usize> List<T, MOST> {
    /// The first `MOST` of them.
    #[must_use]
    pub fn clipped(things: impl IntoIterator<Item = T>) -> Self {
        Self(things.into_iter().take(MOST).collect())
    }
}

impl<T, const MOST: usize> Default for List<T, MOST> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<T, const MOST: usize> Deref for List<T, MOST> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.0
    }
}

impl<T: Serialize, const MOST: usize> Serialize for List<T, MOST> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

impl<'de, T: Deserialize<'de>, const MOST: usize> Deserialize<'de> for List<T, MOST> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        // A message has a length, and so has what is read here before it is refused.
        let things = Vec::deserialize(deserializer)?;
        if things.len() > MOST {
            return Err(D::Error::custom(format_args!(
                "a list has more than {MOST}"
            )));
        }
        Ok(Self(things))
    }
}
